// SPDX-License-Identifier: Apache-2.0
#include "channel_list.h"

#include <QSignalBlocker>
#include <QStandardItemModel>

#include <algorithm>

namespace asperity::studio {

namespace {

QString entry_of(const FileChannel& channel) {
    const QString name = QString::fromStdString(channel.name);
    if (!channel.other.empty())
        return QObject::tr("%1 (no heights: %2)").arg(name, QString::fromStdString(channel.other));
    return QObject::tr("%1, %2 × %3").arg(name).arg(channel.nx).arg(channel.ny);
}

/// By its name, or by its number, from 1, where it shares the name or the name is a number.
QString value_of(const std::vector<FileChannel>& channels, std::size_t place) {
    const std::string& name = channels[place].name;
    const auto same = std::count_if(channels.begin(), channels.end(),
                                    [&](const FileChannel& c) { return c.name == name; });
    bool number = false;
    QString::fromStdString(name).toInt(&number);
    return same == 1 && !number ? QString::fromStdString(name) : QString::number(place + 1);
}

QString left_to_the_file(const std::vector<FileChannel>& channels) {
    const auto heights = std::count_if(channels.begin(), channels.end(),
                                       [](const FileChannel& c) { return c.other.empty(); });
    if (heights > 1) return QObject::tr("Choose one of %1").arg(heights);
    return heights == 1 ? QObject::tr("The only one") : QObject::tr("As the file says");
}

}  // namespace

ChannelList::ChannelList(Workbench& workbench, QWidget* parent)
    : QComboBox(parent), workbench_(workbench), bindings_(workbench.document(), this) {
    setObjectName("surface-channel");
    setSizeAdjustPolicy(AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(12);
    connect(&workbench.surface(), &SurfaceSource::channels_changed, this,
            &ChannelList::show_channels);
    bindings_.follow([this](const StudioSettings&) { show_channels(); });
    connect(this, &QComboBox::currentIndexChanged, this, [this](int index) {
        if (index < 0) return;
        workbench_.document().change(tr("Channel"), [&](StudioSettings& s) {
            s.experiment.surface.file_channel = itemData(index).toString().toStdString();
        });
    });
}

void ChannelList::show_channels() {
    const QSignalBlocker quiet(this);
    const std::vector<FileChannel>& channels = workbench_.surface().channels();
    const QString chosen =
        QString::fromStdString(workbench_.settings().experiment.surface.file_channel);
    clear();
    addItem(left_to_the_file(channels), QString());
    for (std::size_t k = 0; k < channels.size(); ++k) {
        addItem(entry_of(channels[k]), value_of(channels, k));
        auto* entry = static_cast<QStandardItemModel*>(model())->item(count() - 1);
        entry->setEnabled(channels[k].other.empty());
        if (chosen == QString::number(k + 1)) setItemData(count() - 1, chosen);
    }
    if (findData(chosen) < 0) addItem(chosen, chosen);  // of another file, or of one not read yet
    setCurrentIndex(findData(chosen));
}

}  // namespace asperity::studio

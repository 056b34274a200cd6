// SPDX-License-Identifier: Apache-2.0
#include "file_surface_form.h"

#include "../model/settings_keys.h"
#include "channel_list.h"
#include "file_field.h"
#include "file_kinds.h"
#include "param_control.h"

#include <asperity/core/length.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/heights/heights_format.h>

#include <QFileInfo>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <fmt/format.h>

namespace asperity::studio {

namespace {

const Param<StudioSettings>& row_of(const char* setting) {
    return *asperity::find(all_params(), setting);
}

QString label_of(const char* setting) {
    return QString::fromStdString(label(row_of(setting).info));
}

/// "2.5 um, 3 um" as metres, which is what cells of a surface with a unit are counted in.
std::string in_metres(const std::string& typed) {
    std::string numbers;
    for (const std::string_view part : split(typed, ',')) {
        const auto length = parse_length(part);
        const bool unit = length && !length->unit.empty();
        numbers +=
            (numbers.empty() ? "" : ",") +
            (unit ? fmt::format("{}", in_unit(*length, "m").value_or(0)) : std::string(part));
    }
    return numbers;
}

/// The other way, where the text stands for the same number.
std::string with_unit(const std::string& numbers) {
    std::string text;
    for (const std::string_view part : split(numbers, ',')) {
        const auto metres = parse_length(part);
        if (!metres) return numbers;
        const std::string length = length_text(metres->value);
        if (in_metres(length) != fmt::format("{}", metres->value)) return numbers;
        text += (text.empty() ? "" : ", ") + length;
    }
    return text;
}

/// A list whose first entry leaves a word of the file to the file.
template <typename Word>
QComboBox* word_list(Bindings& bindings, const QString& step, Word SurfaceSettings::*member,
                     const QString& first, const std::vector<std::string>& words) {
    auto* list = new QComboBox;
    list->addItem(first, QString());
    for (const std::string& word : words)
        list->addItem(QString::fromStdString(word), QString::fromStdString(word));
    bindings.bind(
        list, step,
        [list, member](const StudioSettings& s) {
            const QString word = QString::fromStdString(s.experiment.surface.*member);
            if (list->findData(word) < 0) list->addItem(word, word);  // a session's own
            return list->findData(word);
        },
        [list, member](StudioSettings& s, int index) {
            s.experiment.surface.*member = list->itemData(index).toString().toStdString();
        });
    return list;
}

}  // namespace

void take_surface_file(Document& document, const QString& path) {
    document.change(QObject::tr("Surface File"), [&path](StudioSettings& settings) {
        SurfaceSettings& surface = settings.experiment.surface;
        if (surface.file != path.toStdString()) {
            surface.file_format = surface.file_channel = surface.file_decimal = {};
            surface.cell_x = surface.cell_y = std::nullopt;
        }
        surface.kind = kSurfaceFile;
        surface.file = path.toStdString();
        settings.scene = SceneKind::Surface;
    });
}

FileSurfaceForm::FileSurfaceForm(Workbench& workbench, QWidget* parent)
    : QWidget(parent),
      workbench_(workbench),
      bindings_(workbench.document(), this),
      lock_(workbench, this) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 6, 0);
    column->setSpacing(4);
    column->addWidget(file_section());
    column->addWidget(steps_section());
    column->addWidget(plane_section());
    column->addStretch(1);
}

void FileSurfaceForm::add(Section& section, const char* setting, QWidget* control) {
    const Param<StudioSettings>& row = row_of(setting);
    if (control->objectName().isEmpty()) control->setObjectName(QString("file-") + setting);
    const QString tooltip = tooltip_of(row);
    section.add_named_row(QString::fromStdString(label(row.info)), control, tooltip);
    if (auto* line = qobject_cast<SettingLine*>(control)) line->setToolTipOfSetting(tooltip);
    lock_.add(control);
    fields_[setting] = control;
}

void FileSurfaceForm::add_row(Section& section, const char* setting) {
    add(section, setting,
        make_control(row_of(setting), label_of(setting), bindings_, workbench_.document(),
                     QString("file-") + setting));
}

SettingLine* FileSurfaceForm::new_line(const char* setting, SettingLine::Translate to_row,
                                       SettingLine::Translate from_row) {
    auto* line = new SettingLine(row_of(setting), label_of(setting), workbench_.document(),
                                 bindings_, std::move(to_row), std::move(from_row));
    connect(line, &SettingLine::refused, this, &FileSurfaceForm::refused);
    return line;
}

QWidget* FileSurfaceForm::file_section() {
    auto* section = new Section(tr("File"));
    auto* file = new FileField("surface-path", tr("Open Surface File"), surface_filter());
    section->add_named_row(tr("File"), file, tr("Heights as instruments write them, or pictures"));
    lock_.add(file);
    bindings_.follow([file](const StudioSettings& s) {
        file->set_path(QString::fromStdString(s.experiment.surface.file));
    });
    connect(file, &FileField::chosen, this, [this](const QString& path) {
        if (!path.isEmpty()) take_surface_file(workbench_.document(), path);
    });
    add(*section, "channel", new ChannelList(workbench_));
    add(*section, "format", format_list());
    add(*section, "decimal", decimal_list());
    add(*section, "cell-size", cell_size_line());
    add(*section, "height-scale", new_line("height-scale"));
    return section;
}

/// Metres are written with a unit that suits them, where the heights are in metres.
SettingLine* FileSurfaceForm::cell_size_line() {
    const auto in_metres_now = [this] {
        const FileReading* reading = workbench_.surface().reading();
        return reading == nullptr || reading->before.unit == "m";
    };
    auto* line = new_line("cell-size", in_metres, [in_metres_now](const std::string& numbers) {
        return in_metres_now() ? with_unit(numbers) : numbers;
    });
    const auto show = [this, line] {
        const FileReading* reading = workbench_.surface().reading();
        const bool said = reading != nullptr && reading->before.size_x > 0;
        line->setPlaceholderText(said ? tr("%1, as the file says")
                                            .arg(QString::fromStdString(reading->before.length(
                                                reading->before.size_x / reading->before.nx)))
                                      : tr("as the file says"));
        line->show_setting();
    };
    connect(&workbench_.surface(), &SurfaceSource::read, line, show);
    connect(&workbench_.surface(), &SurfaceSource::failed, line, show);
    show();
    return line;
}

QWidget* FileSurfaceForm::format_list() {
    std::vector<std::string> names;
    std::map<std::string, std::string> docs;
    for (const io::HeightsFormat& format : io::builtin_heights())
        if (format.open) {
            names.push_back(format.name);
            docs[format.name] = format.doc;
        }
    QComboBox* list = word_list(bindings_, label_of("format"), &SurfaceSettings::file_format,
                                tr("By its content"), names);
    for (int k = 1; k < list->count(); ++k)
        list->setItemData(k, QString::fromStdString(docs[list->itemText(k).toStdString()]),
                          Qt::ToolTipRole);
    return list;
}

QWidget* FileSurfaceForm::decimal_list() {
    return word_list(bindings_, label_of("decimal"), &SurfaceSettings::file_decimal,
                     tr("As the numbers say"), {"point", "comma"});
}

QWidget* FileSurfaceForm::steps_section() {
    auto* section = new Section(tr("Made Ready"));
    add_row(*section, "outliers");
    add_row(*section, "fill");
    add_row(*section, "level");
    for (const char* setting : {"filter-s", "filter-l", "crop", "resample"})
        add(*section, setting, new_line(setting));
    return section;
}

QWidget* FileSurfaceForm::plane_section() {
    auto* section = new Section(tr("In the Light"));
    add_row(*section, "tiling");
    add(*section, "wavelength", new_line("wavelength"));
    return section;
}

void FileSurfaceForm::mark(const std::string& setting, const QString& why) {
    for (const auto& [name, field] : fields_) {
        const bool wrong = name == setting;
        if (auto* line = qobject_cast<SettingLine*>(field))
            line->mark(wrong ? why : QString());
        else
            mark_field(*field, wrong);
    }
}

}  // namespace asperity::studio

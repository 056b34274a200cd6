// SPDX-License-Identifier: Apache-2.0
#include "source_picker.h"

#include "file_kinds.h"

#include <asperity/bsdf/spec.h>

#include <QVBoxLayout>

namespace asperity::studio {

SourcePicker::SourcePicker(const QString& name, Workbench& workbench, Models models,
                           QWidget* parent)
    : QWidget(parent),
      workbench_(workbench),
      kind_(new QComboBox),
      place_(new QStackedLayout),
      layers_(new QLabel),
      file_(new FileField(name, tr("Open Result or BRDF"), brdf_filter())) {
    kind_->setObjectName(name + "-source");
    kind_->setAccessibleName(tr("Source"));
    kind_->addItems({tr("The layers drawn"), tr("A file")});
    layers_->setObjectName(name + "-layers");
    place_->addWidget(layers_);
    place_->addWidget(file_);
    if (models == Models::Yes) {
        kind_->addItem(tr("A model"));
        model_ = new QLineEdit("ggx:alpha=0.3");
        model_->setObjectName(name + "-model");
        model_->setAccessibleName(tr("Model"));
        model_->setToolTip(QString::fromStdString(brdf_spec_help()));
        place_->addWidget(model_);
        connect(model_, &QLineEdit::editingFinished, this, &SourcePicker::changed);
    }
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(kind_);
    column->addLayout(place_);
    connect(kind_, &QComboBox::currentIndexChanged, this, [this](int index) {
        place_->setCurrentIndex(index);
        emit changed();
    });
    connect(file_, &FileField::chosen, this, [this](const QString& path) {
        path_ = path;
        emit changed();
    });
    const Drawing& drawing = workbench.drawing();
    connect(&drawing, &Drawing::completed, this, &SourcePicker::show_layers);
    connect(&drawing, &Drawing::layers_changed, this, [this](int number) {
        if (number == 0) show_layers();
    });
    show_layers();
}

BrdfSource SourcePicker::source() const {
    const auto kind = static_cast<BrdfSource::Kind>(kind_->currentIndex());
    switch (kind) {
        case BrdfSource::Kind::File:
            return {kind, path_.toStdString()};
        case BrdfSource::Kind::Model:
            return {kind, model_->text().trimmed().toStdString()};
        case BrdfSource::Kind::Drawn:
            break;
    }
    return {};
}

void SourcePicker::set_source(const BrdfSource& source) {
    if (source.kind == BrdfSource::Kind::File) {
        path_ = QString::fromStdString(source.text);
        file_->set_path(path_);
    } else if (source.kind == BrdfSource::Kind::Model && model_ != nullptr) {
        model_->setText(QString::fromStdString(source.text));
    }
    kind_->setCurrentIndex(static_cast<int>(source.kind));
    emit changed();
}

void SourcePicker::show_layers() {
    const auto result = workbench_.drawing().result();
    layers_->setText(result == nullptr
                         ? tr("none yet: Draw To Textures")
                         : tr("%1 layers, %2")
                               .arg(result->layers.size())
                               .arg(QString::fromStdString(result->experiment.surface.kind)));
    layers_->setToolTip(result == nullptr ? QString()
                                          : QString::fromStdString(result->surface_name));
    emit changed();
}

}  // namespace asperity::studio

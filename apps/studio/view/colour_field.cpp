// SPDX-License-Identifier: Apache-2.0
#include "colour_field.h"

#include <asperity/render/tonemap.h>

#include <QColorDialog>
#include <QHBoxLayout>
#include <QPixmap>
#include <QSignalBlocker>

#include <cmath>

namespace asperity::studio {

namespace {

/// As a screen shows the reflectance in white light.
QColor shown(Rgb colour) {
    const Rgb level = apply(ToneMapping{}, colour);
    return QColor::fromRgbF(static_cast<float>(level.r), static_cast<float>(level.g),
                            static_cast<float>(level.b));
}

/// The reflectance that a screen shows as `level`, 0 .. 1, to three decimals as the boxes have.
double reflectance(float level) {
    const double c = static_cast<double>(level);
    const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    return 0.001 * std::round(1000 * linear);
}

}  // namespace

ColourField::ColourField(const QString& name, QWidget* parent)
    : QWidget(parent), button_(new QToolButton) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    const std::array<QString, 3> channels{"-r", "-g", "-b"};
    const std::array<QString, 3> names{tr("Red"), tr("Green"), tr("Blue")};
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
        boxes_[c] = new NumberBox(0, 1, 3, 0.05);
        boxes_[c]->setObjectName(name + channels[c]);
        boxes_[c]->setAccessibleName(names[c]);
        boxes_[c]->setButtonSymbols(QAbstractSpinBox::NoButtons);  // three in a narrow row
        layout->addWidget(boxes_[c], 1);
        connect(boxes_[c], &QDoubleSpinBox::valueChanged, this, [this] {
            show_colour();
            emit changed(value());
        });
    }
    button_->setObjectName(name + "-colour");
    button_->setAccessibleName(tr("Choose a colour"));
    layout->addWidget(button_);
    connect(button_, &QToolButton::clicked, this, &ColourField::ask);
    setFocusProxy(boxes_[0]);
    show_colour();
}

Rgb ColourField::value() const {
    return {boxes_[0]->value(), boxes_[1]->value(), boxes_[2]->value()};
}

void ColourField::set_value(Rgb colour) {
    const std::array<double, 3> channels{colour.r, colour.g, colour.b};
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
        const QSignalBlocker quiet(boxes_[c]);
        boxes_[c]->setValue(channels[c]);
    }
    show_colour();
}

void ColourField::ask() {
    auto* dialog = new QColorDialog(shown(value()), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QColorDialog::currentColorChanged, this, [this](const QColor& colour) {
        set_value({reflectance(colour.redF()), reflectance(colour.greenF()),
                   reflectance(colour.blueF())});
        emit changed(value());
    });
    dialog->open();
}

void ColourField::show_colour() {
    const int side = fontMetrics().height();
    QPixmap patch(side, side);
    patch.fill(shown(value()));
    button_->setIcon(patch);
    button_->setIconSize(patch.size());
}

}  // namespace asperity::studio

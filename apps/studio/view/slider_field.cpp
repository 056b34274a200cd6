// SPDX-License-Identifier: Apache-2.0
#include "slider_field.h"

#include <QHBoxLayout>
#include <QSignalBlocker>

#include <cmath>

namespace asperity::studio {

NumberBox::NumberBox(double low, double high, int decimals, double step, QWidget* parent)
    : QDoubleSpinBox(parent) {
    setDecimals(decimals);
    setRange(low, high);
    setSingleStep(step);
    setKeyboardTracking(false);  // "120" is one value, not three
    setFocusPolicy(Qt::StrongFocus);
}

QString NumberBox::textFromValue(double value) const {
    QString text = QDoubleSpinBox::textFromValue(value);
    const QString point = locale().decimalPoint();
    if (text.contains(point)) {
        while (text.endsWith('0')) text.chop(1);
        if (text.endsWith(point)) text.chop(static_cast<int>(point.size()));
    }
    return text;
}

QSize NumberBox::sizeHint() const {
    // Room for all decimals, though most values have none
    QSize size = QDoubleSpinBox::sizeHint();
    if (decimals() > 0)
        size.rwidth() += fontMetrics().horizontalAdvance("." + QString(decimals(), '0'));
    return size;
}

SliderField::SliderField(const QString& name, double low, double high, int decimals, double step,
                         QWidget* parent)
    : QWidget(parent),
      slider_(new QSlider(Qt::Horizontal)),
      box_(new NumberBox(low, high, decimals, step)),
      step_(step) {
    box_->setObjectName(name);
    slider_->setObjectName(name + "-slider");
    QString spoken = name;  // for screen readers
    spoken.replace('-', ' ');
    for (QWidget* part : {static_cast<QWidget*>(box_), static_cast<QWidget*>(slider_)})
        part->setAccessibleName(spoken);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    slider_->setMinimumWidth(3 * fontMetrics().height());
    layout->addWidget(slider_, 1);
    layout->addWidget(box_);
    box_->setMinimumWidth(box_->sizeHint().width());
    setFocusProxy(box_);
    set_range(low, high);

    connect(slider_, &QSlider::valueChanged, this,
            [this](int tick) { box_->setValue(tick * step_); });
    connect(box_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        const QSignalBlocker quiet(slider_);
        slider_->setValue(ticks(value));
        emit changed(value);
    });
}

void SliderField::set_value(double value) {
    const QSignalBlocker quiet_box(box_), quiet_slider(slider_);
    box_->setValue(value);
    slider_->setValue(ticks(value));
}

void SliderField::set_range(double low, double high) {
    const QSignalBlocker quiet_box(box_), quiet_slider(slider_);
    box_->setRange(low, high);
    slider_->setRange(ticks(low), ticks(high));
    slider_->setPageStep(std::max(1, (ticks(high) - ticks(low)) / 10));
}

int SliderField::ticks(double value) const {
    return static_cast<int>(std::lround(value / step_));
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QDoubleSpinBox>
#include <QSlider>
#include <QWidget>

namespace asperity::studio {

/// A spin box that writes 3 as "3", not as "3.00".
class NumberBox : public QDoubleSpinBox {
    Q_OBJECT

  public:
    NumberBox(double low, double high, int decimals, double step, QWidget* parent = nullptr);
    QString textFromValue(double value) const override;
    QSize sizeHint() const override;
};

/// A number as a slider and a box beside it. The box takes the name given, the slider the same with
/// "-slider" behind it.
class SliderField : public QWidget {
    Q_OBJECT

  public:
    SliderField(const QString& name, double low, double high, int decimals, double step,
                QWidget* parent = nullptr);

    double value() const { return box_->value(); }
    void set_value(double value);  ///< without `changed`
    void set_range(double low, double high);
    NumberBox& box() { return *box_; }
    QSlider& slider() { return *slider_; }

  signals:
    void changed(double value);  ///< by the user

  private:
    int ticks(double value) const;

    QSlider* slider_;
    NumberBox* box_;
    double step_;
};

}  // namespace asperity::studio

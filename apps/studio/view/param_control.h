// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

#include <asperity/params/param.h>

#include <QAbstractSpinBox>
#include <QWidget>

namespace asperity::studio {

/// A whole number from 0 to 2^64 - 1, such as a seed.
class NaturalBox : public QAbstractSpinBox {
    Q_OBJECT

  public:
    explicit NaturalBox(QWidget* parent = nullptr);

    std::uint64_t value() const { return value_; }
    void set_value(std::uint64_t value);
    void stepBy(int steps) override;

  signals:
    void changed(quint64 value);  ///< by the user

  protected:
    StepEnabled stepEnabled() const override { return StepUpEnabled | StepDownEnabled; }
    QValidator::State validate(QString& text, int& place) const override;

  private:
    void take(std::uint64_t value);

    std::uint64_t value_ = 0;
};

/// A control for a setting, from its row: a box, a slider, a list, with the range of the row; it is
/// tied to the setting. `step` is its name in the Edit menu, `name` that of the control; empty:
/// made from `step`.
QWidget* make_control(const Param<StudioSettings>& param, const QString& step, Bindings& bindings,
                      Document& document, const QString& name = {});

/// What a row says of its setting: one sentence, its range, its default.
QString tooltip_of(const Param<StudioSettings>& param);

}  // namespace asperity::studio

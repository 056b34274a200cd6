// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QFrame>
#include <QLabel>
#include <QPushButton>

namespace asperity::studio {

/// Five steps of a first lecture. Each sets the controls itself, draws, chooses layer and plot, and
/// says what there is to see and why. A panel that blocks nothing: play on between the steps.
class Tour : public QFrame {
    Q_OBJECT

  public:
    explicit Tour(Workbench& workbench, QWidget* parent = nullptr);

    static int step_count();
    int step() const { return step_; }
    void begin();         ///< appears with the first step
    void show_step(int);  ///< 0 .. step_count() - 1

  private:
    void set_controls();

    Workbench& workbench_;
    int step_ = 0;
    QLabel *title_, *text_;
    QPushButton *back_, *next_;
};

}  // namespace asperity::studio

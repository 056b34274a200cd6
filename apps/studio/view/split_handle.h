// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

namespace asperity::studio {

/// The line between two pictures in one view: a strip of its parent, as high as that, to be
/// dragged, or moved with the arrow keys (Shift: farther), Home and End.
class SplitHandle : public QWidget {
    Q_OBJECT

  public:
    explicit SplitHandle(QWidget* view);

    double position() const { return position_; }
    void set_position(double position);  ///< a share of the width, 0 .. 1; without `moved`

  signals:
    void moved(double position);  ///< by the user

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void paintEvent(QPaintEvent*) override;
    void focusInEvent(QFocusEvent*) override { update(); }
    void focusOutEvent(QFocusEvent*) override { update(); }

  private:
    void place();
    void move_to(double position);

    double position_ = 0.5;
    double grip_ = 0;  ///< where the mouse holds it, from the line [pixels]
};

}  // namespace asperity::studio

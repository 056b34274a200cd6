// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/painting.h"
#include "../model/settings.h"

#include <asperity/render/camera_controller.h>

#include <QElapsedTimer>
#include <QPointF>
#include <QTimer>
#include <QWidget>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace asperity::studio {

bool same_camera(const Camera& a, const Camera& b);

/// A window onto a scene: shows the pictures of a Painter, paints lines and labels over them, and
/// steers a camera by mouse and keys (thesis table 2.1; R resets).
class Viewport : public QWidget {
    Q_OBJECT

  public:
    /// What is painted over the picture, in widget coordinates.
    using PaintOver = std::function<void(QPainter&, const Viewport&)>;
    /// Begins the picture for a camera; called in the main thread, gives what the thread calls.
    using Picture = std::function<BeginPainting(const Camera&)>;

    explicit Viewport(QWidget* parent = nullptr);

    void set_picture(Picture picture);  ///< null: an empty view
    void add_overlay(PaintOver paint);
    /// The scene changed: paint it anew; `moving`: more changes will follow at once.
    void refresh(bool moving = false);
    void refresh_overlay() { update(); }

    const Camera& camera() const { return camera_; }
    /// The camera of the picture that is shown now, a little behind camera() while that moves:
    /// lines and clicks go by it. camera() without a picture.
    const Camera& shown_camera() const { return frame_.image.isNull() ? camera_ : shown_camera_; }
    /// Where R leads back to, and where to begin. World: y up.
    /// It is that of a view so many times as wide as high, and moves back for a narrower one.
    void set_home(const Orbiter& home, double aspect = 0);
    void set_camera_type(CameraType type);
    void reset_camera();
    /// Looks through it; the steering takes over from there. A session was opened.
    void set_camera(const Camera& camera);
    /// Through that camera, or home without one.
    void set_camera(const KeptCamera& kept);
    bool is_moving() const;

    /// Where a point of the world lies in the widget by shown_camera(); none behind it.
    std::optional<QPointF> project(Vec3 point) const;
    /// The ray through a place of the widget.
    WorldRay ray_at(QPointF place) const;

    Painter& painter() { return painter_; }
    /// The picture shown and what is painted over it, at the widget's size.
    QImage grab_picture() const;
    const Frame& frame() const { return frame_; }

  signals:
    void camera_moved();
    void clicked(QPointF place, Qt::MouseButton button);  ///< pressed and released without a drag
    void hovered(QPointF place);
    void frame_shown();

  protected:
    void paintEvent(QPaintEvent*) override;
    void resizeEvent(QResizeEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void keyReleaseEvent(QKeyEvent*) override;
    void focusOutEvent(QFocusEvent*) override;
    bool event(QEvent*) override;

  private:
    bool show_camera(bool moving);
    void step();
    bool turn_by_key(int key);
    void wake();
    void show_frame(const Frame& frame);
    void paint_over(QPainter& painter) const;

    Painter painter_;
    Picture picture_;
    std::vector<PaintOver> overlays_;
    Frame frame_;
    Orbiter fitted_home() const;

    Orbiter home_;
    double home_aspect_ = 0;
    bool at_home_ = true;  ///< nobody has moved the camera from there
    CameraController controller_;
    Camera camera_, shown_camera_;
    std::deque<std::pair<std::uint64_t, Camera>> wished_;  ///< cameras of pictures to come
    CameraInput input_;
    QPointF pressed_at_, last_at_;
    bool dragged_ = false;  ///< the pressed mouse has moved: no click any more
    QElapsedTimer clock_;
    QTimer step_timer_, still_timer_;
};

}  // namespace asperity::studio

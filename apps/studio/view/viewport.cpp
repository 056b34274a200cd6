// SPDX-License-Identifier: Apache-2.0
#include "viewport.h"

#include <asperity/core/directions.h>

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QWheelEvent>

#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kStepMs = 16;    // between two steps of the camera
constexpr int kStillMs = 120;  // without a change, a view is still: no longer than an eye waits
constexpr double kUnitsPerNotch = 120;  // of QWheelEvent::angleDelta()
constexpr double kLongestStep = 0.1;    // [s]: a late step must not throw the camera far off

bool has_keys(const CameraInput& input) {
    return input.w || input.a || input.s || input.d || input.q || input.e;
}

/// The switch of an input that a key stands for; null: none.
bool* switch_of(int key, CameraInput& input) {
    switch (key) {
        case Qt::Key_W:
            return &input.w;
        case Qt::Key_A:
            return &input.a;
        case Qt::Key_S:
            return &input.s;
        case Qt::Key_D:
            return &input.d;
        case Qt::Key_Q:
            return &input.q;
        case Qt::Key_E:
            return &input.e;
        case Qt::Key_Shift:
            return &input.shift;
        case Qt::Key_Control:
            return &input.ctrl;
        default:
            return nullptr;
    }
}

}  // namespace

bool same_camera(const Camera& a, const Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up &&
           a.fov_deg == b.fov_deg;
}

Viewport::Viewport(QWidget* parent) : QWidget(parent), controller_(home_), camera_(home_.camera()) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setMinimumSize(160, 120);
    step_timer_.setInterval(kStepMs);
    step_timer_.setTimerType(Qt::PreciseTimer);
    still_timer_.setInterval(kStillMs);
    still_timer_.setSingleShot(true);
    connect(&step_timer_, &QTimer::timeout, this, &Viewport::step);
    connect(&still_timer_, &QTimer::timeout, this, [this] { refresh(false); });
    connect(&painter_, &Painter::frame_ready, this, &Viewport::show_frame);
}

void Viewport::set_picture(Picture picture) {
    picture_ = std::move(picture);
    if (picture_) {
        refresh();
        return;
    }
    painter_.stop();
    wished_.clear();
    frame_ = {};
    update();
}

void Viewport::add_overlay(PaintOver paint) {
    overlays_.push_back(std::move(paint));
    update();
}

void Viewport::refresh(bool moving) {
    update();
    if (moving)
        still_timer_.start();
    else
        still_timer_.stop();
    if (!picture_ || width() < 1 || height() < 1) return;
    const std::uint64_t wish =
        painter_.paint(picture_(camera_), (QSizeF(size()) * devicePixelRatioF()).toSize(), moving);
    wished_.emplace_back(wish, camera_);
}

void Viewport::show_frame(const Frame& frame) {
    if (!picture_) return;
    while (!wished_.empty() && wished_.front().first < frame.wish) wished_.pop_front();
    if (!wished_.empty() && wished_.front().first == frame.wish)
        shown_camera_ = wished_.front().second;
    frame_ = frame;
    update();
    emit frame_shown();
}

// The camera

void Viewport::set_home(const Orbiter& home, double aspect) {
    home_ = home;
    home_aspect_ = aspect;
    reset_camera();
}

Orbiter Viewport::fitted_home() const {
    Orbiter home = home_;
    const double aspect = static_cast<double>(width()) / std::max(1, height());
    if (aspect < home_aspect_) home.distance *= home_aspect_ / std::max(aspect, 0.1);
    return home;
}

void Viewport::set_camera_type(CameraType type) {
    switch (type) {
        case CameraType::Orbiter:
            controller_ = make_orbiter(camera_, home_.target);
            break;
        case CameraType::FirstPerson:
            controller_ = make_first_person(camera_);
            break;
        case CameraType::SixDof:
            controller_ = make_six_dof(camera_);
            break;
    }
    show_camera(false);
}

void Viewport::set_camera(const Camera& camera) {
    std::visit(
        [&](auto& controller) {
            using Controller = std::decay_t<decltype(controller)>;
            if constexpr (std::is_same_v<Controller, Orbiter>)
                controller = make_orbiter(camera, home_.target);
            else if constexpr (std::is_same_v<Controller, FirstPerson>)
                controller = make_first_person(camera);
            else
                controller = make_six_dof(camera);
        },
        controller_);
    at_home_ = false;
    show_camera(false);
}

void Viewport::set_camera(const KeptCamera& kept) {
    if (const std::optional<Camera> camera = camera_of(kept))
        set_camera(*camera);
    else
        reset_camera();
}

void Viewport::reset_camera() {
    const Orbiter fitted = fitted_home();
    const Camera home = fitted.camera();
    at_home_ = true;
    std::visit(
        [&](auto& controller) {
            using Controller = std::decay_t<decltype(controller)>;
            if constexpr (std::is_same_v<Controller, Orbiter>)
                controller = fitted;
            else if constexpr (std::is_same_v<Controller, FirstPerson>)
                controller = make_first_person(home);
            else
                controller = make_six_dof(home);
        },
        controller_);
    show_camera(false);
}

bool Viewport::is_moving() const {
    return still_timer_.isActive();
}

/// Looks through the controller's camera; true when it is another than before.
bool Viewport::show_camera(bool moving) {
    const Camera camera = std::visit([](const auto& c) { return c.camera(); }, controller_);
    if (same_camera(camera, camera_)) return false;
    camera_ = camera;
    if (moving) at_home_ = false;
    refresh(moving);
    emit camera_moved();
    return true;
}

/// Moves the camera by what the user did since the last step.
void Viewport::step() {
    input_.seconds = std::min(kLongestStep, 1e-9 * static_cast<double>(clock_.nsecsElapsed()));
    clock_.restart();
    std::visit([this](auto& controller) { controller.step(input_); }, controller_);
    input_.drag_x = input_.drag_y = input_.scroll = 0;
    const bool held = has_keys(input_) && !std::holds_alternative<Orbiter>(controller_);
    if (!held) step_timer_.stop();
    // At the end of a movement by keys the full resolution need not wait.
    if (!show_camera(true) && !held && !dragged_ && is_moving()) refresh(false);
}

/// Sees to it that a step comes soon.
void Viewport::wake() {
    if (step_timer_.isActive()) return;
    clock_.restart();
    step_timer_.start();
}

// What the user does

void Viewport::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    pressed_at_ = last_at_ = event->position();
    dragged_ = false;
    input_.left_button = event->buttons().testFlag(Qt::LeftButton);
    input_.right_button = event->buttons().testFlag(Qt::RightButton);
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->position();
    if (!input_.left_button && !input_.right_button) {
        emit hovered(at);
        return;
    }
    const QPointF way = at - pressed_at_;
    if (!dragged_ && way.manhattanLength() < QApplication::startDragDistance()) return;
    dragged_ = true;
    const QPointF drag = (at - last_at_) / std::max(1, height());
    last_at_ = at;
    input_.drag_x += drag.x();
    input_.drag_y += drag.y();
    wake();
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
    if (!dragged_) emit clicked(event->position(), event->button());
    if (dragged_) step();  // with the button still down: what was dragged since the last step
    input_.left_button = event->buttons().testFlag(Qt::LeftButton);
    input_.right_button = event->buttons().testFlag(Qt::RightButton);
    if (input_.left_button || input_.right_button) return;
    dragged_ = false;
    if (is_moving() && !has_keys(input_)) refresh(false);
}

void Viewport::wheelEvent(QWheelEvent* event) {
    input_.scroll += event->angleDelta().y() / kUnitsPerNotch;
    event->accept();
    wake();
}

void Viewport::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_R && event->modifiers() == Qt::NoModifier) {
        reset_camera();
        return;
    }
    if (event->modifiers() == Qt::NoModifier && turn_by_key(event->key())) return;
    bool* pressed = switch_of(event->key(), input_);
    if (!pressed) {
        QWidget::keyPressEvent(event);
        return;
    }
    *pressed = true;
    if (has_keys(input_)) wake();
}

/// What the mouse does, for those who have none: arrows turn, + and - bring nearer and farther.
bool Viewport::turn_by_key(int key) {
    constexpr double kTurn = 1.0 / 36;  // of the height, so 5 degrees
    CameraInput input;
    switch (key) {
        case Qt::Key_Left:
            input.drag_x = -kTurn;
            break;
        case Qt::Key_Right:
            input.drag_x = kTurn;
            break;
        case Qt::Key_Up:
            input.drag_y = -kTurn;
            break;
        case Qt::Key_Down:
            input.drag_y = kTurn;
            break;
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            input.scroll = 1;
            break;
        case Qt::Key_Minus:
            input.scroll = -1;
            break;
        default:
            return false;
    }
    input.left_button = true;
    std::visit([&input](auto& controller) { controller.step(input); }, controller_);
    show_camera(true);
    return true;
}

/// Two fingers drawn apart on a trackpad bring nearer.
bool Viewport::event(QEvent* event) {
    if (event->type() == QEvent::NativeGesture) {
        const auto* gesture = static_cast<QNativeGestureEvent*>(event);
        if (gesture->gestureType() == Qt::ZoomNativeGesture) {
            constexpr double kNotchesToDouble = 7;  // a tenth each
            input_.scroll += kNotchesToDouble * gesture->value();
            wake();
            return true;
        }
    }
    return QWidget::event(event);
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
    bool* pressed = switch_of(event->key(), input_);
    if (!pressed) {
        QWidget::keyReleaseEvent(event);
        return;
    }
    if (event->isAutoRepeat()) return;
    if (step_timer_.isActive()) step();  // what the key moved since the last step
    *pressed = false;
    if (!has_keys(input_) && !dragged_ && is_moving()) refresh(false);
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    // Releases that happen elsewhere are never told.
    input_ = {};
    dragged_ = false;
    QWidget::focusOutEvent(event);
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (at_home_ && home_aspect_ > 0) reset_camera();
    refresh(true);
}

// Places

std::optional<QPointF> Viewport::project(Vec3 point) const {
    const Camera& camera = shown_camera();
    const Vec3 to = point - camera.position;
    const double depth = dot(to, camera.forward);
    if (!(depth > 0)) return std::nullopt;
    const double pixel = 2 * std::tan(0.5 * radians(camera.fov_deg)) / height();
    return QPointF(0.5 * width() + dot(to, camera.right()) / (depth * pixel),
                   0.5 * height() - dot(to, camera.up) / (depth * pixel));
}

WorldRay Viewport::ray_at(QPointF place) const {
    return PixelRays(shown_camera(), width(), height()).at(place.x(), place.y());
}

// Pictures

void Viewport::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    paint_over(painter);
}

QImage Viewport::grab_picture() const {
    const double ratio = devicePixelRatioF();
    QImage picture((QSizeF(size()) * ratio).toSize(), QImage::Format_RGB32);
    picture.setDevicePixelRatio(ratio);
    QPainter painter(&picture);
    paint_over(painter);
    return picture;
}

/// The picture, enlarged if it is one of a moving view, and all that is painted over it.
void Viewport::paint_over(QPainter& painter) const {
    if (frame_.image.isNull()) {
        painter.fillRect(rect(), Qt::black);
    } else {
        painter.setRenderHint(QPainter::SmoothPixmapTransform, frame_.image.size() != frame_.full);
        painter.drawImage(QRectF(rect()), frame_.image, QRectF(frame_.image.rect()));
    }
    painter.setRenderHint(QPainter::Antialiasing);
    for (const PaintOver& paint : overlays_) {
        painter.save();
        paint(painter, *this);
        painter.restore();
    }
}

}  // namespace asperity::studio

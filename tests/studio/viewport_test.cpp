// SPDX-License-Identifier: Apache-2.0
// The viewport: what mouse and keys do to the camera (thesis table 2.1), and where things lie.
#include "view/viewport.h"

#include <QNativeGestureEvent>
#include <QPainter>
#include <QPointingDevice>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <cmath>

namespace asperity::studio {
namespace {

/// Paints one colour at once.
class Flat : public Painting {
  public:
    explicit Flat(QSize size) : image_(size, QImage::Format_RGB32) { image_.fill(Qt::darkCyan); }
    bool pass(Run&) override { return false; }
    QImage image() const override { return image_; }

  private:
    QImage image_;
};

BeginPainting flat_picture(const Camera&) {
    return [](QSize size) -> std::unique_ptr<Painting> { return std::make_unique<Flat>(size); };
}

void drag(Viewport& view, Qt::MouseButton button, QPoint from, QPoint way) {
    QTest::mousePress(&view, button, {}, from);
    for (int k = 1; k <= 10; ++k) {
        QTest::mouseMove(&view, from + way * k / 10);
        QTest::qWait(5);
    }
    QTest::mouseRelease(&view, button, {}, from + way);
}

void scroll(Viewport& view, int notches) {
    const QPointF at = QRectF(view.rect()).center();
    QWheelEvent event(at, view.mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&view, &event);
}

/// What a trackpad tells while two fingers move: by how much they are farther apart.
void pinch(Viewport& view, double farther) {
    const QPointF at = QRectF(view.rect()).center();
    QNativeGestureEvent event(Qt::ZoomNativeGesture, QPointingDevice::primaryPointingDevice(), 2,
                              at, at, view.mapToGlobal(at), farther, {});
    QCoreApplication::sendEvent(&view, &event);
}

/// How far the camera goes while a key is held for `milliseconds`.
Vec3 way_of_key(Viewport& view, Qt::Key key, int milliseconds = 120) {
    const Vec3 from = view.camera().position;
    QTest::keyPress(&view, key);
    QTest::qWait(milliseconds);
    QTest::keyRelease(&view, key);
    return view.camera().position - from;
}

bool near(Vec3 a, Vec3 b, double tolerance = 1e-9) {
    return length(a - b) < tolerance;
}

}  // namespace

class ViewportTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup() { view_.reset(); }

    void orbiter_drags_round_and_zooms();
    void fingers_drawn_apart_bring_nearer();
    void orbiter_knows_no_keys();
    void first_person_walks_and_looks_data();
    void first_person_walks_and_looks();
    void shift_and_control_change_the_pace();
    void six_dof_flies_and_rolls();
    void reset_leads_home_data();
    void reset_leads_home();
    void changing_the_type_keeps_the_view();
    void clicks_are_no_drags();
    void lost_keyboard_stops_the_walk();
    void project_and_ray_are_inverse();
    void overlays_are_painted_over();
    void still_picture_follows_movement();

  private:
    std::unique_ptr<Viewport> view_;
};

void ViewportTest::init() {
    view_ = std::make_unique<Viewport>();
    view_->resize(400, 300);
    view_->show();
    QVERIFY(QTest::qWaitForWindowExposed(view_.get()));
    view_->setFocus();
    Orbiter home;
    home.distance = 4;
    home.elevation_deg = 20;
    view_->set_home(home);
}

void ViewportTest::orbiter_drags_round_and_zooms() {
    const Camera before = view_->camera();
    QSignalSpy moved(view_.get(), &Viewport::camera_moved);
    // Across a third of the height: 60 degrees. The model turns to the right, the camera to the
    // left of it.
    drag(*view_, Qt::LeftButton, {200, 150}, {100, 0});
    const Camera after = view_->camera();
    QVERIFY(moved.count() >= 1);
    QVERIFY(std::abs(length(after.position) - 4) < 1e-9);
    QVERIFY(near(after.forward, -(0.25 * after.position)));  // still looks at it
    const double turned = std::atan2(after.position.x, after.position.z);
    QVERIFY2(std::abs(turned + kPi / 3) < 0.01, qPrintable(QString::number(turned)));
    QVERIFY(std::abs(after.position.y - before.position.y) < 1e-9);

    drag(*view_, Qt::LeftButton, {200, 150}, {0, 50});
    QVERIFY(view_->camera().position.y > after.position.y + 0.5);

    scroll(*view_, 2);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(length(view_->camera().position) - 4 * 0.81) < 1e-9, 60000);
    scroll(*view_, -3);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(length(view_->camera().position) - 4 / 0.9) < 1e-9, 60000);
}

void ViewportTest::fingers_drawn_apart_bring_nearer() {
    // Apart by a seventh is a notch of the wheel
    pinch(*view_, 2.0 / 7);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(length(view_->camera().position) - 4 * 0.81) < 1e-9, 60000);
    pinch(*view_, -3.0 / 7);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(length(view_->camera().position) - 4 / 0.9) < 1e-9, 60000);
    // Turning two fingers is nothing a camera knows
    const QPointF at(200, 150);
    QNativeGestureEvent turned(Qt::RotateNativeGesture, QPointingDevice::primaryPointingDevice(), 2,
                               at, at, at, 0.5, {});
    QCoreApplication::sendEvent(view_.get(), &turned);
    QTest::qWait(60);
    QVERIFY(std::abs(length(view_->camera().position) - 4 / 0.9) < 1e-9);
}

void ViewportTest::orbiter_knows_no_keys() {
    for (const Qt::Key key : {Qt::Key_W, Qt::Key_A, Qt::Key_S, Qt::Key_D, Qt::Key_Q, Qt::Key_E})
        QVERIFY(near(way_of_key(*view_, key, 40), {0, 0, 0}));
}

void ViewportTest::first_person_walks_and_looks_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<double>("right");
    QTest::addColumn<double>("world_up");
    QTest::addColumn<double>("forward");
    QTest::newRow("W forward") << int(Qt::Key_W) << 0.0 << 0.0 << 1.0;
    QTest::newRow("A leftward") << int(Qt::Key_A) << -1.0 << 0.0 << 0.0;
    QTest::newRow("S backward") << int(Qt::Key_S) << 0.0 << 0.0 << -1.0;
    QTest::newRow("D rightward") << int(Qt::Key_D) << 1.0 << 0.0 << 0.0;
    QTest::newRow("Q downward") << int(Qt::Key_Q) << 0.0 << -1.0 << 0.0;
    QTest::newRow("E upward") << int(Qt::Key_E) << 0.0 << 1.0 << 0.0;
}

void ViewportTest::first_person_walks_and_looks() {
    QFETCH(int, key);
    QFETCH(double, right);
    QFETCH(double, world_up);
    QFETCH(double, forward);
    view_->set_camera_type(CameraType::FirstPerson);
    drag(*view_, Qt::LeftButton, {100, 100}, {60, -30});  // looks somewhere else
    const Camera looking = view_->camera();
    QVERIFY(looking.forward.x > 0.1);  // to the right

    const Vec3 way = way_of_key(*view_, static_cast<Qt::Key>(key));
    QVERIFY2(length(way) > 0.02 && length(way) < 2, qPrintable(QString::number(length(way))));
    const Vec3 wanted =
        right * looking.right() + world_up * Vec3{0, 1, 0} + forward * looking.forward;
    QVERIFY(near(normalize(way), wanted, 1e-6));
    QVERIFY(near(view_->camera().forward, looking.forward));
    const Vec3 rest = view_->camera().position;
    QTest::qWait(60);
    QVERIFY(near(view_->camera().position, rest));  // released: stands still
}

void ViewportTest::shift_and_control_change_the_pace() {
    view_->set_camera_type(CameraType::FirstPerson);
    constexpr int kHold = 200;
    const double plain = length(way_of_key(*view_, Qt::Key_W, kHold));
    QTest::keyPress(view_.get(), Qt::Key_Shift);
    const double fast = length(way_of_key(*view_, Qt::Key_W, kHold));
    QTest::keyRelease(view_.get(), Qt::Key_Shift);
    QTest::keyPress(view_.get(), Qt::Key_Control);
    const double slow = length(way_of_key(*view_, Qt::Key_W, kHold));
    QTest::keyRelease(view_.get(), Qt::Key_Control);
    // 4 and 1/4 times; the clock of a busy machine is coarse.
    QVERIFY2(fast > 2 * plain && slow < 0.5 * plain && slow > 0,
             qPrintable(QString("%1 %2 %3").arg(slow).arg(plain).arg(fast)));
}

void ViewportTest::six_dof_flies_and_rolls() {
    view_->set_camera_type(CameraType::SixDof);
    const Camera before = view_->camera();
    QVERIFY(near(normalize(way_of_key(*view_, Qt::Key_W)), before.forward, 1e-6));
    QVERIFY(near(normalize(way_of_key(*view_, Qt::Key_E)), before.up, 1e-6));
    QVERIFY(near(normalize(way_of_key(*view_, Qt::Key_A)), -before.right(), 1e-6));

    // Right button: rolls about the view; to the right clockwise: 75 px of 300 are 45 degrees.
    drag(*view_, Qt::RightButton, {100, 150}, {75, 0});
    const Camera rolled = view_->camera();
    QVERIFY(near(rolled.forward, before.forward, 1e-6));
    const double roll = std::atan2(dot(rolled.up, before.right()), dot(rolled.up, before.up));
    QVERIFY2(std::abs(roll - kPi / 4) < 0.01, qPrintable(QString::number(roll)));

    drag(*view_, Qt::LeftButton, {100, 150}, {40, 0});
    QVERIFY(dot(view_->camera().forward, rolled.right()) > 0.2);
    QVERIFY(near(view_->camera().up, rolled.up, 1e-6));
}

void ViewportTest::reset_leads_home_data() {
    QTest::addColumn<CameraType>("type");
    QTest::newRow("orbiter") << CameraType::Orbiter;
    QTest::newRow("first person") << CameraType::FirstPerson;
    QTest::newRow("6-DoF") << CameraType::SixDof;
}

void ViewportTest::reset_leads_home() {
    QFETCH(CameraType, type);
    const Camera home = view_->camera();
    view_->set_camera_type(type);
    drag(*view_, Qt::LeftButton, {100, 100}, {80, 40});
    way_of_key(*view_, Qt::Key_W, 50);
    scroll(*view_, 1);
    QTest::qWait(30);
    QVERIFY(!near(view_->camera().forward, home.forward, 0.01));
    QTest::keyClick(view_.get(), Qt::Key_R);
    QVERIFY(near(view_->camera().position, home.position, 1e-6));
    QVERIFY(near(view_->camera().forward, home.forward, 1e-6));
    QVERIFY(near(view_->camera().up, home.up, 1e-6));
}

void ViewportTest::changing_the_type_keeps_the_view() {
    const Camera before = view_->camera();
    for (const CameraType type :
         {CameraType::FirstPerson, CameraType::SixDof, CameraType::Orbiter}) {
        view_->set_camera_type(type);
        QVERIFY(near(view_->camera().position, before.position, 1e-6));
        QVERIFY(near(view_->camera().forward, before.forward, 1e-6));
    }
}

void ViewportTest::clicks_are_no_drags() {
    QSignalSpy clicked(view_.get(), &Viewport::clicked);
    QSignalSpy hovered(view_.get(), &Viewport::hovered);
    const Camera before = view_->camera();
    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {120, 80});
    QCOMPARE(clicked.count(), 1);
    QCOMPARE(clicked[0][0].toPointF(), QPointF(120, 80));
    QVERIFY(near(view_->camera().position, before.position));
    drag(*view_, Qt::LeftButton, {120, 80}, {50, 0});
    QCOMPARE(clicked.count(), 1);
    QTest::mouseMove(view_.get(), {30, 40});
    QTRY_VERIFY_WITH_TIMEOUT(hovered.count() >= 1, 60000);
    QCOMPARE(hovered.last()[0].toPointF(), QPointF(30, 40));
}

void ViewportTest::lost_keyboard_stops_the_walk() {
    view_->set_camera_type(CameraType::FirstPerson);
    QTest::keyPress(view_.get(), Qt::Key_W);
    QTest::qWait(40);
    view_->clearFocus();
    QTest::qWait(40);
    const Vec3 rest = view_->camera().position;
    QTest::qWait(60);
    QVERIFY(near(view_->camera().position, rest));
}

void ViewportTest::project_and_ray_are_inverse() {
    drag(*view_, Qt::LeftButton, {100, 100}, {37, 21});
    for (const QPointF place : {QPointF(200, 150), QPointF(0, 0), QPointF(399.5, 20.25)}) {
        const WorldRay ray = view_->ray_at(place);
        const std::optional<QPointF> back = view_->project(ray.origin + 7.5 * ray.direction);
        QVERIFY(back);
        QVERIFY(QLineF(*back, place).length() < 1e-9);
        QVERIFY(!view_->project(ray.origin - ray.direction));
    }
    QVERIFY(near(view_->ray_at({200, 150}).direction, view_->camera().forward));
    // What is up and to the right in the world of the camera is so in the widget.
    const Camera& camera = view_->camera();
    const QPointF at = *view_->project(camera.position + 3 * camera.forward + 0.5 * camera.right() +
                                       0.25 * camera.up);
    QVERIFY(at.x() > 200 && at.y() < 150);
}

void ViewportTest::overlays_are_painted_over() {
    view_->set_picture(flat_picture);
    QTRY_COMPARE_WITH_TIMEOUT(view_->frame().full, view_->size(), 60000);
    view_->add_overlay([](QPainter& painter, const Viewport& view) {
        QVERIFY(view.project({0, 0, 0}));
        painter.fillRect(10, 10, 20, 20, Qt::red);
    });
    const QImage picture = view_->grab_picture();
    QCOMPARE(picture.pixelColor(15, 15), QColor(Qt::red));
    QCOMPARE(picture.pixelColor(100, 100), QColor(Qt::darkCyan));
    QCOMPARE(view_->grab().toImage().pixelColor(100, 100), QColor(Qt::darkCyan));
    view_->set_picture({});
    QCOMPARE(view_->grab_picture().pixelColor(100, 100), QColor(Qt::black));
}

void ViewportTest::still_picture_follows_movement() {
    view_->set_picture(flat_picture);
    QTRY_VERIFY_WITH_TIMEOUT(!view_->is_moving() && view_->frame().full == view_->size(), 60000);
    bool moved = false;
    connect(view_.get(), &Viewport::frame_shown, this,
            [&] { moved = moved || view_->frame().moving; });
    drag(*view_, Qt::LeftButton, {100, 100}, {50, 0});
    QTRY_VERIFY_WITH_TIMEOUT(moved, 60000);
    QTRY_VERIFY_WITH_TIMEOUT(!view_->is_moving() && !view_->frame().moving, 60000);
    QCOMPARE(view_->frame().image.size(), view_->size());
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::ViewportTest)
#include "viewport_test.moc"

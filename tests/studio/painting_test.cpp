// SPDX-License-Identifier: Apache-2.0
// The painter: which wishes it paints, how large, how soon it lets go.
#include "model/painting.h"
#include "model/frame_pacer.h"

#include <QSignalSpy>
#include <QTest>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

namespace asperity::studio {
namespace {

using namespace std::chrono_literals;

/// Paints one colour, one row after the other, slowly if asked to.
class PlainPainting : public Painting {
  public:
    PlainPainting(QSize size, QColor colour, std::chrono::microseconds a_row, int passes)
        : image_(size, QImage::Format_RGB32), colour_(colour), a_row_(a_row), passes_(passes) {}

    bool pass(Run& run) override {
        for (int y = 0; y < image_.height(); ++y) {
            if (run.stop_requested()) return false;
            if (a_row_ > 0us) std::this_thread::sleep_for(a_row_);
        }
        image_.fill(colour_);
        return --passes_ > 0;
    }
    QImage image() const override { return image_; }

  private:
    QImage image_;
    QColor colour_;
    std::chrono::microseconds a_row_;
    int passes_;
};

BeginPainting plain(QColor colour, std::chrono::microseconds a_row = 0us, int passes = 1) {
    return [=](QSize size) -> std::unique_ptr<Painting> {
        return std::make_unique<PlainPainting>(size, colour, a_row, passes);
    };
}

void keep_frames(const Painter& painter, std::vector<Frame>& kept) {
    QObject::connect(&painter, &Painter::frame_ready,
                     [&kept](const Frame& frame) { kept.push_back(frame); });
}

}  // namespace

class PaintingTest : public QObject {
    Q_OBJECT

  private slots:
    void pacer_keeps_the_budget();
    void pacer_reacts_at_once_to_slower_pictures();
    void rate_counts_one_movement();
    void latest_wish_wins();
    void moving_pictures_shrink();
    void still_pictures_refine();
    void moving_breaks_off_a_still_picture();
    void changes_do_not_starve_a_still_picture();
    void stop_keeps_silent();
    void failures_are_told();
    void destructor_is_quick();
};

void PaintingTest::pacer_keeps_the_budget() {
    FramePacer pacer;
    const QSize full(1280, 720);
    // A microsecond a pixel: the budget buys 25 000 of them.
    for (int k = 0; k < 50; ++k) {
        const QSize size = pacer.moving_size(full);
        pacer.took(size, 1e-6 * size.width() * size.height());
    }
    const QSize size = pacer.moving_size(full);
    QVERIFY(std::abs(size.width() * size.height() - 25000) < 300);
    QVERIFY(std::abs(double(size.width()) / size.height() - 16.0 / 9) < 0.02);
    // Much faster ones are painted at full size, much slower ones not below an eighth.
    FramePacer fast, slow;
    for (int k = 0; k < 50; ++k) fast.took(full, 0.001);
    QCOMPARE(fast.moving_size(full), full);
    slow.took(full, 100);
    QCOMPARE(slow.moving_size(full), QSize(160, 90));
}

void PaintingTest::pacer_reacts_at_once_to_slower_pictures() {
    FramePacer pacer;
    const QSize full(1000, 1000);
    pacer.took(full, 0.001);
    pacer.took(full, 0.1);
    QCOMPARE(pacer.moving_size(full), QSize(500, 500));  // a quarter of the pixels in 25 ms
    pacer.took(full, 0.001);
    QVERIFY(pacer.moving_size(full).width() < 600);
}

void PaintingTest::rate_counts_one_movement() {
    FrameRate rate;
    QCOMPARE(rate.frames_per_second(), 0.0);
    for (int k = 0; k <= 100; ++k) rate.shown(0.02 * k, k < 50 ? 0.5 : 0.01);
    QVERIFY(std::abs(rate.frames_per_second() - 50) < 1e-6);
    rate.shown(2.02, 0.01);  // by now all of the last second took 10 ms
    QVERIFY(std::abs(rate.milliseconds_per_frame() - 10) < 1e-6);
    rate.shown(9, 0.02);
    QCOMPARE(rate.frames_per_second(), 0.0);
    QVERIFY(std::abs(rate.milliseconds_per_frame() - 20) < 1e-6);
}

void PaintingTest::latest_wish_wins() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    painter.paint(plain(Qt::black, 1ms), {40, 100}, true);
    for (int k = 0; k < 20; ++k) painter.paint(plain(Qt::red, 1ms), {40, 100}, true);
    painter.paint(plain(Qt::green), {40, 20}, false);
    QTRY_VERIFY_WITH_TIMEOUT(!frames.empty() && !frames.back().moving, 60000);
    QTest::qWait(50);
    // The frame under way, if there was one, and the last: none of those in between.
    QVERIFY(frames.size() <= 2);
    QCOMPARE(frames.back().image.size(), QSize(40, 20));
    QCOMPARE(frames.back().image.pixelColor(5, 5), QColor(Qt::green));
}

void PaintingTest::moving_pictures_shrink() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    const QSize full(400, 400);
    // Half a millisecond a row: a full picture would take 0.2 s.
    for (std::size_t k = 0; k < 8; ++k) {
        painter.paint(plain(Qt::red, 500us), full, true);
        QTRY_VERIFY_WITH_TIMEOUT(frames.size() == k + 1, 60000);
        QCOMPARE(frames.back().full, full);
        QVERIFY(frames.back().moving);
        QVERIFY(frames.back().image.width() < full.width());
    }
    // Half the width was the first guess, and took too long.
    QVERIFY(frames.front().image.width() == 200 && frames.back().image.width() < 180);
    QVERIFY(painter.milliseconds_per_frame() > 5);
    QVERIFY(painter.frames_per_second() > 1);
    painter.paint(plain(Qt::red), full, false);
    QTRY_COMPARE_WITH_TIMEOUT(frames.back().image.size(), full, 60000);
}

void PaintingTest::still_pictures_refine() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    painter.paint(plain(Qt::blue, 200us, 4), {64, 64}, false);
    QTRY_VERIFY_WITH_TIMEOUT(!frames.empty() && frames.back().passes == 4, 60000);
    QTest::qWait(50);
    QCOMPARE(frames.back().passes, 4);
    for (const Frame& frame : frames) QCOMPARE(frame.image.size(), QSize(64, 64));
    QVERIFY(frames.front().seconds < frames.back().seconds);
}

void PaintingTest::moving_breaks_off_a_still_picture() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    painter.paint(plain(Qt::blue, 100ms), {100, 100}, false);  // ten seconds of work
    QTest::qWait(50);
    QElapsedTimer clock;
    clock.start();
    painter.paint(plain(Qt::red), {100, 100}, true);
    QTRY_VERIFY_WITH_TIMEOUT(!frames.empty(), 60000);
    QVERIFY(clock.elapsed() < 1000);
    QCOMPARE(frames.front().image.pixelColor(1, 1), QColor(Qt::red));
}

void PaintingTest::changes_do_not_starve_a_still_picture() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    // Each takes 100 ms and the next is wished for after 20: pictures must come all the same.
    for (int k = 0; k < 30; ++k) {
        painter.paint(plain(Qt::blue, 1ms, 100), {100, 100}, false);
        QTest::qWait(20);
    }
    QVERIFY(frames.size() >= 2);
    for (const Frame& frame : frames) QCOMPARE(frame.passes, 1);
}

void PaintingTest::stop_keeps_silent() {
    Painter painter;
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    painter.paint(plain(Qt::blue, 1ms, 1000), {50, 50}, false);
    QTRY_VERIFY_WITH_TIMEOUT(!frames.empty(), 60000);
    painter.stop();
    const std::size_t count = frames.size();
    QTest::qWait(150);
    QCOMPARE(frames.size(), count);
    painter.paint(plain(Qt::red), {50, 50}, false);
    QTRY_COMPARE_WITH_TIMEOUT(frames.size(), count + 1, 60000);
}

void PaintingTest::failures_are_told() {
    Painter painter;
    QSignalSpy failed(&painter, &Painter::failed);
    std::vector<Frame> frames;
    keep_frames(painter, frames);
    painter.paint([](QSize) -> std::unique_ptr<Painting> { throw std::runtime_error("no paint"); },
                  {10, 10}, false);
    QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, 60000);
    QCOMPARE(failed[0][0].toString(), QString("no paint"));
    painter.paint(plain(Qt::red), {10, 10}, false);
    QTRY_COMPARE_WITH_TIMEOUT(frames.size(), std::size_t{1}, 60000);
}

void PaintingTest::destructor_is_quick() {
    auto painter = std::make_unique<Painter>();
    painter->paint(plain(Qt::blue, 5ms), {2000, 2000}, false);
    QTest::qWait(30);
    QElapsedTimer clock;
    clock.start();
    painter.reset();
    QVERIFY2(clock.elapsed() < 100, qPrintable(QString::number(clock.elapsed())));
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::PaintingTest)
#include "painting_test.moc"

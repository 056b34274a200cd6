// SPDX-License-Identifier: Apache-2.0
#include "painting.h"

#include "frame_pacer.h"

#include <QElapsedTimer>

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace asperity::studio {

namespace {

struct Wish {
    BeginPainting begin;
    QSize full;
    bool moving = false;
    std::uint64_t number = 0;
};

}  // namespace

/// The thread that paints, and the mailboxes between it and the main thread: one for the latest
/// wish, one for the latest frame. Neither can overflow when the other side is slow.
class Painter::Work {
  public:
    explicit Work(Painter& painter) : painter_(painter) {
        clock_.start();
        thread_ = std::thread([this] { work(); });
    }

    ~Work() {
        {
            const std::lock_guard lock(mutex_);
            quit_ = true;
            wish_.reset();
            interrupt();
        }
        woken_.notify_one();
        thread_.join();
    }

    std::uint64_t wish(Wish wish) {
        const std::uint64_t number = ++last_number;
        wish.number = number;
        {
            const std::lock_guard lock(mutex_);
            // A view that changes without moving, say a layer that grows, must not keep a first
            // picture from being finished; all else gives way to what is wished for now.
            if (!first_pass_ || (wish.moving && !moving_)) interrupt();
            wish_ = std::move(wish);
        }
        woken_.notify_one();
        return number;
    }

    void stop() {
        const std::lock_guard lock(mutex_);
        wish_.reset();
        frame_.reset();
        interrupt();
    }

    /// In the main thread: the frame in the mailbox, if it has not been taken back.
    std::optional<Frame> take_frame() {
        const std::lock_guard lock(mutex_);
        std::optional<Frame> frame = std::move(frame_);
        frame_.reset();
        return frame;
    }

    double now() const { return 1e-9 * static_cast<double>(clock_.nsecsElapsed()); }

    // Main thread only.
    FrameRate rate;
    bool last_moving = false;
    double last_seconds = 0;
    std::uint64_t last_number = 0;

  private:
    void interrupt() {
        if (run_) run_->request_stop();
    }

    /// The next wish, or none when it is time to quit.
    std::optional<Wish> wait_for_wish() {
        std::unique_lock lock(mutex_);
        woken_.wait(lock, [this] { return quit_ || wish_; });
        if (quit_) return std::nullopt;
        std::optional<Wish> wish = std::move(wish_);
        wish_.reset();
        return wish;
    }

    void work() {
        while (const std::optional<Wish> wish = wait_for_wish()) {
            try {
                paint(*wish);
            } catch (const std::exception& error) {
                const QString sentence = QString::fromUtf8(error.what());
                QMetaObject::invokeMethod(
                    &painter_, [this, sentence] { emit painter_.failed(sentence); },
                    Qt::QueuedConnection);
            }
        }
    }

    void paint(const Wish& wish) {
        const QSize size = wish.moving ? pacer_.moving_size(wish.full) : wish.full;
        const double began = now();
        const std::unique_ptr<Painting> painting = wish.begin(size);
        bool more = true;
        for (int passes = 1; more; ++passes) {
            Run run;
            const CurrentRun current(*this, run, passes == 1, wish.moving);
            more = painting->pass(run) && !wish.moving;
            if (run.stop_requested()) return;
            const double seconds = now() - began;
            if (wish.moving || (passes == 1 && !pacer_.knows())) pacer_.took(size, seconds);
            deliver({painting->image(), wish.full, passes, painting->samples(passes), wish.moving,
                     wish.number, seconds});
        }
    }

    /// Lets the main thread interrupt a pass as long as it lasts.
    class CurrentRun {
      public:
        CurrentRun(Work& work, Run& run, bool first, bool moving) : work_(work) {
            const std::lock_guard lock(work_.mutex_);
            if (work_.quit_ || (!first && work_.wish_)) run.request_stop();
            work_.run_ = &run;
            work_.first_pass_ = first;
            work_.moving_ = moving;
        }
        ~CurrentRun() {
            const std::lock_guard lock(work_.mutex_);
            work_.run_ = nullptr;
        }
        CurrentRun(const CurrentRun&) = delete;
        CurrentRun& operator=(const CurrentRun&) = delete;

      private:
        Work& work_;
    };

    void deliver(Frame frame) {
        {
            const std::lock_guard lock(mutex_);
            const bool told = frame_.has_value();
            frame_ = std::move(frame);
            if (told) return;
        }
        QMetaObject::invokeMethod(
            &painter_, [this] { show(); }, Qt::QueuedConnection);
    }

    /// In the main thread.
    void show() {
        const std::optional<Frame> frame = take_frame();
        if (!frame) return;
        if (frame->moving) rate.shown(now(), frame->seconds);
        last_seconds = frame->passes == 1 ? frame->seconds : frame->seconds - since_;
        since_ = frame->seconds;
        last_moving = frame->moving;
        emit painter_.frame_ready(*frame);
    }

    Painter& painter_;
    QElapsedTimer clock_;
    FramePacer pacer_;  // of the thread
    double since_ = 0;  // main thread: `seconds` of the frame before

    std::mutex mutex_;  // guards the rest
    std::condition_variable woken_;
    std::optional<Wish> wish_;
    std::optional<Frame> frame_;
    Run* run_ = nullptr;
    bool first_pass_ = false, moving_ = false;  // of run_
    bool quit_ = false;
    std::thread thread_;
};

Painter::Painter(QObject* parent) : QObject(parent), work_(std::make_unique<Work>(*this)) {}

Painter::~Painter() = default;

std::uint64_t Painter::paint(BeginPainting begin, QSize full, bool moving) {
    return work_->wish({std::move(begin), full.expandedTo({1, 1}), moving, 0});
}

void Painter::stop() {
    work_->stop();
}

double Painter::frames_per_second() const {
    if (work_->last_moving) return work_->rate.frames_per_second();
    return work_->last_seconds > 0 ? 1 / work_->last_seconds : 0;
}

double Painter::milliseconds_per_frame() const {
    if (work_->last_moving) return work_->rate.milliseconds_per_frame();
    return 1000 * work_->last_seconds;
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/run.h>

#include <algorithm>
#include <thread>

namespace asperity {

Run::Run(int threads)
    : threads_(threads > 0 ? threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {}

void Run::request_pause() noexcept {
    const std::scoped_lock lock(mutex_);
    if (paused_) return;
    pause_began_ = Clock::now();
    paused_ = true;
}

void Run::resume() noexcept {
    const std::scoped_lock lock(mutex_);
    if (!paused_) return;
    paused_for_ += Clock::now() - pause_began_;
    paused_ = false;
}

bool Run::keep_going() const {
    // A stop may come from a signal handler, which cannot wake anybody: look for it
    while (paused()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return !stop_requested();
}

void Run::begin(std::string stage, std::uint64_t total) {
    {
        const std::scoped_lock lock(mutex_);
        stage_ = std::move(stage);
        begin_ = last_notice_ = Clock::now();
        pause_began_ = begin_;
        paused_for_ = {};
        done_ = 0;
        total_ = total;
    }
    notify();
}

void Run::set_total(std::uint64_t total) {
    total_ = total;
}

void Run::advance(std::uint64_t done) {
    done_ += done;
    {
        const std::scoped_lock lock(mutex_);
        const auto now = Clock::now();
        if (now - last_notice_ < std::chrono::milliseconds(100)) return;
        last_notice_ = now;
    }
    notify();
}

void Run::end() {
    if (!stop_requested()) done_ = total_.load();
    notify();
}

/// Of the time since the stage began, what was no pause. The caller holds the lock.
Run::Clock::duration Run::time_worked(Clock::time_point until) const {
    return (paused_ ? pause_began_ : until) - begin_ - paused_for_;
}

Progress Run::progress() const {
    const std::scoped_lock lock(mutex_);
    Progress p;
    p.stage = stage_;
    p.total = total_;
    p.done = std::min<std::uint64_t>(done_, p.total);
    p.seconds = std::chrono::duration<double>(time_worked(Clock::now())).count();
    p.per_second = p.seconds > 0 ? static_cast<double>(p.done) / p.seconds : 0;
    p.seconds_left = p.per_second > 0 ? static_cast<double>(p.total - p.done) / p.per_second : 0;
    return p;
}

void Run::notify() {
    if (!listener_) return;
    const std::scoped_lock lock(listener_mutex_);
    listener_(progress());
}

}  // namespace asperity

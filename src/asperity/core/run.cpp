// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/run.h>

#include <algorithm>
#include <thread>

namespace asperity {

Run::Run(int threads)
    : threads_(threads > 0 ? threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {}

void Run::begin(std::string stage, std::uint64_t total) {
    {
        const std::scoped_lock lock(mutex_);
        stage_ = std::move(stage);
        begin_ = last_notice_ = Clock::now();
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

Progress Run::progress() const {
    const std::scoped_lock lock(mutex_);
    Progress p;
    p.stage = stage_;
    p.total = total_;
    p.done = std::min<std::uint64_t>(done_, p.total);
    p.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
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

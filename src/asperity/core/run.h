// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

namespace asperity {

/// How far a Run has come.
struct Progress {
    std::string stage;        ///< what is being done, e.g. "tracing"
    std::uint64_t done = 0;   ///< never decreases within a stage; equals total at its end
    std::uint64_t total = 0;  ///< may grow while a run refines until an error is reached
    double seconds = 0;       ///< since the stage began, pauses left out
    double per_second = 0;    ///< done / seconds
    double seconds_left = 0;  ///< at the present rate
};

/// What a long task shares with its caller: the number of threads, wishes to stop or to pause, the
/// progress.
///
/// request_stop() may be called from any thread and from a signal handler. Everything else is safe
/// to call from any thread. One Run serves one task at a time.
class Run {
  public:
    using Listener = std::function<void(const Progress&)>;

    /// `threads` = 0 takes as many as the machine has.
    explicit Run(int threads = 0);

    int threads() const noexcept { return threads_; }

    void request_stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
    bool stop_requested() const noexcept { return stop_.load(std::memory_order_relaxed); }

    /// The task stands still at its next keep_going() until resume() or a stop; its threads stay
    /// with it. Pauses are no part of Progress::seconds. Asking twice is asking once.
    void request_pause() noexcept;
    void resume() noexcept;
    /// A pause is asked for and no stop has ended it.
    bool paused() const noexcept { return paused_.load() && !stop_requested(); }
    /// For the task, between pieces of work of a few milliseconds: waits while paused, then says
    /// whether to go on. False once a stop is requested, which ends a pause within 10 ms.
    bool keep_going() const;

    /// Called about ten times a second, and once at the end of each stage, from a thread of the
    /// task, never from two at once. Set it before the task starts.
    void on_progress(Listener listener) { listener_ = std::move(listener); }

    void begin(std::string stage, std::uint64_t total);
    void set_total(std::uint64_t total);
    void advance(std::uint64_t done);
    /// Ends the stage: tells the listener, with done = total unless the run was stopped.
    void end();

    Progress progress() const;

  private:
    using Clock = std::chrono::steady_clock;
    void notify();
    Clock::duration time_worked(Clock::time_point until) const;

    int threads_;
    std::atomic<bool> stop_{false}, paused_{false};
    std::atomic<std::uint64_t> done_{0}, total_{0};
    mutable std::mutex mutex_;
    std::mutex listener_mutex_;
    std::string stage_;
    Clock::time_point begin_ = Clock::now(), last_notice_ = begin_, pause_began_;
    Clock::duration paused_for_{};  ///< in this stage, by the pauses that are over
    Listener listener_;
};

}  // namespace asperity

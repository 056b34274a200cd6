// SPDX-License-Identifier: Apache-2.0
// How Python waits for a long task: the work is done by a thread of its own, the caller looks after
// signals and callbacks meanwhile.
#pragma once

#include <asperity/core/run.h>
#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace asperity::python {

namespace nb = nanobind;

/// What a caller may ask for: `progress(stage, done, total, seconds, seconds_left)`, called about
/// ten times a second, and `stop()`, asked fifty times a second, true to stop. None: neither.
struct Callbacks {
    nb::object progress, stop;

    // From the thread that holds the GIL.
    void tell(const Run& run) const {
        if (progress.is_none()) return;
        const Progress p = run.progress();
        progress(p.stage, p.done, p.total, p.seconds, p.seconds_left);
    }
    bool wants_stop() const { return !stop.is_none() && nb::cast<bool>(stop()); }
};

/// What came of a task. `interrupted`: by Ctrl-C, which the caller must tell or raise.
template <typename Result>
struct Outcome {
    Result value;
    bool interrupted = false;
};

/// Does `work` on a thread without the GIL. Signals are looked after every 20 ms: whatever a signal
/// handler or a callback raises stops the run and is raised again when the work has ended, but for
/// KeyboardInterrupt where the work still gave a result: that comes back as `interrupted`.
template <typename Work>
auto run_task(Run& run, const Callbacks& callbacks, Work&& work) {
    using Result = decltype(work());
    constexpr auto kPatience = std::chrono::milliseconds(20);
    constexpr int kTellEvery = 5;  // of the above: ten times a second

    std::optional<Result> result;
    std::exception_ptr failure;
    std::mutex mutex;
    std::condition_variable ready;
    bool done = false;
    std::thread worker([&] {
        try {
            result.emplace(work());
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        done = true;
        ready.notify_all();
    });

    std::optional<nb::python_error> raised;
    for (int turn = 1;; ++turn) {
        {
            const nb::gil_scoped_release free;
            std::unique_lock lock(mutex);
            if (ready.wait_for(lock, kPatience, [&] { return done; })) break;
        }
        if (raised) continue;
        try {
            if (PyErr_CheckSignals() != 0) throw nb::python_error();
            if (turn % kTellEvery == 0) callbacks.tell(run);
            if (callbacks.wants_stop()) run.request_stop();
        } catch (nb::python_error& error) {
            raised.emplace(std::move(error));
            run.request_stop();
        }
    }
    worker.join();
    // A finished task is told once more, all done
    if (!failure && !raised) callbacks.tell(run);

    const bool interrupted = raised && raised->matches(PyExc_KeyboardInterrupt);
    if (raised && (failure || !interrupted)) throw std::move(*raised);
    if (failure) std::rethrow_exception(failure);
    return Outcome<Result>{std::move(*result), interrupted};
}

}  // namespace asperity::python

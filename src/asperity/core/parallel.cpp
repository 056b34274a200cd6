// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace asperity {

namespace {

constexpr std::size_t kTasksAtOnce = 4;

/// How many threads the system lets this process have: limits on processes or memory may allow
/// fewer than asked for, which would end the program inside TBB. Known for the process as a whole,
/// as TBB's threads are.
class ThreadsToBeHad {
  public:
    /// The caller's thread included; at most `wanted`, at least 1.
    int of(int wanted) {
        if (wanted <= proven_) return wanted;
        const std::scoped_lock lock(mutex_);
        if (!ceiling_ && wanted > proven_) {
            proven_ = std::max(proven_.load(), 1 + made(wanted - 1));
            // From now on no more are tried, whoever asks TBB
            if (proven_ < wanted)
                ceiling_ = std::make_unique<tbb::global_control>(
                    tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(proven_.load()));
        }
        return std::min(wanted, proven_.load());
    }

  private:
    /// Makes so many at once, or as many as there can be, and lets them go.
    static int made(int count) {
        std::atomic<bool> enough = false;
        std::vector<std::thread> threads;
        try {
            while (static_cast<int>(threads.size()) < count)
                threads.emplace_back([&enough] { enough.wait(false); });
        } catch (const std::system_error&) {
            // As many as there are, then
        }
        enough = true;
        enough.notify_all();
        for (std::thread& thread : threads) thread.join();
        return static_cast<int>(threads.size());
    }

    std::atomic<int> proven_ = 1;
    std::mutex mutex_;
    std::unique_ptr<tbb::global_control> ceiling_;
};

int threads_to_be_had(int wanted) {
    static ThreadsToBeHad threads;
    return threads.of(wanted);
}

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    if (threads > 1 && count > 1) threads = threads_to_be_had(threads);
    if (threads <= 1 || count <= 1) {
        for (std::size_t k = 0; k < count; ++k) body(k);
        return;
    }
    // The least of all such limits counts, for all tasks together: it leaves room for some that run
    // at the same time. A paused one keeps its threads, and a picture must go on being painted.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    kTasksAtOnce * static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(
        [&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace asperity {

namespace {
constexpr std::size_t kTasksAtOnce = 4;
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
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

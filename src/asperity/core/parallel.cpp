// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace asperity {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr first_error;
    const auto work = [&] {
        try {
            for (std::size_t k = next++; k < count; k = next++) body(k);
        } catch (...) {
            next = count;
            const std::scoped_lock lock(mutex);
            if (!first_error) first_error = std::current_exception();
        }
    };
    {
        const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
        std::vector<std::jthread> others;
        try {
            while (others.size() + 1 < wanted) others.emplace_back(work);
        } catch (const std::exception&) {
            // The system gives no more: those there are do it all
        }
        work();
    }
    if (first_error) std::rethrow_exception(first_error);
}

}  // namespace asperity

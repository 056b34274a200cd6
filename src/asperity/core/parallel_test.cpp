// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace asperity {
namespace {

/// A place where a number of threads meet; false for those who wait in vain.
class Meeting {
  public:
    bool arrive(int expected) {
        std::unique_lock lock(mutex_);
        ++here_;
        met_.notify_all();
        return met_.wait_for(lock, std::chrono::seconds(20), [&] { return here_ >= expected; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable met_;
    int here_ = 0;
};

TEST(ParallelFor, CallsTheBodyOnceForEach) {
    for (const int threads : {1, 2, 7}) {
        std::vector<int> calls(1000);
        parallel_for(calls.size(), threads, [&](std::size_t k) { ++calls[k]; });
        EXPECT_EQ(calls, std::vector<int>(1000, 1));
    }
}

TEST(ParallelFor, ThrowsWhatABodyThrows) {
    for (const int threads : {1, 3})
        EXPECT_THROW(parallel_for(100, threads,
                                  [](std::size_t k) {
                                      if (k == 50) throw std::runtime_error("fifty");
                                  }),
                     std::runtime_error);
}

// A paused task keeps its threads; the next one must not be left with a single one.
TEST(ParallelFor, TasksDoNotTakeEachOthersThreads) {
    Meeting first_works, second_is_done;
    std::thread first([&] {
        parallel_for(2, 2, [&](std::size_t) {
            EXPECT_TRUE(first_works.arrive(3));
            EXPECT_TRUE(second_is_done.arrive(3));
        });
    });
    EXPECT_TRUE(first_works.arrive(3));
    Meeting second_works;
    parallel_for(2, 2, [&](std::size_t) { EXPECT_TRUE(second_works.arrive(2)); });
    second_is_done.arrive(3);
    first.join();
}

}  // namespace
}  // namespace asperity

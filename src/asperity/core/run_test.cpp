// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace asperity {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const int threads : {1, 2, 3, 7}) {
        std::vector<std::atomic<int>> visits(1000);
        parallel_for(visits.size(), threads, [&](std::size_t k) { ++visits[k]; });
        for (const auto& n : visits) EXPECT_EQ(n, 1);
    }
}

TEST(ParallelFor, HandsOnTheFirstException) {
    for (const int threads : {1, 3})
        EXPECT_THROW(parallel_for(100, threads,
                                  [](std::size_t k) {
                                      if (k == 37) throw Error(ErrorCode::Stopped, "enough");
                                  }),
                     Error);
}

TEST(Run, ProgressNeverDecreasesAndEndsAtTheTotal) {
    asperity::Run run(1);  // testing::Test has a Run of its own
    std::vector<Progress> seen;
    run.on_progress([&](const Progress& p) { seen.push_back(p); });
    run.begin("work", 100);
    for (int k = 0; k < 99; ++k) run.advance(1);
    run.end();
    ASSERT_GE(seen.size(), 2u);
    for (std::size_t k = 1; k < seen.size(); ++k) EXPECT_GE(seen[k].done, seen[k - 1].done);
    EXPECT_EQ(seen.back().done, 100u);
    EXPECT_EQ(seen.back().total, 100u);
    EXPECT_EQ(seen.back().stage, "work");
}

TEST(Run, AStoppedRunSaysHowFarItCame) {
    asperity::Run run(1);  // testing::Test has a Run of its own
    run.begin("work", 100);
    run.advance(40);
    run.request_stop();
    run.end();
    EXPECT_EQ(run.progress().done, 40u);
}

TEST(Error, NamesThePlaceOnce) {
    const Error e(ErrorCode::InvalidInput, "face refers to vertex 99", "bunny.obj:1423");
    EXPECT_STREQ(e.what(), "bunny.obj:1423: face refers to vertex 99");
    EXPECT_STREQ(Error(ErrorCode::Usage, "no such layer").what(), "no such layer");
}

}  // namespace
}  // namespace asperity

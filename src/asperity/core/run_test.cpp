// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
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

void wait_a_little(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// A task of many small pieces on two threads, and how many are done.
class PiecesOfWork {
  public:
    explicit PiecesOfWork(asperity::Run& run)
        : thread_([this, &run] {
              run.begin("work", kPieces);
              parallel_for(kPieces, 2, [&](std::size_t) {
                  if (!run.keep_going()) return;
                  wait_a_little(1);
                  ++done;
                  run.advance(1);
              });
              run.end();
              ended = true;
          }) {}
    ~PiecesOfWork() { thread_.join(); }

    static constexpr int kPieces = 400;
    std::atomic<int> done{0};
    std::atomic<bool> ended{false};

  private:
    std::thread thread_;
};

TEST(Run, APausedTaskStandsStillUntilItIsResumed) {
    asperity::Run run(2);
    PiecesOfWork work(run);
    while (work.done < 20) wait_a_little(1);
    run.request_pause();
    EXPECT_TRUE(run.paused());
    wait_a_little(100);  // the pieces under way
    const int standing = work.done;
    wait_a_little(150);
    EXPECT_EQ(work.done, standing);
    EXPECT_LT(standing, PiecesOfWork::kPieces);
    run.resume();
    EXPECT_FALSE(run.paused());
    while (!work.ended) wait_a_little(1);
    EXPECT_EQ(work.done, PiecesOfWork::kPieces);
    EXPECT_EQ(run.progress().done, std::uint64_t{PiecesOfWork::kPieces});
}

TEST(Run, AStopEndsAPause) {
    asperity::Run run(2);
    run.request_pause();  // before the task has begun
    PiecesOfWork work(run);
    wait_a_little(50);
    EXPECT_EQ(work.done, 0);
    EXPECT_FALSE(work.ended);
    const auto asked = std::chrono::steady_clock::now();
    run.request_stop();
    EXPECT_FALSE(run.paused());
    while (!work.ended) wait_a_little(1);
    EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::milliseconds(100));
    EXPECT_EQ(work.done, 0);
}

TEST(Run, PausesAreNoPartOfTheTime) {
    asperity::Run run(1);
    const auto begin = std::chrono::steady_clock::now();
    run.begin("work", 100);
    wait_a_little(20);
    run.advance(50);
    for (int pause = 0; pause < 2; ++pause) {
        run.request_pause();
        run.request_pause();  // asking twice is asking once
        const Progress then = run.progress();
        wait_a_little(200);
        const Progress now = run.progress();
        EXPECT_EQ(now.seconds, then.seconds);
        EXPECT_EQ(now.seconds_left, then.seconds_left);
        run.resume();
        run.resume();
    }
    wait_a_little(20);
    const double seconds = run.progress().seconds;
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    EXPECT_GE(seconds, 0.04);
    EXPECT_LE(seconds, all.count() - 0.4);

    // A stage that begins during a pause
    run.request_pause();
    run.begin("more work", 100);
    wait_a_little(50);
    EXPECT_EQ(run.progress().seconds, 0);
}

TEST(Error, NamesThePlaceOnce) {
    const Error e(ErrorCode::InvalidInput, "face refers to vertex 99", "bunny.obj:1423");
    EXPECT_STREQ(e.what(), "bunny.obj:1423: face refers to vertex 99");
    EXPECT_STREQ(Error(ErrorCode::Usage, "no such layer").what(), "no such layer");
}

}  // namespace
}  // namespace asperity

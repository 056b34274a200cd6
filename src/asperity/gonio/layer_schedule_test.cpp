// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/layer_schedule.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>
#include <utility>

namespace asperity {
namespace {

using Piece = LayerSchedule::Piece;

void expect_prepare(const std::optional<Piece>& piece, std::size_t layer) {
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->kind, Piece::Kind::Prepare);
    EXPECT_EQ(piece->layer, layer);
}
void expect_trace(const std::optional<Piece>& piece, std::size_t layer, std::uint64_t batch) {
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->kind, Piece::Kind::Trace);
    EXPECT_EQ(piece->layer, layer);
    EXPECT_EQ(piece->batch, batch);
}

TEST(LayerSchedule, PreparesALayerWhileTheOneBeforeIsTraced) {
    LayerSchedule schedule({2, 2, 2});
    expect_prepare(schedule.next(), 0);
    schedule.prepared(0);
    expect_prepare(schedule.next(), 1);
    expect_trace(schedule.next(), 0, 0);
    expect_trace(schedule.next(), 0, 1);
    EXPECT_FALSE(schedule.traced(0));
    // The last batch of a layer is under way: the next layer begins
    expect_prepare(schedule.next(), 2);
    schedule.prepared(1);
    expect_trace(schedule.next(), 1, 0);
    EXPECT_TRUE(schedule.traced(0));
    schedule.close();
    expect_trace(schedule.next(), 1, 1);
    EXPECT_FALSE(schedule.traced(1));
    EXPECT_TRUE(schedule.traced(1));
    schedule.close();
    schedule.prepared(2);
    expect_trace(schedule.next(), 2, 0);
    expect_trace(schedule.next(), 2, 1);
    EXPECT_FALSE(schedule.traced(2));
    EXPECT_TRUE(schedule.traced(2));
    schedule.close();
    EXPECT_FALSE(schedule.next());
}

TEST(LayerSchedule, AnExtendedLayerComesFirst) {
    LayerSchedule schedule({1, 1});
    expect_prepare(schedule.next(), 0);
    schedule.prepared(0);
    expect_prepare(schedule.next(), 1);
    schedule.prepared(1);
    expect_trace(schedule.next(), 0, 0);
    EXPECT_TRUE(schedule.traced(0));
    schedule.extend(0, 2);
    expect_trace(schedule.next(), 0, 1);
    expect_trace(schedule.next(), 0, 2);
    expect_trace(schedule.next(), 1, 0);
}

TEST(LayerSchedule, NobodyWaitsForOneWhoGaveUp) {
    LayerSchedule schedule(std::vector<std::uint64_t>{1});
    expect_prepare(schedule.next(), 0);
    std::atomic<bool> answered = false;
    std::thread waiting([&] {
        EXPECT_FALSE(schedule.next());
        answered = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(answered);
    schedule.give_up();
    waiting.join();
    EXPECT_FALSE(schedule.next());
}

TEST(LayerSchedule, ManyThreadsDoEachPieceOnce) {
    constexpr std::size_t kLayers = 40;
    constexpr std::uint64_t kBatches = 3;
    LayerSchedule schedule(std::vector(kLayers, kBatches));
    std::mutex mutex;
    std::set<std::pair<std::size_t, std::uint64_t>> traced;
    std::set<std::size_t> prepared, extended;
    const auto work = [&] {
        while (const auto piece = schedule.next()) {
            if (piece->kind == Piece::Kind::Prepare) {
                {
                    const std::scoped_lock lock(mutex);
                    EXPECT_TRUE(prepared.insert(piece->layer).second);
                }
                schedule.prepared(piece->layer);
                continue;
            }
            bool extend = false;
            {
                const std::scoped_lock lock(mutex);
                EXPECT_TRUE(prepared.count(piece->layer));
                EXPECT_TRUE(traced.emplace(piece->layer, piece->batch).second);
            }
            if (!schedule.traced(piece->layer)) continue;
            {
                const std::scoped_lock lock(mutex);
                extend = piece->layer % 3 == 0 && extended.insert(piece->layer).second;
            }
            if (extend)
                schedule.extend(piece->layer, 2);
            else
                schedule.close();
        }
    };
    std::vector<std::thread> threads;
    for (int k = 0; k < 7; ++k) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(prepared.size(), kLayers);
    EXPECT_EQ(traced.size(), kLayers * kBatches + 2 * extended.size());
    EXPECT_EQ(extended.size(), (kLayers + 2) / 3);
}

}  // namespace
}  // namespace asperity

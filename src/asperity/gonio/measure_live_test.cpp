// SPDX-License-Identifier: Apache-2.0
//
// Measurements that are stopped, paused and watched.
#include <asperity/gonio/test_measurements.h>

#include <chrono>
#include <thread>

namespace asperity {
namespace {

using test::expect_same_bits;
using test::gold_like;
using test::measured;
using test::noise;
using test::small_experiment;

TEST(Measure, StopsWithinATenthOfASecond) {
    const Heightfield s = noise(128, 5);
    Experiment e;
    e.run.rays = 500000000;
    e.run.bounces = 100;
    asperity::Run run(2);
    std::chrono::steady_clock::time_point asked;
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        asked = std::chrono::steady_clock::now();
        run.request_stop();
    });
    const Measurement m = measure(s, e, run);
    const auto answered = std::chrono::steady_clock::now();
    stopper.join();
    EXPECT_TRUE(m.stopped);
    EXPECT_LT(std::chrono::duration<double>(answered - asked).count(), 0.25);  // 100 ms, shared CPU
    for (const Layer& layer : m.layers)
        EXPECT_EQ(layer.escaped[0] + layer.truncated[0], layer.rays << 32);
}

/// Asks something of a run a little later, from another thread.
template <class Ask>
std::thread later(int milliseconds, Ask ask) {
    return std::thread([=] {
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        ask();
    });
}

TEST(Measure, APauseChangesNothingButTheTime) {
    const Heightfield s = noise(128, 5);
    Experiment e;
    e.illumination.theta_deg = {0, 50};
    e.run.rays = 3000000;
    e.run.bounces = 10;
    asperity::Run run(2);
    std::uint64_t standing = 0, later_on = 0;
    bool paused = false;
    std::thread pauser = later(50, [&] {
        run.request_pause();
        std::this_thread::sleep_for(std::chrono::milliseconds(150));  // the waves under way
        standing = run.progress().done;
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        later_on = run.progress().done;
        paused = run.progress().done < run.progress().total;
        run.resume();
    });
    const auto begin = std::chrono::steady_clock::now();
    const Measurement m = measure(s, e, run);
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    pauser.join();
    ASSERT_TRUE(paused);
    EXPECT_EQ(standing, later_on);
    EXPECT_LE(m.trace_seconds, all.count() - 0.5);
    EXPECT_FALSE(m.stopped);
    expect_same_bits(m, measured(s, e));
}

TEST(Measure, AStopEndsAPause) {
    const Heightfield s = noise(128, 5);
    Experiment e;
    e.run.rays = 500000000;
    asperity::Run run(2);
    std::chrono::steady_clock::time_point asked;
    std::thread stopper = later(300, [&] {
        run.request_pause();
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        asked = std::chrono::steady_clock::now();
        run.request_stop();
    });
    EXPECT_TRUE(measure(s, e, run).stopped);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - asked;
    stopper.join();
    EXPECT_LT(took.count(), 0.25);  // 100 ms, shared CPU
}

TEST(Measure, StopsBeforeItHasBegun) {
    asperity::Run run(2);
    run.request_stop();
    bool begun = false;
    const Measurement m =
        measure(noise(64, 5), Experiment{}, run, {[&](const Measurement&) { begun = true; }, {}});
    EXPECT_TRUE(m.stopped);
    EXPECT_TRUE(m.layers.empty());
    EXPECT_FALSE(begun);
}

TEST(Measure, StopsWhilePreparing) {
    const Heightfield s = noise(2048, 5);
    asperity::Run run(2);
    std::chrono::steady_clock::time_point asked;
    run.on_progress([&](const Progress& p) {
        if (p.stage != "preparing" || p.done < p.total / 4 || run.stop_requested()) return;
        asked = std::chrono::steady_clock::now();
        run.request_stop();
    });
    const Measurement m = measure(s, Experiment{}, run);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - asked;
    EXPECT_TRUE(m.stopped);
    EXPECT_TRUE(m.layers.empty());
    EXPECT_EQ(run.progress().stage, "preparing");
    EXPECT_LT(run.progress().done, run.progress().total);
    EXPECT_LT(took.count(), 0.25);  // 100 ms, shared CPU
}

/// What a listener was told, in its order.
struct Told {
    int heads = 0;
    std::vector<Layer> growing, complete;
    bool out_of_order = false;

    MeasureListener listener() {
        return {[this](const Measurement& head) {
                    ++heads;
                    out_of_order |= !head.layers.empty() || !growing.empty() || !complete.empty();
                    EXPECT_EQ(head.channel_names.size(), 3u);
                    EXPECT_EQ(head.surface_nx, 128);
                    EXPECT_GT(head.surface.rms_height, 0);
                },
                [this](const Layer& layer, bool is_complete) {
                    // Nothing more of a layer once it is complete, and never less than before
                    out_of_order |= heads != 1;
                    for (const Layer& done : complete) out_of_order |= layer.number == done.number;
                    if (!growing.empty() && growing.back().number == layer.number)
                        out_of_order |= layer.rays < growing.back().rays;
                    (is_complete ? complete : growing).push_back(layer);
                }};
    }
};

TEST(Measure, AListenerSeesLayersGrow) {
    const Heightfield s = noise(128, 3);
    Experiment e = small_experiment();
    e.optics = gold_like();
    e.illumination.theta_deg = {};
    e.illumination.layers = 4;
    e.run.rays = 1000000;
    e.run.batches = 64;
    const Measurement silent = measured(s, e);
    for (const int threads : {1, 2, 3}) {
        Told told;
        asperity::Run run(threads);
        const auto begin = std::chrono::steady_clock::now();
        const Measurement m = measure(s, e, run, told.listener());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        EXPECT_FALSE(told.out_of_order);
        // The complete ones are those of the result, from normal incidence down
        ASSERT_EQ(told.complete.size(), 4u);
        Measurement shown = m;
        shown.layers = told.complete;
        expect_same_bits(shown, m);
        expect_same_bits(silent, m);
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_EQ(told.complete[k].number, 4 - static_cast<int>(k));
        // Ten a second at most, each of them a layer in itself
        EXPECT_GE(told.growing.size(), 1u);
        EXPECT_LE(static_cast<double>(told.growing.size()), 1 + 10 * took.count());
        for (const Layer& layer : told.growing) {
            EXPECT_GE(layer.batches, 2);
            EXPECT_LE(layer.rays, e.run.rays);
            EXPECT_EQ(layer.stderr_albedo.size(), 3u);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_EQ(layer.escaped[c] + layer.absorbed[c] + layer.truncated[c],
                          layer.rays << 32);
        }
    }
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
//
// However a measurement is divided, by stops, parts or refinement, the same comes out.
#include <asperity/core/error.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/merge.h>
#include <asperity/gonio/test_measurements.h>
#include <asperity/tracing/engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace asperity {
namespace {

using test::expect_same_bits;
using test::measured;

/// Batches of unequal sizes, in gold.
Experiment experiment() {
    Experiment e = test::small_experiment();
    e.illumination.theta_deg = {0, 30, 60};
    e.optics = test::gold_like();
    e.run.rays = 20005;
    return e;
}

/// The same, going on until the albedo is so much better known than after one round.
Experiment until(const Heightfield& surface, Experiment e, double factor) {
    const Measurement one = measured(surface, e);
    for (const Layer& layer : one.layers)
        for (int c = 0; c < one.channels(); ++c)
            e.run.until = std::max(
                e.run.until, factor * layer.stderr_albedo[std::size_t(c)] / one.albedo(layer, c));
    e.run.until_cells = 0.9;
    return e;
}

/// Everything that was seen at checkpoints, one after each batch.
std::vector<Measurement> checkpoints(const Heightfield& surface, const Experiment& e) {
    std::vector<Measurement> seen;
    MeasureListener listener;
    listener.checkpoint = [&](const Measurement& m) { seen.push_back(m); };
    listener.checkpoint_period = std::chrono::milliseconds(0);
    asperity::Run run(2);
    measure(surface, e, run, listener);
    return seen;
}

void expect_same_result(const Measurement& a, const Measurement& b) {
    expect_same_bits(a, b);
    EXPECT_EQ(a.stopped, b.stopped);
    EXPECT_EQ(a.notes, b.notes);
    for (std::size_t k = 0; k < a.layers.size(); ++k)
        EXPECT_TRUE(a.layers[k].spread.squares == b.layers[k].spread.squares);
}

TEST(MeasureScope, GoesOnFromAnyCheckpoint) {
    const Heightfield surface = test::noise(64, 2);
    for (const bool refining : {false, true}) {
        const Experiment e = refining ? until(surface, experiment(), 0.4) : experiment();
        const Measurement whole = measured(surface, e);
        const std::vector<Measurement> seen = checkpoints(surface, e);
        ASSERT_FALSE(seen.empty());  // how many depends on the time that each takes
        for (std::size_t k = 0; k < seen.size(); k += 1 + seen.size() / 6) {
            EXPECT_TRUE(seen[k].stopped);
            expect_same_result(measured(surface, e, {.so_far = seen[k]}, 1 + int(k) % 3), whole);
        }
        // What is complete stays
        expect_same_result(measured(surface, e, {.so_far = whole}), whole);
    }
}

TEST(MeasureScope, PartsAddUpInAnyOrder) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment e = experiment();
    const Measurement whole = measured(surface, e);
    for (const int parts : {2, 7, 60}) {
        std::vector<Measurement> pieces;
        for (int k = 1; k <= parts; ++k)
            pieces.push_back(measured(surface, e, {.part = k, .parts = parts}));
        for (int order = 0; order < 3; ++order) {
            if (order == 1) std::reverse(pieces.begin(), pieces.end());
            if (order == 2) std::rotate(pieces.begin(), pieces.begin() + 1, pieces.end());
            Merge merge;
            for (const Measurement& piece : pieces) merge.add(piece, "part");
            expect_same_bits(merge.finish(), whole);
        }
    }
}

TEST(MeasureScope, APartGoesOnFromItsCheckpoint) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment e = experiment();
    std::vector<Measurement> seen;
    MeasureListener listener;
    listener.checkpoint = [&](const Measurement& m) { seen.push_back(m); };
    listener.checkpoint_period = std::chrono::milliseconds(0);
    asperity::Run run(1);
    const Measurement part = measure(surface, e, run, listener, {.part = 2, .parts = 3});
    ASSERT_FALSE(seen.empty());
    seen.push_back(part);  // killed when all was done: a layer that is complete keeps its share
    for (const Measurement& so_far : seen)
        expect_same_result(measured(surface, e, {.so_far = so_far, .part = 2, .parts = 3}), part);
}

TEST(MeasureScope, RefiningGivesWhatAskingAtOnceGives) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment once = experiment(), coarse = until(surface, once, 0.7),
                     fine = until(surface, once, 0.3);
    const Measurement at_once = measured(surface, fine);
    ASSERT_GT(at_once.layers.back().batches, 16);
    for (const Experiment& before : {once, coarse, fine})
        expect_same_result(measured(surface, fine, {.so_far = measured(surface, before)}), at_once);
}

/// As many machines do it: each round is shared, and all go on from the sum.
TEST(MeasureScope, RoundsOfPartsReachTheSameAccuracy) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment e = until(surface, experiment(), 0.3);
    const Measurement at_once = measured(surface, e);
    ASSERT_GT(at_once.layers.back().batches, 16);
    for (const int parts : {1, 3, 40}) {
        // A single machine, that has no others to wait for, refines from what it has to go on from
        Measurement so_far = measured(surface, experiment());
        so_far.experiment.run.until = e.run.until;
        so_far.experiment.run.until_cells = e.run.until_cells;
        int round = 0;
        do {
            ASSERT_LT(round, 12);
            Merge merge;
            merge.add(so_far, "so far");
            for (int k = 1; k <= parts; ++k) {
                MeasureScope scope{so_far, k, parts, true};
                merge.add(measured(surface, e, std::move(scope)), "part");
            }
            so_far = merge.finish();
            ++round;
        } while (!complete(so_far));
        EXPECT_GT(round, 1);
        expect_same_bits(so_far, at_once);
    }
}

/// An accuracy that the limit leaves out of reach is told, as one run tells it.
TEST(MeasureScope, RoundsOfPartsSayWhatWasNotReached) {
    const Heightfield surface = test::noise(64, 2);
    Experiment e = experiment();
    e.run.until = 1e-5;
    e.run.max_rays = 50000;
    const Measurement at_once = measured(surface, e);
    ASSERT_FALSE(at_once.notes.empty());
    Measurement so_far = at_once;
    so_far.notes.clear();
    EXPECT_TRUE(complete(so_far));
    EXPECT_EQ(so_far.notes, at_once.notes);
}

TEST(MeasureScope, PartsThatAreNotAllThereAreGoneOnFrom) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment e = experiment();
    Merge merge;
    for (const int k : {4, 2}) merge.add(measured(surface, e, {.part = k, .parts = 5}), "part");
    Measurement some = Merge(merge).unfinished();
    EXPECT_TRUE(some.stopped && !complete(some));
    EXPECT_FALSE(some.layers.empty());
    expect_same_result(measured(surface, e, {.so_far = some}), measured(surface, e));
    merge.add(measured(surface, e, {.so_far = some, .leave_out_so_far = true}), "the rest");
    Measurement whole = merge.finish();
    expect_same_bits(whole, measured(surface, e));
    EXPECT_TRUE(complete(whole));
}

/// A row that a program adds is measured with, and named in settings.
TEST(MeasureEngines, AProgramCanAddOne) {
    static int made = 0;
    add_engine(
        {"counted", "the wide one, counted", [](const EngineSetup& setup, asperity::Run& run) {
             ++made;
             return find_engine("wide").make(setup, run);
         }});
    EXPECT_THROW(add_engine({"counted", "", find_engine("wide").make}), Error);
    EXPECT_THROW(add_engine({"none", "", {}}), Error);
    const Heightfield surface = test::noise(32, 2);
    Experiment e = experiment();
    const Measurement wide = measured(surface, e);
    EXPECT_EQ(to_text(e).find("engine"), std::string::npos);
    apply_setting(e, "engine", "counted");
    EXPECT_NE(to_text(e).find("engine = counted"), std::string::npos);
    EXPECT_EQ(experiment_from_text(to_text(e), "text").run.engine, "counted");
    expect_same_bits(measured(surface, e), wide);
    EXPECT_EQ(made, 1);
    EXPECT_THROW(apply_setting(e, "engine", "wid"), Error);
}

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(MeasureScope, WhatDoesNotFitIsRefusedByName) {
    const Heightfield surface = test::noise(64, 2);
    const Experiment e = experiment();
    const Measurement one = measured(surface, e, {.part = 1, .parts = 3}),
                      two = measured(surface, e, {.part = 2, .parts = 3}),
                      three = measured(surface, e, {.part = 3, .parts = 3});
    Merge merge;
    merge.add(one, "one");
    EXPECT_EQ(message_of([&] { merge.add(one, "again"); }),
              "again: batches 0 to 15 of layer 1 are in one, too");
    Experiment other = e;
    other.run.seed = 2;
    EXPECT_EQ(message_of([&] { merge.add(measured(surface, other), "other"); }),
              "other: it is of another experiment: seed is 2 there and 1 here");
    EXPECT_EQ(message_of([&] { merge.add(measured(test::noise(64, 3), e), "other"); }),
              "other: it is of another experiment: its surface has other heights, though its "
              "settings are "
              "the same");
    merge.add(three, "three");
    EXPECT_EQ(message_of([&] { Merge(merge).finish(); }),
              "batches 0 to 15 of layer 2 are missing: part 2/3 is missing");
    merge.add(two, "two");
    expect_same_bits(merge.finish(), measured(surface, e));

    EXPECT_EQ(message_of([&] { measured(test::noise(64, 3), e, {.so_far = one}); }),
              "result: it is of another experiment: its surface has other heights, though its "
              "settings are "
              "the same");
    Experiment less = e;
    less.run.until = 0.5;
    less.run.max_rays = 20005;
    const Measurement refined = measured(surface, until(surface, e, 0.3));
    EXPECT_NE(message_of([&] { measured(surface, less, {.so_far = refined}); }).find("more than"),
              std::string::npos);
    Measurement old = one;
    old.layers.front().spread = {};
    EXPECT_NE(message_of([&] { measured(surface, e, {.so_far = old}); }).find("measure it anew"),
              std::string::npos);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/layer_of_sums.h>
#include <asperity/gonio/merge.h>
#include <asperity/gonio/noise_shares.h>
#include <asperity/gonio/test_measurements.h>

#include <asperity/core/error.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

using test::expect_same_bits;
using test::measured;

Experiment class_experiment(std::uint64_t surfaces) {
    Experiment e = test::small_experiment();
    e.surface.kind = "gaussian";
    e.surface.size = 48;
    e.run.surfaces = surfaces;
    return e;
}

Heightfield surface_of(const Experiment& e) {
    asperity::Run run(1);
    return make_surface(e.surface, run);
}

Measurement measured_class(const Experiment& e, int threads = 2) {
    return measured(surface_of(e), e, threads);
}

Measurement with_scope(const Experiment& e, MeasureScope scope) {
    asperity::Run run(2);
    return measure(surface_of(e), e, run, {}, std::move(scope));
}

std::string refusal(const Experiment& e, const Heightfield& surface) {
    asperity::Run run(1);
    try {
        measure(surface, e, run);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// What surfaces of their own, each measured by itself, say: batch b is the rays 2 b and 2 b + 1
/// of a run of one surface.
TEST(SurfaceClass, IsTheSumOfItsSurfaces) {
    for (const char* engine : {"wide", "plain"}) {
        Experiment e = class_experiment(3);
        e.run.engine = engine;
        e.run.rays = 120000;  // enough for facets to be solved analytically
        const Measurement whole = measured_class(e);
        std::vector<LayerSums> ours;
        for (const Layer& layer : whole.layers) ours.push_back(sums_of(layer, whole.shape()));
        std::vector<std::uint64_t> energy(ours[0].energy.size());
        std::vector<LayerSums::Wide> halves(ours[0].squares.size());
        for (std::uint64_t b = 0; b < 3; ++b) {
            // A run of one surface, six batches of 20000 rays: those numbered 2 b and 2 b + 1
            Experiment one = e;
            one.run.surfaces = 1;
            one.run.batches = 6;
            one.surface.seed += b;
            std::vector<std::uint64_t> half[2];
            for (int h = 0; h < 2; ++h) {
                const int part = static_cast<int>(2 * b) + h + 1;
                // Twelve batches in all, layer after layer: the first six are those of layer 1
                const Measurement m = with_scope(one, {.part = part, .parts = 12});
                ASSERT_EQ(m.layers.size(), 1u);
                half[h] = sums_of(m.layers[0], m.shape()).energy;
                for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += half[h][k];
            }
            for (std::size_t k = 0; k < halves.size(); ++k) {
                std::uint64_t difference = 0;
                for (std::size_t o = k; o < energy.size(); o += halves.size())
                    difference += half[0][o] - half[1][o];
                const auto d = static_cast<std::int64_t>(difference);
                const auto size = static_cast<std::uint64_t>(d < 0 ? -d : d);
                halves[k] += LayerSums::Wide{size} * size;
            }
        }
        EXPECT_EQ(ours[0].energy, energy) << engine;
        EXPECT_TRUE(ours[0].halves.cells == halves) << engine;
        EXPECT_EQ(whole.layers[0].batches, 3);
        EXPECT_EQ(whole.layers[0].rays, 120000u);
    }
}

TEST(SurfaceClass, HasTheSameBitsHoweverItIsDivided) {
    for (const bool isotropic : {false, true}) {
        Experiment e = class_experiment(7);
        // Facets are solved analytically, each surface's light being spread its own way
        e.run.rays = 7 * 3000;
        e.optics = test::gold_like();
        e.illumination.isotropic = isotropic;
        const Measurement whole = measured_class(e, 1);
        expect_same_bits(measured_class(e, 3), whole);
        Merge merge;
        for (int part = 3; part >= 1; --part)
            merge.add(with_scope(e, {.part = part, .parts = 3}), "part");
        const Measurement merged = merge.finish();
        expect_same_bits(merged, whole);
        // From a share on: the rest of it is done, nothing twice
        MeasureScope rest;
        rest.so_far = with_scope(e, {.part = 2, .parts = 3});
        rest.so_far->part = rest.so_far->parts = 1;
        const Measurement resumed = with_scope(e, std::move(rest));
        expect_same_bits(resumed, whole);
        for (std::size_t k = 0; k < whole.layers.size(); ++k) {
            EXPECT_EQ(merged.layers[k].spread.halves, whole.layers[k].spread.halves);
            EXPECT_EQ(resumed.layers[k].spread.halves, whole.layers[k].spread.halves);
        }
    }
}

TEST(SurfaceClass, RefinesWithFurtherSurfaces) {
    Experiment e = class_experiment(8);
    e.illumination.theta_deg = {50};
    e.detector.resolution = 4;
    e.run.rays = 8000;
    e.optics = test::gold_like();
    const Measurement first = measured_class(e);
    e.run.until = 0.9 * first.layers[0].stderr_albedo[0] / first.albedo(first.layers[0], 0);
    e.run.until_cells = 0.99;
    e.run.max_rays = 32000;
    const Measurement refined = measured_class(e);
    EXPECT_GT(refined.layers[0].batches, 8);
    MeasureScope scope;
    scope.so_far = first;
    expect_same_bits(with_scope(e, std::move(scope)), refined);
    // As many surfaces asked for at once are the same ones
    Experiment more = e;
    more.run.until = 0;
    more.run.max_rays = 0;
    more.run.surfaces = static_cast<std::uint64_t>(refined.layers[0].batches);
    more.run.rays = refined.layers[0].rays;
    expect_same_bits(measured_class(more), refined);
}

/// Mirrors' rays fall on 32 x 32 cells of noise: few enough surfaces of few cells differ by more
/// than rays do; of surfaces that are all but alike, nothing but the rays is left.
TEST(SurfaceClass, TellsTheNoiseOfRaysFromThatOfSurfaces) {
    Experiment e = class_experiment(64);
    e.illumination.theta_deg = {60};
    e.run.launch = LaunchPattern::Random;
    // Many rays on small tiles
    e.surface.size = 16;
    e.surface.correlation_x = e.surface.correlation_y = 8;
    e.run.rays = 64 * 8192;
    const Measurement rough = measured_class(e, 0);
    const auto few = shares_of_rays(rough.layers);
    ASSERT_TRUE(few);
    EXPECT_LT(few->cells, 0.1);
    // Few rays on large ones
    e.surface.size = 256;
    e.surface.correlation_x = e.surface.correlation_y = 1;
    e.run.rays = 64 * 64;
    const auto many = shares_of_rays(measured_class(e, 0).layers);
    ASSERT_TRUE(many);
    EXPECT_GT(many->cells, 0.9);

    // The rays' part is what one surface shows: its own errors, of as many rays
    const Layer& layer = rough.layers[0];
    e = class_experiment(1);
    e.illumination.theta_deg = {60};
    e.run.launch = LaunchPattern::Random;
    e.surface.size = 16;
    e.run.batches = 64;
    e.run.rays = 64 * 8192;
    const Layer one = measured_class(e, 0).layers[0];
    double of_class = 0, of_one = 0;
    for (std::size_t k = 0; k < one.stderr_energy.size(); ++k) {
        of_class += std::pow(energy_error_of_rays(layer, k), 2);
        of_one += std::pow(double{one.stderr_energy[k]}, 2);
    }
    EXPECT_NEAR(of_class / of_one, 1, 0.15);
    EXPECT_FALSE(shares_of_rays(std::vector{one}));
}

TEST(SurfaceClass, SharesTheRaysOutEvenly) {
    RunSettings run;
    run.surfaces = 10;
    run.rays = 1000001;
    const BatchPlan plan(4096, run);
    EXPECT_TRUE(plan.of_class);
    EXPECT_EQ(plan.batches, 10u);
    EXPECT_EQ(plan.rays_of(3), 100000u);
    EXPECT_EQ(plan.rays, 1000000u);
    EXPECT_EQ(plan.rays_before(25), 2500000u);
    // As many as make a ray a cell, 16 at least, and no more rays on each than a batch may have
    run.surfaces = 0;
    EXPECT_EQ(BatchPlan(10000, run).batches, 101u);
    EXPECT_EQ(BatchPlan(std::uint64_t{1} << 20, run).batches, 16u);
    run.rays = std::uint64_t{1} << 26;
    EXPECT_EQ(BatchPlan(std::uint64_t{1} << 24, run).batches, 64u);
    run.surfaces = 1;
    EXPECT_FALSE(BatchPlan(4096, run).of_class);
}

TEST(SurfaceClass, RefusesWhatMakesNone) {
    Experiment e = class_experiment(4);
    e.surface.kind = kSurfaceFile;
    EXPECT_NE(refusal(e, test::noise(16, 1)).find("a file holds one surface"), std::string::npos);
    e.surface.kind = "vgroove";
    EXPECT_NE(refusal(e, test::noise(16, 1)).find("no seed"), std::string::npos);
    e = class_experiment(4);
    EXPECT_NE(refusal(e, test::noise(16, 1)).find("not the one that its settings make"),
              std::string::npos);
    e.run.rays = 7;
    EXPECT_NE(refusal(e, surface_of(e)).find("at most 3 surfaces"), std::string::npos);
    e.run.rays = 5u << 20;
    EXPECT_NE(refusal(e, surface_of(e)).find("at least 5 surfaces"), std::string::npos);
}

}  // namespace
}  // namespace asperity

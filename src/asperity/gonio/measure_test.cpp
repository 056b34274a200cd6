// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/test_measurements.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <numeric>

namespace asperity {
namespace {

using test::expect_same_bits;
using test::gold_like;
using test::measured;
using test::noise;
using test::small_experiment;

TEST(Experiment, LargeSurfacesNeedFewerRaysPerCell) {
    const auto square = [](std::uint64_t side) { return side * side; };
    EXPECT_EQ(default_jitter(square(2)), 16);
    EXPECT_EQ(default_jitter(square(512)), 16);
    EXPECT_EQ(default_jitter(square(2048)), 16);
    EXPECT_EQ(default_jitter(square(4096)), 4);
    EXPECT_EQ(default_jitter(square(32768)), 1);
    // Where a run says its own, that counts; a number of rays leaves the thesis' figure.
    RunSettings run;
    EXPECT_EQ(jitter_of(run, square(4096)), 4);
    run.rays = 1000;
    EXPECT_EQ(jitter_of(run, square(4096)), 16);
    run.jitter = 2;
    EXPECT_EQ(jitter_of(run, square(4096)), 2);
}

TEST(Measure, SameBitsForAnyNumberOfThreads) {
    const Heightfield s = noise(64, 3);
    for (const LaunchPattern launch :
         {LaunchPattern::LowDiscrepancy, LaunchPattern::Stratified, LaunchPattern::Random}) {
        Experiment e = small_experiment();
        e.optics = gold_like();
        e.run.launch = launch;
        const Measurement one = measured(s, e, 1);
        for (const int threads : {2, 3, 7}) expect_same_bits(one, measured(s, e, threads));
    }
}

TEST(Measure, EveryUnitOfEnergyIsAccountedFor) {
    const Heightfield s = noise(64, 6);
    Experiment e = small_experiment();
    e.optics = gold_like();
    for (const int bounces : {1, 2, 5, 40}) {
        e.run.bounces = bounces;
        for (const Layer& layer : measured(s, e).layers)
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(layer.escaped[c] + layer.absorbed[c] + layer.truncated[c] + layer.edge[c],
                          layer.rays << 32);
                EXPECT_EQ(layer.edge[c], 0u);
                const auto* first = &layer.escaped_by_bounce[c * static_cast<std::size_t>(bounces)];
                EXPECT_EQ(std::accumulate(first, first + bounces, std::uint64_t{0}),
                          layer.escaped[c]);
            }
    }
}

TEST(Measure, WhiteFurnace) {
    // Perfect mirrors lose nothing: albedo + truncated = 1, and nothing is left after enough
    // bounces
    const Heightfield s = noise(64, 2);
    Experiment e = small_experiment();
    e.run.bounces = 1000;
    const Measurement m = measured(s, e);
    for (const Layer& layer : m.layers) {
        EXPECT_EQ(layer.absorbed[0], 0u);
        EXPECT_EQ(layer.truncated[0], 0u);
        EXPECT_EQ(m.albedo(layer, 0), 1.0);
        EXPECT_EQ(layer.stderr_albedo[0], 0.0);
    }
}

TEST(Measure, OneBounceMoreOnlyMovesTruncatedEnergy) {
    const Heightfield s = noise(64, 4);
    Experiment e = small_experiment();
    e.run.bounces = 3;
    const Measurement a = measured(s, e);
    e.run.bounces = 4;
    const Measurement b = measured(s, e);
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
        for (std::size_t order = 0; order < 3; ++order)
            EXPECT_EQ(a.layers[k].escaped_by_bounce[order], b.layers[k].escaped_by_bounce[order]);
        EXPECT_EQ(a.layers[k].truncated[0],
                  b.layers[k].truncated[0] + b.layers[k].escaped_by_bounce[3]);
    }
}

TEST(Measure, ScaleDoesNotMatter) {
    // Heights and cells four times as large, exactly representable: bit for bit the same.
    const Heightfield s = noise(64, 3);
    Heightfield large = s;
    large.dx = large.dy = 4;
    for (float& h : large.heights) h *= 4;
    expect_same_bits(measured(s, small_experiment()), measured(large, small_experiment()));
}

TEST(Measure, TurningSurfaceAndLightTurnsTheLobe) {
    // Surface and light turned by 90 degrees: (x, y) -> (-y, x). The diagonal of a cell becomes the
    // other diagonal. Same albedo of each order and same lobe, turned, within the error bars.
    const Heightfield s = noise(64, 2);
    Heightfield turned = s;
    turned.diagonal = Diagonal::Main;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            const int a = (64 - j) % 64, b = i;  // sample (i, j) goes to (-j, i)
            turned.heights[static_cast<std::size_t>(b * 64 + a)] = s.at(i, j);
        }
    Experiment e = small_experiment();
    e.run.rays = 200000;
    e.illumination.theta_deg = {40};
    e.illumination.phi_deg = {10};
    const Measurement a = measured(s, e);
    e.illumination.phi_deg = {100};
    const Measurement b = measured(turned, e);
    double chi2 = 0;
    int cells = 0;
    const int columns = a.detector.columns();
    for (int cell = 0; cell < a.detector.cells(); ++cell) {
        const int row = cell / columns, column = cell % columns;
        const int other = row * columns + (column + columns / 4) % columns;
        const double ea = a.energy(a.layers[0], 0, cell), eb = b.energy(b.layers[0], 0, other);
        if (ea * 200000 < 50) continue;
        const double sa =
            static_cast<double>(a.layers[0].stderr_energy[static_cast<std::size_t>(cell)]);
        const double sb =
            static_cast<double>(b.layers[0].stderr_energy[static_cast<std::size_t>(other)]);
        chi2 += (ea - eb) * (ea - eb) / (sa * sa + sb * sb);
        ++cells;
    }
    ASSERT_GT(cells, 100);
    // Student-like tails of 32 batches widen chi2: variance (K - 1) / (K - 3) = 1.07 per cell.
    EXPECT_LT(chi2 / cells, 1.07 + 5 * std::sqrt(2.5 / cells));
}

TEST(Measure, IsotropicModeSortsByRelativeAzimuth) {
    // A flat mirror lit from all around: the mirror direction stands at relative azimuth 180.
    Heightfield flat;
    flat.nx = flat.ny = 8;
    flat.heights.assign(64, 0.0f);
    flat.isotropic = true;
    Experiment e = small_experiment();
    e.illumination.theta_deg = {40};
    e.illumination.isotropic = true;
    e.detector.resolution = 31;  // an odd number of columns: 180 degrees is inside a cell
    const Measurement m = measured(flat, e);
    const int cell = m.detector.cell_of(from_spherical(radians(40), radians(180)));
    EXPECT_EQ(m.energy(m.layers[0], 0, cell), 1.0);
    EXPECT_TRUE(m.notes.empty());
}

/// A plateau of 16 x 16 cells with a trench along y, two cells wide.
Heightfield trench(float depth) {
    Heightfield s = noise(16, 0);
    for (std::size_t k = 0; k < s.heights.size(); ++k)
        if (k % 16 == 8 || k % 16 == 9) s.heights[k] = -depth;
    return s;
}

// Lines of light of 57,000 cells beside rays that start one by one, on a metal that takes 0.06 %
TEST(Measure, LongLinesGiveWhatSingleRaysGive) {
    Experiment e = small_experiment();
    e.illumination = {15, {89.9}, {90}, false};
    e.run.batches = 4;
    e.optics = gold_like();
    const double cosine = std::cos(radians(89.9));
    for (const float depth : {10.0f, 100.0f}) {
        e.run.launch = LaunchPattern::LowDiscrepancy;
        const Measurement lines = measured(trench(depth), e);
        e.run.launch = LaunchPattern::Random;
        const Measurement single = measured(trench(depth), e);
        const Layer &a = lines.layers[0], &b = single.layers[0];
        EXPECT_EQ(a.stuck, 0u);
        // Off the plateau or the ground; off wall, ground and wall
        for (const std::size_t bounce : {0u, 2u})
            EXPECT_NEAR(energy_fraction(a.escaped_by_bounce[bounce], a.rays),
                        energy_fraction(b.escaped_by_bounce[bounce], b.rays),
                        5 * std::hypot(a.stderr_albedo_by_bounce[bounce],
                                       b.stderr_albedo_by_bounce[bounce]));
        // 7 of 8 rays meet a level facet; the others a level one and two walls, or few of them,
        // 2 in 1000 of all rays, four walls
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double n = e.optics.ior[channel], k = e.optics.k[channel];
            const double level = fresnel_conductor(cosine, n, k),
                         wall = fresnel_conductor(cosine / std::hypot(1.0, depth), n, k);
            const double absorbed = 1 - level * (0.875 + 0.125 * wall * wall);
            for (const Layer* layer : {&a, &b}) {
                const double albedo = energy_fraction(layer->escaped[channel], layer->rays);
                EXPECT_NEAR((1 - albedo) / absorbed, 1, 2e-3) << depth << ' ' << channel;
            }
        }
    }
}

TEST(Measure, LightThatNeverLandsIsTruncated) {
    Experiment e = small_experiment();
    e.illumination = {15, {89.9}, {90}, false};
    e.run.batches = 4;
    e.run.rays = 2000;
    const Layer layer = measured(trench(10000), e).layers[0];
    EXPECT_GT(layer.stuck, 0u);
    EXPECT_EQ(layer.escaped[0] + layer.truncated[0], layer.rays << 32);
    EXPECT_GE(layer.truncated[0], layer.stuck << 32);
}

TEST(Measure, AnyAngleAndAnyLevelPlane) {
    Experiment e = small_experiment();
    e.illumination.theta_deg = {0, 1e-200, 1e-30, 1e-13, 1e-9, 45, 89.9999999, 89.99999999999999};
    Heightfield plane = noise(16, 0);
    for (const float height : {0.0f, 1e15f, -1e15f, 1e-30f, 3e38f}) {
        std::fill(plane.heights.begin(), plane.heights.end(), height);
        for (const Layer& layer : measured(plane, e).layers) {
            EXPECT_EQ(layer.escaped_by_bounce[0], layer.rays << 32)
                << height << ' ' << degrees(layer.theta_i);
            EXPECT_EQ(layer.stuck, 0u);
        }
    }
}

TEST(Measure, AsksAboutUnitsInPlaceOfGoingOnForever) {
    const auto refused = [](float height, double theta_deg) {
        Heightfield spike = noise(3, 0);
        spike.heights[4] = height;
        Experiment e = small_experiment();
        e.illumination.theta_deg = {theta_deg};
        try {
            (void)measured(spike, e);
        } catch (const Error& error) {
            return error.code() == ErrorCode::InvalidInput &&
                   error.message().find("in the same unit") != std::string::npos;
        }
        return false;
    };
    EXPECT_TRUE(refused(1e9f, 80));
    EXPECT_TRUE(refused(1e9f, 0));
    EXPECT_TRUE(refused(1, 89.9999999));
    EXPECT_FALSE(refused(1, 89.9));
    EXPECT_FALSE(refused(1000, 80));
}

TEST(Measure, SaysThatDielectricsDoNotPolarise) {
    const auto notes = [](FresnelKind kind, int bounces) {
        Experiment e = small_experiment();
        e.run.rays = 100;
        e.run.bounces = bounces;
        e.optics.fresnel = kind;
        if (kind == FresnelKind::Dielectric) e.optics.ior = {1.5};
        return measured(noise(16, 1), e).notes;
    };
    EXPECT_TRUE(notes(FresnelKind::None, 5).empty());
    EXPECT_TRUE(notes(FresnelKind::Dielectric, 1).empty());
    ASSERT_EQ(notes(FresnelKind::Dielectric, 5).size(), 1u);
    EXPECT_NE(notes(FresnelKind::Dielectric, 5)[0].find("polarisations"), std::string::npos);
}

TEST(Measure, JitterIsRaysPerCell) {
    const Heightfield s = noise(48, 1);
    Experiment e = small_experiment();
    e.run.rays = 0;
    e.run.jitter = 3;
    EXPECT_EQ(measured(s, e).layers[0].rays, 3u * 48 * 48);
    e.run.rays = 12345;
    EXPECT_EQ(measured(s, e).layers[0].rays, 12345u);
}

TEST(Measure, FinitePatchReportsItsEdgeLoss) {
    Heightfield s = noise(32, 5);
    s.boundary = Boundary::Finite;
    const Measurement m = measured(s, small_experiment());
    for (const Layer& layer : m.layers) {
        EXPECT_GT(layer.edge[0], 0u);
        EXPECT_EQ(layer.escaped[0] + layer.truncated[0] + layer.edge[0], layer.rays << 32);
    }
    EXPECT_GT(m.layers[1].edge[0], m.layers[0].edge[0]);  // slanted light misses more
}

TEST(Measure, RefinesUntilTheErrorIsReached) {
    const Heightfield s = noise(64, 2);
    Experiment e = small_experiment();
    e.illumination.theta_deg = {30};
    e.detector.resolution = 8;
    e.optics = gold_like();
    e.run.rays = 2000;
    e.run.until = 0.003;
    e.run.until_cells = 0.05;
    const Measurement m = measured(s, e);
    const Layer& layer = m.layers[0];
    EXPECT_GT(layer.rays, 2000u);
    for (int c = 0; c < 3; ++c)
        EXPECT_LE(layer.stderr_albedo[static_cast<std::size_t>(c)], 0.003 * m.albedo(layer, c));
    expect_same_bits(m, measured(s, e, 3));
    e.run.max_rays = 3000;
    const Measurement cut = measured(s, e);
    EXPECT_LE(cut.layers[0].rays, 3000u);
    ASSERT_EQ(cut.notes.size(), 1u);
}

TEST(Measure, RefusesSillySettings) {
    const Heightfield s = noise(8, 1);
    const auto refused = [&](auto change, const char* setting) {
        Experiment e = small_experiment();
        change(e);
        try {
            measured(s, e);
            ADD_FAILURE() << setting << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            EXPECT_EQ(error.where(), setting);
        }
    };
    const double nan = std::nan("");
    refused([](Experiment& e) { e.run.bounces = 0; }, "bounces");
    refused([](Experiment& e) { e.run.rays = 1; }, "rays");
    refused([](Experiment& e) { e.run.rays = ~0ULL; }, "rays");
    refused([&](Experiment& e) { e.run.jitter = nan; }, "jitter");
    refused([](Experiment& e) { e.run.jitter = -1; }, "jitter");
    refused(
        [](Experiment& e) {
            e.run.rays = 0;
            e.run.jitter = 1e9;
        },
        "jitter");
    refused([&](Experiment& e) { e.run.until = nan; }, "until");
    refused([](Experiment& e) { e.run.batches = 1; }, "batches");
    refused([](Experiment& e) { e.detector.resolution = 1; }, "resolution");
    refused([](Experiment& e) { e.illumination.theta_deg = {90}; }, "theta");
    refused([&](Experiment& e) { e.illumination.theta_deg = {nan}; }, "theta");
    refused([](Experiment& e) { e.illumination.phi_deg = {}; }, "phi");
    refused(
        [](Experiment& e) {
            e.illumination.theta_deg = {};
            e.illumination.layers = -1;
        },
        "layers");
}

// The lanes of a vector are paths that know nothing of each other, and nothing is fused: SSE4,
// AVX2, AVX-512 and plain C++ give the same bits.
TEST(Measure, EveryInstructionSetGivesTheSameBits) {
    for (const std::string kind : {"gaussian", "thesis"}) {
        for (const bool isotropic : {false, true}) {
            SurfaceSettings settings;
            settings.kind = kind;
            settings.size = 160;
            settings.alpha_x = settings.alpha_y = 0.8;
            settings.roughness = 0.5;
            asperity::Run run;
            const Heightfield surface = make_surface(settings, run);
            Experiment experiment;
            experiment.optics.fresnel = FresnelKind::Conductor;
            experiment.optics.material = "Cu";
            experiment.illumination.theta_deg = {0, 40, 80};
            experiment.illumination.isotropic = isotropic;
            experiment.run.rays = 40000;
            const Measurement expected = measure(surface, experiment, run);
            int sets = 0;
            for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
                hwy::SetSupportedTargetsForTest(target);
                hwy::GetChosenTarget().Update(target);
                const Measurement m = measure(surface, experiment, run);
                ++sets;
                for (std::size_t k = 0; k < m.layers.size(); ++k) {
                    EXPECT_TRUE(m.layers[k].energy == expected.layers[k].energy)
                        << hwy::TargetName(target);
                    EXPECT_EQ(m.layers[k].absorbed, expected.layers[k].absorbed);
                    EXPECT_EQ(m.layers[k].segments, expected.layers[k].segments);
                }
                hwy::SetSupportedTargetsForTest(0);
            }
            hwy::GetChosenTarget().DeInit();
            EXPECT_GE(sets, 1);
        }
    }
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <chrono>
#include <numeric>
#include <thread>

namespace asperity {
namespace {

Heightfield noise(int n, double height, std::uint64_t seed = 1) {
    Heightfield s;
    s.nx = s.ny = n;
    s.name = "noise";
    const CounterRandom random(seed, 99);
    for (int k = 0; k < n * n; ++k)
        s.heights.push_back(
            static_cast<float>(height * random.uniform2(static_cast<std::uint64_t>(k))[0]));
    return s;
}

Experiment small_experiment() {
    Experiment e;
    e.illumination.theta_deg = {0, 50};
    e.detector.resolution = 32;
    e.run.rays = 20000;
    e.run.bounces = 5;
    return e;
}

Measurement measured(const Heightfield& s, const Experiment& e, int threads = 2) {
    asperity::Run run(threads);
    return measure(s, e, run);
}

void expect_same_bits(const Measurement& a, const Measurement& b) {
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
        const Layer &x = a.layers[k], &y = b.layers[k];
        EXPECT_EQ(x.energy, y.energy);
        EXPECT_EQ(x.absorbed, y.absorbed);
        EXPECT_EQ(x.truncated, y.truncated);
        EXPECT_EQ(x.escaped_by_bounce, y.escaped_by_bounce);
        EXPECT_EQ(x.stderr_energy, y.stderr_energy);
        EXPECT_EQ(x.stderr_albedo, y.stderr_albedo);
        EXPECT_EQ(x.segments, y.segments);
    }
}

OpticsSettings gold_like() {
    OpticsSettings optics;
    optics.fresnel = FresnelKind::Conductor;
    optics.ior = {0.156, 0.424, 1.383};
    optics.k = {3.602, 2.472, 1.916};
    return optics;
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
    refused([](Experiment& e) { e.run.jitter = 0; }, "jitter");
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
            e.illumination.layers = 0;
        },
        "layers");
}

// The lanes of a vector are paths that know nothing of each other, and nothing is fused: SSE4,
// AVX2, AVX-512 and plain C++ give the same bits.
TEST(Measure, EveryInstructionSetGivesTheSameBits) {
    for (const SurfaceKind kind : {SurfaceKind::Gaussian, SurfaceKind::Thesis}) {
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

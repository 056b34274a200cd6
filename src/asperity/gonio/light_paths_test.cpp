// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/gonio/light_paths.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace asperity {
namespace {

Heightfield shape(const std::string& kind, int size) {
    SurfaceSettings settings;
    settings.kind = kind;
    settings.size = size;
    settings.tilt_deg = 45;
    settings.alpha_x = settings.alpha_y = 0.8;
    asperity::Run run(1);
    return make_surface(settings, run);
}

Experiment light_from(std::vector<double> theta_deg, double phi_deg = 0) {
    Experiment e;
    e.illumination.theta_deg = std::move(theta_deg);
    e.illumination.phi_deg = {phi_deg};
    e.detector.resolution = 16;
    return e;
}

std::vector<LightPath> sample(const Heightfield& s, const Experiment& e, std::size_t count,
                              int threads = 2, int layer = 1) {
    asperity::Run run(threads);
    const Tracer tracer(s);
    return sample_light_paths(tracer, e, layer, count, run);
}

LightPathsFound into_cells(const Heightfield& s, const Experiment& e, std::vector<int> cells,
                           std::size_t wanted, std::uint64_t most, int threads = 2) {
    asperity::Run run(threads);
    const Tracer tracer(s);
    return paths_into_cells(tracer, e, 1, cells, wanted, most, run);
}

void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-9) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

void expect_same(const LightPath& a, const LightPath& b) {
    EXPECT_EQ(length(a.launched - b.launched), 0);
    EXPECT_EQ(length(a.wi - b.wi), 0);
    EXPECT_EQ(length(a.wo - b.wo), 0);
    EXPECT_EQ(a.facets, b.facets);
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.end, b.end);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k)
        EXPECT_EQ(length(a.points[k] - b.points[k]), 0);
}

void expect_same(const std::vector<LightPath>& a, const std::vector<LightPath>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) expect_same(a[k], b[k]);
}

// A flat mirror at height 0 sends light from (40, 10) degrees to (40, 190) degrees.
TEST(LightPaths, FlatMirror) {
    const Heightfield s = shape("flat", 32);
    const Experiment e = light_from({40}, 10);
    const Detector detector(e.detector);
    const Vec3 wi = from_spherical(radians(40), radians(10));
    const Vec3 wo = from_spherical(radians(40), radians(190));
    const auto paths = sample(s, e, 300);
    ASSERT_EQ(paths.size(), 300u);
    for (const LightPath& p : paths) {
        expect_near(p.wi, wi);
        expect_near(p.wo, wo);
        EXPECT_EQ(p.end, PathEnd::Escaped);
        EXPECT_EQ(p.cell, detector.cell_of(wo));
        ASSERT_EQ(p.points.size(), 1u);
        expect_near(p.points[0], p.launched);  // they start at the highest point
        ASSERT_EQ(p.facets.size(), 1u);
        EXPECT_EQ(p.facets[0].i, static_cast<int>(p.launched.x));
        EXPECT_EQ(p.facets[0].j, static_cast<int>(p.launched.y));
        const double u = p.launched.x - p.facets[0].i, v = p.launched.y - p.facets[0].j;
        EXPECT_EQ(p.facets[0].triangle, u + v < 1 ? Triangle::Lower : Triangle::Upper);
    }
}

// A groove along y, 45 degree walls, valleys at x = 0, 16, ...: light straight down onto x turns
// level at height |x - valley|, meets the other wall at 2 valley - x, and goes up again. The
// valley at 0 sends half of its paths over the tile's border.
TEST(LightPaths, GrooveTurnsLightTwice) {
    const Heightfield s = shape("vgroove", 64);
    int outside = 0;
    for (const LightPath& p : sample(s, light_from({0}), 2000)) {
        const double x = p.launched.x, valley = 16 * std::round(x / 16);
        EXPECT_EQ(p.launched.z, 8);
        expect_near(p.wi, {0, 0, 1});
        ASSERT_EQ(p.points.size(), 2u);
        expect_near(p.points[0], {x, p.launched.y, std::abs(x - valley)});
        expect_near(p.points[1], {2 * valley - x, p.launched.y, std::abs(x - valley)});
        expect_near(p.wo, {0, 0, 1});
        EXPECT_EQ(p.end, PathEnd::Escaped);
        outside += p.points[1].x < 0 || p.points[1].x > 64 ? 1 : 0;
        // Facets are of the tile, wherever the path is
        EXPECT_EQ(p.facets[1].i, (static_cast<int>(std::floor(p.points[1].x)) + 64) % 64);
    }
    EXPECT_NEAR(outside, 2000 / 4, 5 * std::sqrt(2000 * 0.25 * 0.75));  // |x| < 8 or x > 56
}

TEST(LightPaths, BounceLimitCutsAtTheFacetItForbids) {
    const Heightfield s = shape("vgroove", 64);
    Experiment e = light_from({0});
    e.run.bounces = 1;
    for (const LightPath& p : sample(s, e, 100)) {
        EXPECT_EQ(p.end, PathEnd::Truncated);
        EXPECT_EQ(p.points.size(), 2u);
        EXPECT_EQ(p.facets.size(), 2u);
        EXPECT_EQ(p.cell, -1);
        EXPECT_EQ(length(p.wo), 0);
    }
}

/// Height of the surface over one of its facets, continued as a plane; (x, y) may lie in any tile.
double plane_height(const Heightfield& s, const FacetId& f, Vec3 at) {
    const double width = s.cells_x() * s.dx, depth = s.cells_y() * s.dy;
    const double x0 = f.i * s.dx, y0 = f.j * s.dy;
    const double x = at.x - x0 - std::round((at.x - x0) / width) * width;
    const double y = at.y - y0 - std::round((at.y - y0) / depth) * depth;
    const Slope slope = facet_slope(s, f.i, f.j, f.triangle);
    // A corner of the triangle: (0, 0), or the opposite one of the cell
    const int c = f.triangle == Triangle::Upper && s.diagonal == Diagonal::Anti ? 1 : 0;
    const double corner = static_cast<double>(s.at(f.i + c, f.j + c));
    return corner + slope.x * (x - c * s.dx) + slope.y * (y - c * s.dy);
}

// On rough surfaces with either diagonal: points lie on their facets, legs are straight and obey
// the law of reflection, however many tiles they cross.
TEST(LightPaths, LegsAreStraightOverTheBordersOfTiles) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        Heightfield s = shape("gaussian", 32);
        s.diagonal = diagonal;
        s.dx = 1.5;
        int far = 0, legs = 0;
        for (const LightPath& p : sample(s, light_from({75}, 35), 2000)) {
            Vec3 from = p.launched, direction = -p.wi;
            for (std::size_t k = 0; k < p.points.size(); ++k, ++legs) {
                const Vec3 at = p.points[k], leg = at - from;
                EXPECT_LT(length(leg - dot(leg, direction) * direction), 1e-7 * (1 + length(leg)));
                EXPECT_GT(dot(leg, direction), -1e-9);
                EXPECT_NEAR(at.z, plane_height(s, p.facets[k], at), 1e-9);
                far += at.x < 0 || at.x > 48 || at.y < 0 || at.y > 32 ? 1 : 0;
                const FacetId f = p.facets[k];
                const Vec3 normal = normal_of(facet_slope(s, f.i, f.j, f.triangle));
                direction = reflect(-direction, normal);
                from = at;
            }
            if (p.end == PathEnd::Escaped) {
                expect_near(p.wo, direction);
                EXPECT_GT(p.wo.z, 0);
            }
        }
        EXPECT_GT(far, 100);
        EXPECT_GT(legs, 2300);
    }
}

TEST(LightPaths, FinitePatchLosesPathsThroughItsSide) {
    Heightfield s = shape("gaussian", 32);
    s.boundary = Boundary::Finite;
    const auto paths = sample(s, light_from({80}), 500);
    const auto lost = std::count_if(paths.begin(), paths.end(),
                                    [](const LightPath& p) { return p.end == PathEnd::Edge; });
    EXPECT_GT(lost, 50);
    for (const LightPath& p : paths) {
        if (p.end == PathEnd::Edge) {
            EXPECT_EQ(p.cell, -1);
            EXPECT_NEAR(length(p.wo), 1, 1e-12);
        }
        for (const Vec3 at : p.points) EXPECT_TRUE(at.x >= 0 && at.x <= 31);
    }
}

// As many paths into a cell, after so many reflections, and cut off, as measure() counts.
TEST(LightPaths, SharesAreThoseOfTheMeasurement) {
    const Heightfield s = shape("gaussian", 128);
    for (const bool isotropic : {false, true}) {
        Experiment e = light_from({50}, isotropic ? 0 : 20);
        e.illumination.isotropic = isotropic;
        e.run.bounces = 3;
        e.run.rays = 400000;
        asperity::Run run(2);
        const Measurement m = measure(s, e, run);
        const Layer& layer = m.layers[0];

        constexpr std::size_t kPaths = 60000;
        std::vector<double> in_cell(static_cast<std::size_t>(m.detector.cells())), by_bounce(4);
        for (const LightPath& p : sample(s, e, kPaths)) {
            by_bounce[p.end == PathEnd::Truncated ? 3 : p.points.size() - 1] += 1.0 / kPaths;
            if (p.cell >= 0) in_cell[static_cast<std::size_t>(p.cell)] += 1.0 / kPaths;
        }
        const auto expect_share = [&](double share, double measured, double error) {
            const double own = std::sqrt(measured * (1 - measured) / kPaths + 1e-10);
            EXPECT_NEAR(share, measured, 5 * std::hypot(own, error));
        };
        int cells = 0;
        for (std::size_t c = 0; c < in_cell.size(); ++c) {
            const double measured = m.energy(layer, 0, static_cast<int>(c));
            if (measured * kPaths < 25) continue;
            expect_share(in_cell[c], measured, static_cast<double>(layer.stderr_energy[c]));
            ++cells;
        }
        EXPECT_GT(cells, 40);
        for (int b = 0; b < 3; ++b)
            expect_share(by_bounce[static_cast<std::size_t>(b)], m.albedo(layer, b, 0), 0);
        expect_share(by_bounce[3], 1 - m.albedo(layer, 0), 0);
    }
}

TEST(LightPaths, CellsAreTheDetectors) {
    const Heightfield s = shape("gaussian", 64);
    for (const bool isotropic : {false, true}) {
        Experiment e = light_from({50});
        e.illumination.isotropic = isotropic;
        const Detector detector(e.detector);
        double turned = 0;
        for (const LightPath& p : sample(s, e, 500)) {
            if (p.end != PathEnd::Escaped) continue;
            EXPECT_EQ(p.cell, detector.cell_of(rotate_z(p.wo, -azimuth(p.wi))));
            turned += azimuth(p.wi) / 500;
        }
        // Every path has a light of its own, from all around
        EXPECT_NEAR(turned, isotropic ? kPi : 0, isotropic ? 0.4 : 0);
    }
}

TEST(LightPaths, SameForAnyNumberOfThreadsAndPaths) {
    const Heightfield s = shape("gaussian", 64);
    const Experiment e = light_from({50});
    const auto many = sample(s, e, 40000, 1);
    ASSERT_EQ(many.size(), 40000u);
    for (const int threads : {2, 3, 5}) expect_same(sample(s, e, 40000, threads), many);
    const auto few = sample(s, e, 300);
    expect_same(few, {many.begin(), many.begin() + 300});
    // Another seed, another layer: other paths
    Experiment other = e;
    other.run.seed = 2;
    EXPECT_NE(sample(s, other, 1)[0].launched.x, many[0].launched.x);
    other = light_from({50, 50});
    EXPECT_NE(sample(s, other, 1, 1, 2)[0].launched.x, many[0].launched.x);
}

TEST(LightPaths, IntoCellsAreTheFirstOfTheSequence) {
    const Heightfield s = shape("gaussian", 64);
    const Experiment e = light_from({50});
    const auto all = sample(s, e, 40000);
    const std::vector<int> cells = {16, 40, 41, 56};
    std::vector<LightPath> expected;
    std::vector<std::uint64_t> tried;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (std::find(cells.begin(), cells.end(), all[k].cell) == cells.end()) continue;
        expected.push_back(all[k]);
        tried.push_back(k + 1);
    }
    ASSERT_GT(expected.size(), 500u);
    for (const int threads : {1, 2, 5}) {
        for (const std::size_t wanted : {std::size_t{1}, std::size_t{20}, expected.size()}) {
            const LightPathsFound found = into_cells(s, e, cells, wanted, 1000000, threads);
            expect_same(found.paths,
                        {expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(wanted)});
            EXPECT_EQ(found.tried, tried[wanted - 1]);
        }
        // No more than allowed are tried
        const LightPathsFound cut = into_cells(s, e, cells, 1000000, 20001, threads);
        EXPECT_EQ(cut.tried, 20001u);
        const auto within = static_cast<std::size_t>(
            std::upper_bound(tried.begin(), tried.end(), 20001) - tried.begin());
        EXPECT_EQ(cut.paths.size(), within);
    }
    EXPECT_TRUE(into_cells(s, e, {}, 5, 1000).paths.empty());
    EXPECT_TRUE(into_cells(s, e, cells, 0, 1000).paths.empty());
}

TEST(LightPaths, StopsAndTellsHowFarItIs) {
    const Heightfield s = shape("flat", 32);
    const Experiment e = light_from({50});
    const Tracer tracer(s);
    asperity::Run run(2);
    Progress last;
    run.on_progress([&](const Progress& p) {
        EXPECT_EQ(p.stage, "following light");
        EXPECT_TRUE(p.done >= last.done && p.done <= p.total);
        last = p;
    });
    std::chrono::steady_clock::time_point asked;
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        asked = std::chrono::steady_clock::now();
        run.request_stop();
    });
    // No path of a flat mirror goes there
    const std::vector<int> cells = {0};
    const LightPathsFound found = paths_into_cells(tracer, e, 1, cells, 1, 4000000000, run);
    const auto ended = std::chrono::steady_clock::now();
    stopper.join();
    const std::chrono::duration<double> took = ended - asked;
    EXPECT_TRUE(found.paths.empty());
    EXPECT_GT(found.tried, 0u);
    EXPECT_LT(found.tried, 4000000000u);
    EXPECT_GT(last.done, 0u);
    EXPECT_LT(took.count(), 0.25);  // 100 ms, shared CPU

    asperity::Run stopped(2);
    stopped.request_stop();
    EXPECT_TRUE(sample_light_paths(tracer, e, 1, 100, stopped).empty());
}

TEST(LightPaths, RefusesWhatIsNotThere) {
    const Heightfield s = shape("flat", 32);
    const auto refused = [&](const char* what, auto ask) {
        try {
            ask();
            ADD_FAILURE() << what << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            EXPECT_EQ(error.where(), what);
        }
    };
    const Experiment e = light_from({50});
    refused("layer", [&] { sample(s, e, 1, 1, 2); });
    refused("layer", [&] { sample(s, Experiment{}, 1, 1, 0); });
    refused("cell", [&] { into_cells(s, e, {16 * 8}, 1, 1); });
    refused("cell", [&] { into_cells(s, e, {-1}, 1, 1); });
    Experiment bad = e;
    bad.run.bounces = 0;
    refused("bounces", [&] { sample(s, bad, 1); });
}

}  // namespace
}  // namespace asperity

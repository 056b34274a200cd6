// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace asperity {
namespace {

using test::Case;
class WideTracerOn : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Surfaces, WideTracerOn,
    testing::Values(Case{"gaussian_smooth", "gaussian", 0.14}, Case{"gaussian", "gaussian", 0.42},
                    Case{"gaussian_rough", "gaussian", 0.99}, Case{"noise_smooth", "thesis", 0.05},
                    Case{"noise", "thesis", 0.2}, Case{"noise_rough", "thesis", 1.0},
                    Case{"ggx", "ggx", 0.5}),
    test::name_of_case);

TEST_P(WideTracerOn, AgreesWithThePlainTracerRayByRay) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main})
        for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
            Heightfield s = test::surface_of(GetParam(), 128);
            s.diagonal = diagonal;
            s.boundary = boundary;
            s.dx = 1.25;
            const test::Agreement a = test::follow_both(s, 8000, 3);
            EXPECT_LE(a.other_end, 1);
            EXPECT_LE(a.other_facet, 1);
            EXPECT_LT(a.furthest, 1e-2);
        }
}

TEST_P(WideTracerOn, EitherWayToReadMemoryGivesTheSameBits) {
    const Heightfield s = test::surface_of(GetParam(), 128);
    WideTracer wide(s, 1);
    const CounterRandom random(7, 0);
    std::vector<Ray> rays[2];
    std::vector<RayEnd> ends[2];
    for (const bool pay : {false, true}) {
        wide.let_gathers_pay(pay);
        std::vector<Ray>& r = rays[pay];
        for (std::uint64_t n = 0; n < 5000; ++n) {
            const auto place = random.uniform2(n, 0), cell = random.uniform2(n, 1);
            r.push_back({static_cast<int>(128 * cell[0]), static_cast<int>(128 * cell[1]), place[0],
                         place[1], double{wide.max_height()}, test::slanted(n)});
        }
        // Down to the surface, and from there on where they came from
        ends[pay].resize(r.size());
        wide.trace(r, ends[pay]);
        for (Ray& ray : r) ray.direction.z = -ray.direction.z;
        wide.trace(r, ends[pay]);
    }
    EXPECT_EQ(ends[0], ends[1]);
    for (std::size_t k = 0; k < rays[0].size(); ++k) {
        const Ray &a = rays[0][k], &b = rays[1][k];
        EXPECT_TRUE(a.i == b.i && a.j == b.j && a.u == b.u && a.v == b.v && a.z == b.z &&
                    a.facet == b.facet);
    }
}

/// Rays straight down onto a row, against the plain tracer's one by one.
TEST_P(WideTracerOn, LaunchesRowsAsThePlainTracerRayByRay) {
    const Heightfield s = test::surface_of(GetParam(), 128);
    const Tracer plain(s);
    const WideTracer wide(s, 1);
    const CounterRandom random(5, 0);
    for (std::uint64_t n = 0; n < 10; ++n) {
        const auto place = random.uniform2(n, 0), cell = random.uniform2(n, 1);
        const int i = static_cast<int>(100 * cell[0]), j = static_cast<int>(128 * cell[1]);
        constexpr int kCount = 28;
        PathWave wave;
        wide.clear(wave);
        wide.launch_down(place[0], place[1], {i, j, kCount}, {}, wave);
        ASSERT_EQ(wave.points.count, kCount);
        test::Agreement sum;
        for (int k = 0; k < kCount; ++k) {
            Ray ray{i + k, j, place[0], place[1], double{plain.max_height()}, {0, 0, -1}};
            RayEnd end;
            plain.trace({&ray, 1}, {&end, 1});
            ASSERT_EQ(end, RayEnd::Hit);
            test::compare_point(s, wave.points, static_cast<std::size_t>(k), ray, sum);
        }
        EXPECT_LE(sum.other_facet, 1);
        EXPECT_LT(sum.furthest, 1e-3);
    }
}

TEST_P(WideTracerOn, LaunchesLinesAsThePlainTracerRayByRay) {
    Heightfield s = test::surface_of(GetParam(), 128);
    s.dx = 1.25;
    const test::Agreement a = test::follow_lines(s, 40, 300);
    EXPECT_EQ(a.rays, 12000);
    EXPECT_LE(a.other_facet, 1);
    EXPECT_LT(a.furthest, 1e-3);
}

/// A plateau with trenches along y: of 16 cells one slopes down, one is the ground, one slopes up.
Heightfield trench(float depth) {
    Heightfield s;
    s.nx = s.ny = 64;
    for (int k = 0; k < s.nx * s.ny; ++k)
        s.heights.push_back(k % 16 == 8 || k % 16 == 9 ? -depth : 0);
    s.name = "trench";
    return s;
}

// Light at 89.9 degrees sinks by 0.0017 a cell: to the ground of the trench it takes 57,000 cells
TEST(WideTracer, FollowsLinesForAsLongAsItTakes) {
    const test::Agreement a = test::follow_lines(trench(100), 12, 100, [](std::uint64_t n) {
        return -from_spherical(radians(89.9), radians(n % 2 == 0 ? 90 : 270));
    });
    EXPECT_EQ(a.rays, 1200);
    EXPECT_EQ(a.other_end, 0);
    EXPECT_EQ(a.other_facet, 0);
    EXPECT_LT(a.furthest, 1e-2);
}

TEST(WideTracer, LinesEndSomewhere) {
    const Heightfield s = trench(10000);
    const WideTracer wide(s, 1);
    const Vec3 d = -from_spherical(radians(89.9), radians(90));
    LaunchLine line;
    LaunchStripe stripe = test::stripe_of(0, 16, 4, d);
    wide.start(line, 0.5, d);
    PathWave wave;
    wide.clear(wave);
    EXPECT_TRUE(wide.launch(line, stripe, {}, wave));
    // Cell 8 is the ground; the walls beside it end above
    EXPECT_EQ(stripe.round, LaunchLine::kMostRounds);
    EXPECT_EQ(stripe.next[8], 0);
    EXPECT_EQ(stripe.next[0], 4);
    EXPECT_GE(stripe.under_way(), 4u);
}

// A single float tells heights of 1e15 apart by 6.7e7
TEST(WideTracer, HeightsMayLieFarFromZero) {
    Heightfield low = test::surface_of({"thesis", "thesis", 0.2}, 64);
    for (float& h : low.heights) h = std::round(h * 8) / 8;
    Heightfield high = low;
    for (const float far : {0x1p20f, -0x1p20f}) {
        for (std::size_t k = 0; k < low.heights.size(); ++k) high.heights[k] = low.heights[k] + far;
        const test::Agreement a = test::follow_lines(high, 20, 100);
        EXPECT_EQ(a.rays, 2000);
        EXPECT_EQ(a.other_end, 0);
        EXPECT_LE(a.other_facet, 1);
        const test::Agreement b = test::follow_both(high, 2000, 3);
        EXPECT_LE(b.other_facet + b.other_end, 1);
    }
}

using FacetId = std::pair<std::int32_t, float>;

/// The facets that the rays of a stripe meet, sorted; waves are emptied whenever they are full.
std::vector<FacetId> landed(const WideTracer& wide, LaunchStripe stripe, double offset,
                            const Vec3& d) {
    LaunchLine line;
    wide.start(line, offset, d);
    PathWave wave;
    std::vector<FacetId> all;
    for (bool done = false; !done;) {
        wide.clear(wave);
        done = wide.launch(line, stripe, {}, wave);
        wide.land(line, d, wave);
        for (std::size_t k = 0; k < wave.points.count; ++k)
            all.emplace_back(wave.points.corner[k], wave.points.side[k]);
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST_P(WideTracerOn, LaunchesManyLinesAsEachByItself) {
    const WideTracer wide(test::surface_of(GetParam(), 128), 1);
    for (std::uint64_t n = 0; n < 8; ++n) {
        const Vec3 d = test::slanted(n);
        const int first = static_cast<int>(n * 16), lines = kLaunchGroup - static_cast<int>(n % 3);
        const LaunchStripe stripe = test::stripe_of(first, lines, 200, d);
        std::vector<FacetId> single;
        for (int k = 0; k < lines; ++k) {
            LaunchStripe one = test::stripe_of((first + k) % 128, 1, 200, d);
            one.phase[0] = stripe.phase[k];
            const std::vector<FacetId> of_line = landed(wide, one, 0.3, d);
            single.insert(single.end(), of_line.begin(), of_line.end());
        }
        std::sort(single.begin(), single.end());
        const std::vector<FacetId> together = landed(wide, stripe, 0.3, d);
        ASSERT_EQ(together.size(), single.size());
        // A ray that a full wave puts off is computed afresh: the last bit may differ
        std::vector<FacetId> differing;
        std::set_difference(together.begin(), together.end(), single.begin(), single.end(),
                            std::back_inserter(differing));
        EXPECT_LE(differing.size(), 1u);
    }
}

}  // namespace
}  // namespace asperity

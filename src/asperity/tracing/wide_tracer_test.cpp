// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace asperity {
namespace {

using test::Case;
class WideTracerOn : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, WideTracerOn,
                         testing::Values(Case{"gaussian_smooth", SurfaceKind::Gaussian, 0.14},
                                         Case{"gaussian", SurfaceKind::Gaussian, 0.42},
                                         Case{"gaussian_rough", SurfaceKind::Gaussian, 0.99},
                                         Case{"noise_smooth", SurfaceKind::Thesis, 0.05},
                                         Case{"noise", SurfaceKind::Thesis, 0.2},
                                         Case{"noise_rough", SurfaceKind::Thesis, 1.0},
                                         Case{"ggx", SurfaceKind::Ggx, 0.5}),
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

/// Rays side by side along a line, against the plain tracer's one by one.
void follow_row(const Heightfield& s, const Vec3& d, double u, double v, int i, int j) {
    const Tracer plain(s);
    const WideTracer wide(s, 1);
    // The row goes on at the other end of the tile
    constexpr int kCount = 100;
    const int before = std::min(kCount, s.nx - i);
    const LaunchedRow pieces[] = {{i, j, before, 0}, {0, j, kCount - before, before}};
    PathWave wave;
    wide.clear(wave);
    if (d.x == 0 && d.y == 0) {
        for (const LaunchedRow& piece : pieces) wide.launch_down(u, v, piece, {}, wave);
    } else {
        LaunchLine line;
        line.start(wide.heights(), u, v, double{wide.max_height()}, d);
        for (const LaunchedRow& piece : pieces) wide.launch(line, piece, {}, wave);
    }
    wide.land(d, wave);
    ASSERT_EQ(wave.points.count, kCount);
    int differing = 0;
    for (std::size_t k = 0; k < kCount; ++k) {
        Ray ray;
        ray.i = (i + wave.points.path[k]) % s.nx;
        ray.j = j;
        ray.u = u;
        ray.v = v;
        ray.z = double{plain.max_height()};
        ray.direction = d;
        RayEnd end;
        plain.trace({&ray, 1}, {&end, 1});
        ASSERT_EQ(end, RayEnd::Hit);
        // Corners are counted from the middle of the tile
        const bool upper = ray.facet == static_cast<int>(Triangle::Upper);
        const auto tile = [](int a, int n) { return (a % n + n) % n; };
        const int x = vertex_x(wave.points.corner[k]) + (s.nx / 2 & ~3) - (upper ? 1 : 0);
        const int y = vertex_y(wave.points.corner[k]) + (s.ny / 2 & ~3) - (upper ? 1 : 0);
        const bool same =
            tile(x, s.nx) == ray.i && tile(y, s.ny) == ray.j && (wave.points.side[k] < 0) == upper;
        differing += same ? 0 : 1;
        if (same && upper) {
            EXPECT_NEAR(wave.points.u[k], 1 - ray.u, 1e-3);
            EXPECT_NEAR(wave.points.v[k], 1 - ray.v, 1e-3);
        } else if (same) {
            EXPECT_NEAR(wave.points.u[k], ray.u, 1e-3);
            EXPECT_NEAR(wave.points.v[k], ray.v, 1e-3);
        }
    }
    EXPECT_LE(differing, 1);
}

TEST_P(WideTracerOn, LaunchesRowsAsThePlainTracerRayByRay) {
    const Heightfield s = test::surface_of(GetParam(), 128);
    const CounterRandom random(5, 0);
    for (std::uint64_t n = 0; n < 40; ++n) {
        const auto p = random.uniform2(n, 0), q = random.uniform2(n, 1), r = random.uniform2(n, 2);
        // Every fourth along an axis or a diagonal, every eighth straight down
        const double phi = n % 4 == 0 ? std::floor(8 * q[1]) * kPi / 4 : 2 * kPi * q[1];
        const Vec3 d = n % 8 == 1 ? Vec3{0, 0, -1} : -from_spherical(q[0] * radians(88), phi);
        follow_row(s, d, p[0], p[1], static_cast<int>(128 * r[0]), static_cast<int>(128 * r[1]));
    }
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/random.h>
#include <asperity/tracing/engines/plain/tracer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace asperity {
namespace {

Heightfield random_surface(int nx, int ny, double height, Diagonal diagonal, std::uint64_t seed) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    s.dx = 1.25;
    s.dy = 0.75;
    s.diagonal = diagonal;
    const CounterRandom random(seed, 0);
    for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(nx * ny); ++k)
        s.heights.push_back(static_cast<float>(height * random.uniform2(k)[0]));
    return s;
}

/// Heights between the samples of the periodic surface, straight from the definition of its
/// triangles; shares nothing with the tracer.
double height_at(const Heightfield& s, double x, double y) {
    const double gx = x / s.dx, gy = y / s.dy;
    const double i = std::floor(gx), j = std::floor(gy), u = gx - i, v = gy - j;
    const auto h = [&](int a, int b) {
        const int p = ((static_cast<int>(i) + a) % s.nx + s.nx) % s.nx;
        const int q = ((static_cast<int>(j) + b) % s.ny + s.ny) % s.ny;
        return double{s.heights[static_cast<std::size_t>(q * s.nx + p)]};
    };
    if (s.diagonal == Diagonal::Anti)
        return u + v < 1 ? h(0, 0) + u * (h(1, 0) - h(0, 0)) + v * (h(0, 1) - h(0, 0))
                         : h(1, 1) + (1 - u) * (h(0, 1) - h(1, 1)) + (1 - v) * (h(1, 0) - h(1, 1));
    return u > v ? h(0, 0) + u * (h(1, 0) - h(0, 0)) + v * (h(1, 1) - h(1, 0))
                 : h(0, 0) + v * (h(0, 1) - h(0, 0)) + u * (h(1, 1) - h(0, 1));
}

Vec3 position(const Heightfield& s, const Ray& r) {
    return {(r.i + r.u) * s.dx, (r.j + r.v) * s.dy, r.z};
}

struct BruteHit {
    double t;
    int i, j;  ///< cell in the plane, not wrapped
    Triangle triangle;
};

/// Nearest of all triangles of the cells within `reach` of the origin, by plane intersection and
/// three edge functions, in long double.
std::optional<BruteHit> brute_force(const Heightfield& s, Vec3 o, Vec3 d, int reach) {
    std::optional<BruteHit> nearest;
    const int ci = static_cast<int>(std::floor(o.x / s.dx)),
              cj = static_cast<int>(std::floor(o.y / s.dy));
    const auto wrap = [](int a, int n) { return (a % n + n) % n; };
    for (int j = cj - reach; j <= cj + reach; ++j)
        for (int i = ci - reach; i <= ci + reach; ++i)
            for (const Triangle t : {Triangle::Lower, Triangle::Upper}) {
                const Slope g = facet_slope(s, wrap(i, s.nx), wrap(j, s.ny), t);
                // One corner of each triangle: lower has (i, j), upper has (i + 1, j + 1).
                const int a = t == Triangle::Lower ? 0 : 1;
                const long double hx = static_cast<long double>(i + a) * s.dx;
                const long double hy = static_cast<long double>(j + a) * s.dy;
                const long double h = s.at(wrap(i + a, s.nx), wrap(j + a, s.ny));
                const long double denominator = d.z - g.x * d.x - g.y * d.y;
                if (denominator >= 0) continue;  // from behind or along
                const long double time =
                    (h + g.x * (o.x - hx) + g.y * (o.y - hy) - o.z) / denominator;
                if (time < 0) continue;
                const long double u = (o.x + time * d.x) / s.dx - i,
                                  v = (o.y + time * d.y) / s.dy - j;
                const long double side = s.diagonal == Diagonal::Anti ? 1 - u - v : u - v;
                if (u < 0 || u > 1 || v < 0 || v > 1) continue;
                if ((side >= 0) != (t == Triangle::Lower)) continue;
                if (!nearest || time < nearest->t)
                    nearest = BruteHit{static_cast<double>(time), i, j, t};
            }
    return nearest;
}

/// The k-th of many rays at the highest point's height, anywhere over the tile, on their way down
/// at up to `largest_theta` from the normal.
Ray ray_from_above(const Tracer& tracer, const CounterRandom& random, std::uint64_t k,
                   double largest_theta) {
    const Heightfield& s = tracer.surface();
    const auto p = random.uniform2(k, 0), q = random.uniform2(k, 1);
    Ray ray;
    ray.i = static_cast<int>(p[0] * s.nx);
    ray.j = static_cast<int>(p[1] * s.ny);
    ray.u = p[0] * s.nx - ray.i;
    ray.v = p[1] * s.ny - ray.j;
    ray.z = double{tracer.max_height()};
    ray.direction = -from_spherical(q[0] * largest_theta, 2 * kPi * q[1]);
    return ray;
}

class TracerOnBothDiagonals : public testing::TestWithParam<Diagonal> {};
INSTANTIATE_TEST_SUITE_P(Diagonals, TracerOnBothDiagonals,
                         testing::Values(Diagonal::Anti, Diagonal::Main));

TEST_P(TracerOnBothDiagonals, AgreesWithBruteForceRayForRay) {
    const Heightfield s = random_surface(13, 9, 3, GetParam(), 4);
    const Tracer tracer(s);
    const CounterRandom random(11, 0);
    int hits = 0, differing = 0;
    for (std::uint64_t k = 0; k < 4000; ++k) {
        Ray ray = ray_from_above(tracer, random, k, radians(75));
        const Vec3 o = position(s, ray), d = ray.direction;
        const auto expected = brute_force(s, o, d, 17);
        RayEnd end;
        tracer.trace({&ray, 1}, {&end, 1});
        ASSERT_EQ(end, RayEnd::Hit);
        ASSERT_TRUE(expected);
        ++hits;
        const bool same = ((expected->i % s.nx) + s.nx) % s.nx == ray.i &&
                          ((expected->j % s.ny) + s.ny) % s.ny == ray.j &&
                          static_cast<Triangle>(ray.facet) == expected->triangle;
        if (!same) ++differing;
        if (same) {
            EXPECT_NEAR(ray.z, o.z + expected->t * d.z, 1e-9);
        }
    }
    EXPECT_EQ(hits, 4000);
    EXPECT_EQ(differing, 0);
}

TEST_P(TracerOnBothDiagonals, ReflectedRaysAgreeWithBruteForce) {
    const Heightfield s = random_surface(16, 8, 4, GetParam(), 9);
    const Tracer tracer(s);
    const CounterRandom random(12, 0);
    int compared = 0, differing = 0;
    for (std::uint64_t k = 0; k < 3000; ++k) {
        Ray ray = ray_from_above(tracer, random, k, radians(70));
        RayEnd end;
        tracer.trace({&ray, 1}, {&end, 1});
        const Vec3 wm = tracer.normal(ray);
        ray.direction = -reflect(ray.direction, wm);
        // The brute force has no memory of the facet: lift its start off the surface a little.
        const Vec3 o = position(s, ray) + 1e-10 * wm, d = ray.direction;
        const auto expected = brute_force(s, o, d, 20);
        tracer.trace({&ray, 1}, {&end, 1});
        if (end == RayEnd::Escaped && expected && d.z < 0.2) continue;  // met beyond the reach
        ++compared;
        if (end == RayEnd::Escaped)
            differing += expected.has_value();
        else if (!expected)
            differing += std::abs(d.z) > 0.3;
        else
            differing += ((expected->i % s.nx) + s.nx) % s.nx != ray.i ||
                         ((expected->j % s.ny) + s.ny) % s.ny != ray.j;
    }
    EXPECT_GT(compared, 2900);
    EXPECT_EQ(differing, 0);
}

TEST_P(TracerOnBothDiagonals, LeaksNothingAtVerticesEdgesAndAlongAxes) {
    // Rays aimed exactly at vertices and edges, straight down, along the axes and the diagonals,
    // level and nearly level: every one coming down must meet the surface, at its height.
    const Heightfield s = random_surface(8, 8, 2, GetParam(), 3);
    const Tracer tracer(s);
    std::vector<Vec3> directions;
    for (const double theta : {0.0, 1e-12, 30.0, 45.0, 89.0, 89.999})
        for (int eighth = 0; eighth < 8; ++eighth) {
            Vec3 d = -from_spherical(radians(theta), eighth * kPi / 4);
            if (std::abs(d.x) < 1e-9) d.x = 0;
            if (std::abs(d.y) < 1e-9) d.y = 0;
            directions.push_back(d);
        }
    for (int corner = 0; corner < 9; ++corner)
        for (const Vec3 d : directions) {
            Ray ray;
            ray.i = 3;
            ray.j = 5;
            ray.u = corner % 3 * 0.5;
            ray.v = corner / 3 * 0.5;
            ray.z = double{tracer.max_height()};
            ray.direction = d;
            RayEnd end;
            tracer.trace({&ray, 1}, {&end, 1});
            ASSERT_EQ(end, RayEnd::Hit) << corner << " " << d.x << " " << d.y << " " << d.z;
            const Vec3 p = position(s, ray);
            // On an edge both neighbours' planes agree to rounding.
            EXPECT_NEAR(p.z, height_at(s, p.x + 1e-13, p.y + 1e-13), 1e-11);
            ASSERT_LT(dot(d, tracer.normal(ray)), 0);
        }
}

TEST(Tracer, PeriodicSurfaceHasNoSeam) {
    // The same surface, its samples turned round by (5, 3): same path, same end, bit for bit.
    const Heightfield s = random_surface(16, 16, 3, Diagonal::Anti, 21);
    Heightfield turned = s;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i)
            turned.heights[static_cast<std::size_t>((j + 3) % 16 * 16 + (i + 5) % 16)] = s.at(i, j);
    const Tracer tracer(s), turned_tracer(turned);
    const CounterRandom random(5, 0);
    for (std::uint64_t k = 0; k < 2000; ++k) {
        const auto p = random.uniform2(k, 0), q = random.uniform2(k, 1);
        Ray a;
        a.i = static_cast<int>(k % 16);
        a.j = static_cast<int>(k / 16 % 16);
        a.u = p[0];
        a.v = p[1];
        a.z = double{tracer.max_height()};
        a.direction = -from_spherical(1.5 * q[0], 2 * kPi * q[1]);
        Ray b = a;
        b.i = (a.i + 5) % 16;
        b.j = (a.j + 3) % 16;
        RayEnd end_a, end_b;
        tracer.trace({&a, 1}, {&end_a, 1});
        turned_tracer.trace({&b, 1}, {&end_b, 1});
        ASSERT_EQ(end_a, RayEnd::Hit);
        ASSERT_EQ(end_b, RayEnd::Hit);
        EXPECT_EQ((a.i + 5) % 16, b.i);
        EXPECT_EQ((a.j + 3) % 16, b.j);
        EXPECT_EQ(a.facet, b.facet);
        // The tiles of the bounds lie elsewhere, so jumps end elsewhere: equal to rounding.
        EXPECT_NEAR(a.u, b.u, 1e-11);
        EXPECT_NEAR(a.z, b.z, 1e-11);
    }
}

TEST(Tracer, LevelLightOnAFlatSurfaceEscapes) {
    Heightfield s;
    s.nx = s.ny = 4;
    s.heights.assign(16, 1.0f);
    const Tracer tracer(s);
    Ray ray;
    ray.u = ray.v = 0.25;
    ray.z = 1;
    ray.direction = {1, 0, 0};
    RayEnd end;
    tracer.trace({&ray, 1}, {&end, 1});
    EXPECT_EQ(end, RayEnd::Escaped);
}

TEST(Tracer, LevelLightInAGrooveIsReportedAsStuck) {
    // Grooves along y, light along y below the crests: it meets nothing, ever.
    Heightfield s;
    s.nx = 4;
    s.ny = 4;
    for (int k = 0; k < 16; ++k) s.heights.push_back(k % 2 == 0 ? 0.0f : 1.0f);
    const Tracer tracer(s);
    Ray ray;
    ray.u = 0.1;
    ray.z = 0.5;
    ray.direction = {0, 1, 0};
    RayEnd end;
    tracer.trace({&ray, 1}, {&end, 1});
    EXPECT_EQ(end, RayEnd::Stuck);
}

TEST(Tracer, FinitePatchLosesRaysThroughItsSide) {
    Heightfield s;
    s.nx = s.ny = 5;
    s.boundary = Boundary::Finite;
    s.heights.assign(25, 0.0f);
    s.heights[12] = 2.0f;  // one spike in the middle
    const Tracer tracer(s);
    const auto end_of = [&](int i, double u, Vec3 d) {
        Ray ray;
        ray.i = i;
        ray.j = 1;
        ray.u = u;
        ray.v = 0.5;
        ray.z = 2;
        ray.direction = normalize(d);
        RayEnd end;
        tracer.trace({&ray, 1}, {&end, 1});
        return end;
    };
    EXPECT_EQ(end_of(3, 0.5, {0, 0, -1}), RayEnd::Hit);
    EXPECT_EQ(end_of(3, 0.5, {1, 0, -0.5}), RayEnd::Edge);  // 0.25 down at the side, 0.5 away
}

TEST(HeightBounds, CostALittleBesideTheHeights) {
    const Heightfield s = random_surface(512, 512, 1, Diagonal::Anti, 1);
    EXPECT_LT(static_cast<double>(Tracer(s).memory_bytes()) / (512.0 * 512.0), 0.07);
}

}  // namespace
}  // namespace asperity

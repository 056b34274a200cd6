// SPDX-License-Identifier: Apache-2.0
//
// For tests: the plain tracer and the wide one follow the same rays.
#pragma once

#include <asperity/core/directions.h>
#include <asperity/core/random.h>
#include <asperity/surface/make_surface.h>
#include <asperity/tracing/engines/wide/wide_tracer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace asperity::test {

/// A surface to try the tracers on.
struct Case {
    const char* name;
    const char* kind;
    double strength;     ///< roughness or alpha, whichever the kind has
    double ties = 1e-5;  ///< share of the rays that may end otherwise
};
/// The name of the surface, not its bytes.
inline void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}
/// Names the tests of a suite after their surfaces.
inline std::string name_of_case(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

/// A level surface.
inline Heightfield level_tile(int nx, int ny) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    s.heights.assign(static_cast<std::size_t>(nx * ny), 0.0f);
    return s;
}

/// What two tracers made of the same rays.
struct Agreement {
    int rays = 0;
    int other_end = 0;    ///< one hit, the other left
    int other_facet = 0;  ///< both hit, but not the same facet
    double furthest = 0;  ///< largest distance of hits on the same facet [cells]
};

inline Vec3 position_of(const Heightfield& s, const Ray& r) {
    return {(r.i + r.u) * s.dx, (r.j + r.v) * s.dy, r.z};
}

inline void compare(const Heightfield& s, const std::vector<Ray>& a,
                    const std::vector<RayEnd>& a_ends, const std::vector<Ray>& b,
                    const std::vector<RayEnd>& b_ends, Agreement& sum) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        ++sum.rays;
        if (a_ends[k] != b_ends[k]) {
            ++sum.other_end;
        } else if (a_ends[k] == RayEnd::Hit) {
            if (a[k].i != b[k].i || a[k].j != b[k].j || a[k].facet != b[k].facet)
                ++sum.other_facet;
            else
                sum.furthest =
                    std::max(sum.furthest, length(position_of(s, a[k]) - position_of(s, b[k])));
        }
    }
}

/// Rays from above, steep to grazing, then three reflections; both tracers get the plain one's
/// rays each time.
inline Agreement follow_both(const Heightfield& s, int rays, std::uint64_t seed) {
    const Tracer plain(s);
    const WideTracer wide(s, 1);
    const CounterRandom random(seed, 0);
    std::vector<Ray> start;
    for (int k = 0; k < rays; ++k) {
        const auto p = random.uniform2(static_cast<std::uint64_t>(k), 0),
                   q = random.uniform2(static_cast<std::uint64_t>(k), 1);
        Ray ray;
        ray.i = static_cast<int>(p[0] * s.cells_x());
        ray.j = static_cast<int>(p[1] * s.cells_y());
        ray.u = p[0] * s.cells_x() - ray.i;
        ray.v = p[1] * s.cells_y() - ray.j;
        ray.z = double{plain.max_height()};
        ray.direction = -from_spherical(q[0] * radians(88), 2 * kPi * q[1]);
        // Some along the axes and diagonals, some through vertices, some straight down
        if (k % 16 == 0)
            ray.direction = -from_spherical(q[0] * radians(88), std::floor(8 * q[1]) * kPi / 4);
        if (k % 16 == 1) ray.u = ray.v = 0;
        if (k % 64 == 2) ray.direction = {0, 0, -1};
        start.push_back(ray);
    }
    Agreement sum;
    for (int bounce = 0; bounce < 4 && !start.empty(); ++bounce) {
        std::vector<Ray> a = start, b = start;
        std::vector<RayEnd> a_ends(a.size()), b_ends(b.size());
        plain.trace(a, a_ends);
        wide.trace(b, b_ends);
        compare(s, a, a_ends, b, b_ends, sum);
        start.clear();
        for (std::size_t k = 0; k < a.size(); ++k)
            if (a_ends[k] == RayEnd::Hit) {
                a[k].direction = normalize(-reflect(a[k].direction, plain.normal(a[k])));
                start.push_back(a[k]);
            }
    }
    return sum;
}

/// A slanted direction of light; every fourth runs along an axis or a diagonal.
inline Vec3 slanted(std::uint64_t n) {
    const auto q = CounterRandom(5, 1).uniform2(n, 0);
    const double phi = n % 4 == 0 ? std::floor(8 * q[1]) * kPi / 4 : 2 * kPi * q[1];
    return -from_spherical(radians(1 + 87 * q[0]), phi);
}

/// A stripe of lines of `rays` rays each; their last ray starts 128 cells further than the first.
inline LaunchStripe stripe_of(int first, int lines, int rays, const Vec3& d) {
    LaunchStripe stripe;
    stripe.first = first;
    stripe.lines = lines;
    for (std::size_t k = 0; k < static_cast<std::size_t>(lines); ++k) {
        stripe.rays[k] = rays;
        stripe.phase[k] = 0.618 * static_cast<double>(k + 1);
        stripe.spacing[k] = -d.z / std::hypot(d.x, d.y) * 128 / rays;
        stripe.per_spacing[k] = 1 / stripe.spacing[k];
    }
    std::fill_n(stripe.shade, kLaunchGroup, -std::numeric_limits<float>::infinity());
    return stripe;
}

/// Compares the k-th point of a wave with where the plain tracer's ray has hit.
inline void compare_point(const Heightfield& s, const FacetPoints& points, std::size_t k,
                          const Ray& ray, Agreement& sum) {
    // Corners are counted from the middle of the tile
    const bool upper = ray.facet == static_cast<int>(Triangle::Upper);
    const auto tile = [](int a, int n) { return (a % n + n) % n; };
    const int x = vertex_x(points.corner[k]) + (s.nx / 2 & ~3) - (upper ? 1 : 0);
    const int y = vertex_y(points.corner[k]) + (s.ny / 2 & ~3) - (upper ? 1 : 0);
    ++sum.rays;
    if (tile(x, s.nx) != ray.i || tile(y, s.ny) != ray.j || (points.side[k] < 0) != upper) {
        ++sum.other_facet;
        return;
    }
    const double u = upper ? 1 - ray.u : ray.u, v = upper ? 1 - ray.v : ray.v;
    sum.furthest = std::max(sum.furthest, std::hypot(static_cast<double>(points.u[k]) - u,
                                                     static_cast<double>(points.v[k]) - v));
}

/// Lines of light, line n along direction(n), of `rays` rays each: those of a line land in order,
/// and the plain tracer follows them one by one.
template <class Direction>
Agreement follow_lines(const Heightfield& s, int lines, int rays, Direction direction) {
    const Tracer plain(s);
    const WideTracer wide(s, 1);
    Agreement sum;
    PathWave wave;
    LaunchLine line;
    for (int n = 0; n < lines; ++n) {
        const auto number = static_cast<std::uint64_t>(n);
        const auto p = CounterRandom(5, 2).uniform2(number, 0);
        const Vec3 d = direction(number);
        const bool along_x = wide.lines_along_x(d);
        const int first = static_cast<int>((along_x ? s.ny : s.nx) * p[0]);
        LaunchStripe stripe = stripe_of(first, 1, rays, d);
        const double phase = stripe.phase[0], spacing = stripe.spacing[0];
        wide.start(line, p[1], d);
        int k = 0;
        for (bool done = false; !done;) {
            wide.clear(wave);
            done = wide.launch(line, stripe, {}, wave);
            wide.land(line, d, wave);
            for (std::size_t point = 0; point < wave.points.count; ++point, ++k) {
                Ray ray;
                (along_x ? ray.j : ray.i) = first;
                (along_x ? ray.v : ray.u) = p[1];
                ray.z = double{plain.max_height()} + (phase + k) * spacing;
                ray.direction = d;
                RayEnd end;
                plain.trace({&ray, 1}, {&end, 1});
                if (end == RayEnd::Hit)
                    compare_point(s, wave.points, point, ray, sum);
                else
                    ++sum.other_end;
            }
        }
        EXPECT_EQ(k, rays);
    }
    return sum;
}

/// The same of many directions.
inline Agreement follow_lines(const Heightfield& s, int lines, int rays) {
    return follow_lines(s, lines, rays, slanted);
}

inline Heightfield surface_of(const Case& c, int size) {
    SurfaceSettings settings;
    settings.kind = c.kind;
    settings.size = size;
    settings.roughness = c.strength;
    settings.alpha_x = settings.alpha_y = c.strength;
    asperity::Run run;
    return make_surface(settings, run);
}

}  // namespace asperity::test

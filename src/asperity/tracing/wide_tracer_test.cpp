// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/random.h>
#include <asperity/surface/make_surface.h>
#include <asperity/tracing/wide_tracer.h>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

/// What two tracers made of the same rays.
struct Agreement {
    int rays = 0;
    int other_end = 0;    ///< one hit, the other left
    int other_facet = 0;  ///< both hit, but not the same facet
    double furthest = 0;  ///< largest distance of hits on the same facet [cells]
};

Vec3 position(const Heightfield& s, const Ray& r) {
    return {(r.i + r.u) * s.dx, (r.j + r.v) * s.dy, r.z};
}

void compare(const Heightfield& s, const std::vector<Ray>& a, const std::vector<RayEnd>& a_ends,
             const std::vector<Ray>& b, const std::vector<RayEnd>& b_ends, Agreement& sum) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        ++sum.rays;
        if (a_ends[k] != b_ends[k]) {
            ++sum.other_end;
        } else if (a_ends[k] == RayEnd::Hit) {
            if (a[k].i != b[k].i || a[k].j != b[k].j || a[k].facet != b[k].facet)
                ++sum.other_facet;
            else
                sum.furthest =
                    std::max(sum.furthest, length(position(s, a[k]) - position(s, b[k])));
        }
    }
}

/// Rays from above, steep to grazing, then three reflections; both tracers get the plain one's
/// rays each time.
Agreement follow_both(const Heightfield& s, int rays, std::uint64_t seed) {
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

Heightfield surface_of(SurfaceKind kind, double strength, int size) {
    SurfaceSettings settings;
    settings.kind = kind;
    settings.size = size;
    settings.roughness = strength;
    settings.alpha_x = settings.alpha_y = strength;
    asperity::Run run;
    return make_surface(settings, run);
}

struct Case {
    const char* name;
    SurfaceKind kind;
    double strength;
};
class WideTracerOn : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, WideTracerOn,
                         testing::Values(Case{"gaussian_smooth", SurfaceKind::Gaussian, 0.14},
                                         Case{"gaussian", SurfaceKind::Gaussian, 0.42},
                                         Case{"gaussian_rough", SurfaceKind::Gaussian, 0.99},
                                         Case{"noise_smooth", SurfaceKind::Thesis, 0.05},
                                         Case{"noise", SurfaceKind::Thesis, 0.2},
                                         Case{"noise_rough", SurfaceKind::Thesis, 1.0},
                                         Case{"ggx", SurfaceKind::Ggx, 0.5}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(WideTracerOn, AgreesWithThePlainTracerRayByRay) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main})
        for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
            Heightfield s = surface_of(GetParam().kind, GetParam().strength, 128);
            s.diagonal = diagonal;
            s.boundary = boundary;
            s.dx = 1.25;
            const Agreement a = follow_both(s, 8000, 3);
            printf("%s %d %d: rays %d end %d facet %d furthest %g\n", GetParam().name,
                   static_cast<int>(diagonal), static_cast<int>(boundary), a.rays, a.other_end,
                   a.other_facet, a.furthest);
            EXPECT_LE(a.other_end, 3);
            EXPECT_LE(a.other_facet, 3);
            EXPECT_LT(a.furthest, 1e-2);
        }
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/ggx.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/normal_distribution.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

SurfaceSettings ggx(int size, double alpha_x, double alpha_y, double length = 8) {
    SurfaceSettings s = settings_of("ggx", size);
    s.alpha_x = alpha_x;
    s.alpha_y = alpha_y;
    s.correlation_x = s.correlation_y = length;
    return s;
}

double distance(const SurfaceSettings& s, const Heightfield& surface) {
    return slope_distribution_distance(surface,
                                       {SlopeFamily::Ggx, s.alpha_x, s.alpha_y, s.max_slope}, 2);
}

/// Share of facets whose slope along x (or y) is smaller than `limit`.
double share_below(const std::vector<Slope>& slopes, double Slope::*axis, double limit) {
    double below = 0;
    for (const Slope& s : slopes) below += std::abs(s.*axis) < limit ? 1 : 0;
    return below / static_cast<double>(slopes.size());
}

TEST(Ggx, SlopeLengthsFollowTheLaw) {
    for (const double alpha : {0.1, 0.8}) {
        const SurfaceSettings settings = ggx(512, alpha, alpha);
        const Heightfield surface = make(settings);
        EXPECT_LT(distance(settings, surface), 0.005) << alpha;
        EXPECT_TRUE(surface.isotropic);
        // With F(tan theta) = t^2 / (alpha^2 + t^2) the mean tilt is the integral of 1 - F over
        // theta: integral of alpha^2 / (alpha^2 + tan^2) = (pi / 2) alpha / (1 + alpha).
        EXPECT_NEAR(statistics(surface, 2).mean_tilt_deg, 90 * alpha / (1 + alpha), 0.1);
    }
}

// A plain count of exact lengths, next to the one by bins.
TEST(Ggx, DistanceAgreesWithSortedLengths) {
    const SurfaceSettings settings = ggx(128, 0.5, 0.3, 4);
    const Heightfield surface = make(settings);
    const SlopeLaw law{SlopeFamily::Beckmann, 0.4, 0.4};
    std::vector<double> lengths;
    for (const Slope s : testing::all_slopes(surface))
        lengths.push_back(std::hypot(s.x, s.y) / 0.4);
    const double exact =
        testing::ks_distance(lengths, [](double r) { return 1 - std::exp(-r * r); });
    EXPECT_NEAR(slope_distribution_distance(surface, law, 2), exact, 3e-4);
}

// GGX along one axis: share of |slope| < t is t / sqrt(alpha^2 + t^2); at t = alpha, 1 / sqrt2.
TEST(Ggx, MeetsBothAlphas) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        SurfaceSettings settings = ggx(256, 0.4, 0.2, 4);
        settings.diagonal = diagonal;
        const Heightfield surface = make(settings);
        EXPECT_LT(distance(settings, surface), 0.005);
        const auto slopes = testing::all_slopes(surface);
        for (const double t : {0.5, 1.0, 2.0}) {
            const double expected = t / std::sqrt(1 + t * t);
            EXPECT_NEAR(share_below(slopes, &Slope::x, 0.4 * t), expected, 0.008) << t;
            EXPECT_NEAR(share_below(slopes, &Slope::y, 0.2 * t), expected, 0.008) << t;
        }
        EXPECT_FALSE(surface.isotropic);
    }
}

// For both triangles of a cell alike, not only on average.
TEST(Ggx, UpperAndLowerFacetsFollowTheSameLaw) {
    const SurfaceSettings settings = ggx(512, 0.5, 0.5);
    const Heightfield surface = make(settings);
    EXPECT_LT(distance(settings, surface), 0.002);
    double below_lower = 0, below_upper = 0;
    for (int j = 0; j < 512; ++j)
        visit_facets(surface, j, [&](int, Triangle t, Slope s) {
            (t == Triangle::Lower ? below_lower : below_upper) +=
                std::hypot(s.x, s.y) < 0.5 ? 1 : 0;
        });
    EXPECT_NEAR(below_lower / (512 * 512), 0.5, 0.004);
    EXPECT_NEAR(below_upper / (512 * 512), 0.5, 0.004);
}

TEST(Ggx, CutsSteepFacets) {
    SurfaceSettings settings = ggx(256, 0.5, 0.5);
    settings.max_slope = 3;
    const Heightfield surface = make(settings);
    // Without the cut the steepest of 131,072 facets would have slope 0.5 sqrt(131072) = 181, and
    // 1 / 37 of them more than 3. Least squares smooth the edge the cut leaves in the distribution.
    EXPECT_LT(std::tan(radians(statistics(surface, 2).max_tilt_deg)), 1.2 * 3);
    EXPECT_LT(distance(settings, surface), 1 / 37.0);
}

// sigma(w) of GGX by Smith: cos(theta) (1 + Lambda), Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2
// (Walter et al. 2007, equation 34). A clip at slope 10 removes area that only steep facets have.
TEST(Ggx, ProjectedAreaFollowsSmith) {
    const Heightfield surface = make(ggx(512, 0.3, 0.3, 4));
    for (const double theta_deg : {20.0, 45.0, 60.0, 75.0}) {
        const double theta = radians(theta_deg), t = 0.3 * std::tan(theta);
        const double expected = std::cos(theta) * (1 + std::sqrt(1 + t * t)) / 2;
        for (const double phi : {0.0, 1.0, 4.0})
            EXPECT_NEAR(projected_area(surface, from_spherical(theta, phi), 2), expected, 0.004);
    }
}

TEST(Ggx, SameBitsForAnyNumberOfThreads) {
    for (const int size : {96, 125}) {
        const SurfaceSettings settings = ggx(size, 0.5, 0.4);
        const auto reference = make(settings, 1).heights;
        for (const int threads : {2, 3, 7})
            EXPECT_EQ(make(settings, threads).heights, reference) << size << ' ' << threads;
    }
}

TEST(Ggx, WorksOnOblongCells) {
    SurfaceSettings settings = ggx(256, 0.4, 0.4, 6);
    settings.cell_x = 1;
    settings.cell_y = 1.5;
    const Heightfield surface = make(settings);
    EXPECT_LT(distance(settings, surface), 0.005);
    const auto slopes = testing::all_slopes(surface);
    EXPECT_NEAR(share_below(slopes, &Slope::x, 0.4), std::sqrt(0.5), 0.03);
    EXPECT_NEAR(share_below(slopes, &Slope::y, 0.4), std::sqrt(0.5), 0.03);
}

// Other laws, other starting points: from thesis noise to Beckmann.
TEST(ImposeSlopeLaw, TurnsNoiseIntoBeckmann) {
    SurfaceSettings settings = settings_of("thesis", 256);
    settings.roughness = 0.05;
    Heightfield surface = make(settings);
    const SlopeLaw law{SlopeFamily::Beckmann, 0.3, 0.3};
    EXPECT_GT(slope_distribution_distance(surface, law, 2), 0.02);
    asperity::Run run(2);
    impose_slope_law(surface, law, 8, run);
    EXPECT_LT(slope_distribution_distance(surface, law, 2), 0.01);
    EXPECT_NEAR(statistics(surface, 2).rms_gradient, 0.3, 0.003);
}

TEST(ImposeSlopeLaw, LeavesAFlatSurfaceFlat) {
    Heightfield surface = testing::flat_grid(16, 12);
    asperity::Run run(2);
    impose_slope_law(surface, {}, 2, run);
    for (const float h : surface.heights) EXPECT_EQ(h, 0.0F);
}

}  // namespace
}  // namespace asperity

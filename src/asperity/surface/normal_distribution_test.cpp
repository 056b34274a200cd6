// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/normal_distribution.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

double total(const NormalDistribution& d) {
    double sum = 0;
    for (int t = 0; t < d.theta_bins; ++t)
        for (int p = 0; p < d.phi_bins; ++p)
            sum += d.density[static_cast<std::size_t>(t * d.phi_bins + p)] *
                   d.projected_solid_angle(t);
    return sum;
}

TEST(NormalDistribution, IsNormalisedOnProjectedArea) {
    for (const std::string kind : {"flat", "thesis", "gaussian", "pyramids", "ggx"}) {
        const auto d = normal_distribution(make(settings_of(kind, 64)), 30, 24, 2);
        EXPECT_NEAR(total(d), 1, 1e-12);
    }
    // The cells cover the projected hemisphere, pi
    NormalDistribution d{9, 7, {}};
    double all = 0;
    for (int t = 0; t < 9; ++t) all += 7 * d.projected_solid_angle(t);
    EXPECT_NEAR(all, kPi, 1e-12);
}

// A 30 degree groove: half the area faces phi = 180 (rising towards +x), half phi = 0; both lie in
// the polar cell of 30 degrees.
TEST(NormalDistribution, OfAGrooveHasTwoNormals) {
    SurfaceSettings settings = settings_of("vgroove", 32);
    settings.tilt_deg = 30;
    const auto d = normal_distribution(make(settings), 18, 8, 2);  // 5 and 45 degrees
    for (int t = 0; t < 18; ++t)
        for (int p = 0; p < 8; ++p) {
            const double share =
                d.density[static_cast<std::size_t>(t * 8 + p)] * d.projected_solid_angle(t);
            // 30 degrees, up to rounding, is the edge of rows 5 and 6
            if (t == 5 || t == 6) continue;
            EXPECT_EQ(share, 0);
        }
    const auto share = [&](int p) {
        return d.density[static_cast<std::size_t>(5 * 8 + p)] * d.projected_solid_angle(5) +
               d.density[static_cast<std::size_t>(6 * 8 + p)] * d.projected_solid_angle(6);
    };
    EXPECT_NEAR(share(0), 0.5, 1e-12);
    EXPECT_NEAR(share(4), 0.5, 1e-12);
}

/// A plane that rises towards +x at 32 degrees, without its return.
Heightfield plane(bool along_y) {
    SurfaceSettings settings = settings_of("tilted", 16);
    settings.tilt_deg = 32;
    settings.boundary = Boundary::Finite;
    settings.along_y = along_y;
    return make(settings);
}

// The normal of a plane that rises towards +x leans towards -x: phi = 180 degrees; towards +y: 270.
TEST(NormalDistribution, OfAPlaneHasOneNormal) {
    for (const bool along_y : {false, true}) {
        const auto d = normal_distribution(plane(along_y), 18, 8, 2);  // 5 and 45 degrees
        for (int t = 0; t < 18; ++t)
            for (int p = 0; p < 8; ++p) {
                const bool here = t == 6 && p == (along_y ? 6 : 4);
                EXPECT_NEAR(
                    d.density[static_cast<std::size_t>(t * 8 + p)] * d.projected_solid_angle(t),
                    here ? 1.0 : 0.0, 1e-12)
                    << t << ' ' << p;
            }
    }
}

// Seen from -x at polar angle theta, a plane that rises towards +x by t offers cos(theta - t) times
// its area 1 / cos(t); from +x, cos(theta + t) / cos(t), and nothing beyond theta = 90 - t.
TEST(ProjectedArea, OfAPlane) {
    for (const bool along_y : {false, true}) {
        const Heightfield surface = plane(along_y);
        const double uphill = along_y ? kPi / 2 : 0, t = radians(32);
        for (const double theta : {0.0, 0.5, 1.0, 1.5}) {
            EXPECT_NEAR(projected_area(surface, from_spherical(theta, uphill + kPi), 2),
                        std::cos(theta - t) / std::cos(t), 1e-6);
            EXPECT_NEAR(projected_area(surface, from_spherical(theta, uphill), 2),
                        std::max(0.0, std::cos(theta + t) / std::cos(t)), 1e-6);
        }
    }
}

// D of Beckmann: exp(-tan^2 / alpha^2) / (pi alpha^2 cos^4). The share of projected area between
// two polar angles is exp(-tan^2 t1 / alpha^2) - exp(-tan^2 t2 / alpha^2).
TEST(NormalDistribution, OfAGaussianSurfaceIsBeckmann) {
    SurfaceSettings settings = settings_of("gaussian", 1024);
    settings.alpha_x = settings.alpha_y = 0.5;
    settings.correlation_x = settings.correlation_y = 4;
    const auto d = normal_distribution(make(settings), 18, 4, 2);
    const auto beyond = [](double theta_deg) {
        return std::exp(-std::pow(std::tan(radians(theta_deg)) / 0.5, 2));
    };
    for (int t = 0; t < 17; ++t) {
        double share = 0;
        for (int p = 0; p < 4; ++p)
            share += d.density[static_cast<std::size_t>(t * 4 + p)] * d.projected_solid_angle(t);
        EXPECT_NEAR(share, beyond(5 * t) - beyond(5 * t + 5), 0.004) << t;
    }
}

TEST(NormalDistribution, RefusesNoBins) {
    const Heightfield surface = testing::flat_grid(4, 4);
    EXPECT_THROW(normal_distribution(surface, 0, 4, 1), Error);
    EXPECT_THROW(normal_distribution(surface, 4, -1, 1), Error);
    EXPECT_THROW(normal_distribution(surface, 4, 5000, 1), Error);
}

TEST(ProjectedArea, OfAFlatSurfaceIsTheCosine) {
    const Heightfield surface = testing::flat_grid(8, 8);
    for (const double theta : {0.0, 0.4, 1.5, kPi / 2})
        EXPECT_NEAR(projected_area(surface, from_spherical(theta, 2.0), 2), std::cos(theta), 1e-15);
}

// A groove of tilt t seen from theta across it: the two slopes offer (cos(theta) +- tan t
// sin(theta)) / 2 each; beyond theta = 90 - t the far side turns away and the near one remains.
TEST(ProjectedArea, OfAGroove) {
    SurfaceSettings settings = settings_of("vgroove", 32);
    settings.tilt_deg = 30;
    const Heightfield surface = make(settings);
    const double t = std::tan(radians(30));
    EXPECT_NEAR(projected_area(surface, from_spherical(radians(50), 0), 2), std::cos(radians(50)),
                1e-6);
    const double theta = radians(75);
    EXPECT_NEAR(projected_area(surface, from_spherical(theta, kPi), 2),
                (std::cos(theta) + t * std::sin(theta)) / 2, 1e-6);
    // Along the groove no side turns away
    EXPECT_NEAR(projected_area(surface, from_spherical(theta, kPi / 2), 2), std::cos(theta), 1e-6);
}

TEST(ProjectedArea, IsNeverLessThanTheCosine) {
    for (const std::string kind : {"thesis", "gaussian", "ggx", "pyramids", "eggcrate"}) {
        const Heightfield surface = make(settings_of(kind, 64));
        for (const double theta_deg : {0.0, 30.0, 60.0, 80.0, 89.0})
            for (const double phi : {0.0, 1.0, 2.5, 5.0})
                EXPECT_GE(projected_area(surface, from_spherical(radians(theta_deg), phi), 2),
                          std::cos(radians(theta_deg)) - 1e-6);
    }
}

// Smith's Lambda of Beckmann at a = 1 / (alpha tan theta) = 0.5 is 0.199641, at 1 it is 0.025127
// (erfc closed form: (exp(-a^2) / (a sqrt pi) - erfc(a)) / 2).
TEST(ProjectedArea, OfAGaussianSurfaceIsSmiths) {
    SurfaceSettings settings = settings_of("gaussian", 1024);
    settings.alpha_x = settings.alpha_y = 0.5;
    settings.correlation_x = settings.correlation_y = 4;
    const Heightfield surface = make(settings);
    for (const auto& [a, lambda] : {std::pair{0.5, 0.199641}, std::pair{1.0, 0.025127}}) {
        const double theta = std::atan(1 / (0.5 * a));
        double mean = 0;  // over azimuths: facets on a mesh are a little anisotropic
        for (int p = 0; p < 8; ++p)
            mean += projected_area(surface, from_spherical(theta, p * kPi / 4 + 0.2), 2) / 8;
        EXPECT_NEAR(mean / std::cos(theta), 1 + lambda, 0.01 * (1 + lambda));
    }
}

TEST(ProjectedArea, SameBitsForAnyNumberOfThreads) {
    const Heightfield surface = make(settings_of("thesis", 97));
    const Vec3 w = from_spherical(1.1, 0.3);
    const double one = projected_area(surface, w, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(projected_area(surface, w, threads), one);
}

}  // namespace
}  // namespace asperity

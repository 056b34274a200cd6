// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/smith.h>
#include <asperity/core/directions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

constexpr SlopeFamily kBoth[] = {SlopeFamily::Ggx, SlopeFamily::Beckmann};

/// Lambda of an isotropic surface of alpha = 1 at a = 1 / (alpha tan theta).
double lambda_at(SlopeFamily distribution, double a) {
    return SmithSurface{distribution, 1, 1}.lambda(from_spherical(std::atan(1 / a), 0.7));
}

TEST(SmithTest, LambdaHasTheKnownValues) {
    // Heitz 2014 eq. 83 and 86, evaluated by hand; GGX at a = 1 is (sqrt(2) - 1) / 2.
    EXPECT_NEAR(lambda_at(SlopeFamily::Ggx, 1), (std::sqrt(2.0) - 1) / 2, 1e-15);
    EXPECT_NEAR(lambda_at(SlopeFamily::Ggx, 0.1), 4.524938, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Ggx, 0.25), 1.561553, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Ggx, 0.5), 0.618034, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Ggx, 1.6), 0.089624, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Beckmann, 0.1), 2.34911, 5e-6);
    EXPECT_NEAR(lambda_at(SlopeFamily::Beckmann, 0.25), 0.698177, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Beckmann, 0.5), 0.199641, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Beckmann, 1), 0.025127, 5e-7);
    EXPECT_NEAR(lambda_at(SlopeFamily::Beckmann, 1.6), 0.001804, 5e-7);
}

TEST(SmithTest, LambdaEnds) {
    for (const SlopeFamily d : kBoth) {
        const SmithSurface s{d, 0.3, 0.6};
        EXPECT_EQ(s.lambda({0, 0, 1}), 0);
        EXPECT_EQ(s.g1({1, 0, 0}), 0);
        EXPECT_TRUE(std::isfinite(s.lambda({1, 0, 1e-200})));
        // Stretching the surface along y is turning the light's slope: alpha_y there, alpha_x here.
        EXPECT_NEAR(s.lambda(from_spherical(1, 0.5 * kPi)),
                    (SmithSurface{d, 0.6, 0.6}.lambda(from_spherical(1, 0))), 1e-12);
    }
}

/// Midpoint rule over the hemisphere, fine enough for the densities below.
template <class F>
double over_hemisphere(F&& f) {
    constexpr int kRows = 2000, kColumns = 200;
    double sum = 0;
    for (int r = 0; r < kRows; ++r) {
        const double theta = (r + 0.5) * 0.5 * kPi / kRows;
        for (int c = 0; c < kColumns; ++c)
            sum += f(from_spherical(theta, (c + 0.5) * 2 * kPi / kColumns)) * std::sin(theta);
    }
    return sum * (0.5 * kPi / kRows) * (2 * kPi / kColumns);
}

TEST(SmithTest, FacetsProjectToTheWholePlane) {
    // Heitz 2014 eq. 6: the facets' projections onto the plane fill it.
    for (const SlopeFamily d : kBoth) {
        const SmithSurface s{d, 0.3, 0.6};
        EXPECT_NEAR(over_hemisphere([&](Vec3 m) { return s.normal_density(m) * m.z; }), 1, 1e-4);
    }
}

TEST(SmithTest, VisibleNormalsAreADensity) {
    // Heitz 2014 eq. 14: what a direction sees of the facets is its own projection of the plane.
    // This ties Lambda to D: neither can be wrong alone.
    for (const SlopeFamily d : kBoth)
        for (const double theta_deg : {0.0, 40.0, 75.0}) {
            const SmithSurface s{d, 0.4, 0.7};
            const Vec3 w = from_spherical(radians(theta_deg), 0.4);
            EXPECT_NEAR(over_hemisphere([&](Vec3 m) { return s.visible_normal_density(w, m); }), 1,
                        3e-4)
                << theta_deg;
        }
}

TEST(SmithTest, DensityOnTheNormalAxis) {
    // D = 1 / (pi alpha_x alpha_y) at wm = z for both.
    for (const SlopeFamily d : kBoth)
        EXPECT_NEAR((SmithSurface{d, 0.5, 0.25}.normal_density({0, 0, 1})), 8 / kPi, 1e-12);
    EXPECT_EQ((SmithSurface{SlopeFamily::Beckmann, 0.5, 0.5}.normal_density({1, 0, 0})), 0);
    // Slope 1 along x, alpha = 1: GGX 1 / (pi (1/2 + 1/2)^2); Beckmann exp(-1) / (pi / 4).
    const Vec3 m = {std::sqrt(0.5), 0, std::sqrt(0.5)};
    EXPECT_NEAR((SmithSurface{SlopeFamily::Ggx, 1, 1}.normal_density(m)), 1 / kPi, 1e-12);
    EXPECT_NEAR((SmithSurface{SlopeFamily::Beckmann, 1, 1}.normal_density(m)),
                4 * std::exp(-1.0) / kPi, 1e-12);
}

TEST(SmithTest, SampledNormalsStayInTheUpperHemisphere) {
    for (const SlopeFamily d : kBoth)
        for (const double theta_deg : {0.0, 45.0, 89.9}) {
            const SmithSurface s{d, 0.9, 0.2};
            const Vec3 w = from_spherical(radians(theta_deg), 1);
            for (const double u1 : {0.0, 1e-12, 0.5, 1 - 0x1p-53})
                for (const double u2 : {0.0, 0.5, 1 - 0x1p-53}) {
                    const Vec3 m = s.sample_visible_normal(w, u1, u2);
                    EXPECT_NEAR(length(m), 1, 1e-12);
                    EXPECT_GE(m.z, 0);
                    EXPECT_GE(dot(m, w), -1e-6);
                }
        }
}

TEST(SmithTest, InverseErf) {
    for (const double x : {-5.5, -3.0, -1.0, -0.01, 0.0, 1e-8, 0.3, 1.0, 2.5})
        EXPECT_NEAR(inverse_erf(std::erf(x)), x, 1e-13 * std::exp(x * x) + 1e-14);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/lattice.h>
#include <asperity/bsdf/models/student_t.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

constexpr double kGammas[] = {1.6, 1.75, 2, 2.5, 4, 12, 100, 1000};

/// Integral of D(wm) weight(wm) over the hemisphere, by the midpoint rule in tan(theta) = alpha t /
/// (1 - t), t in 0 .. 1, and phi: the tails are as well resolved as the peak.
template <class F>
double over_facets(const StudentTFacets& s, F&& weight) {
    constexpr int kRows = 4000, kColumns = 48;
    double sum = 0;
    for (int r = 0; r < kRows; ++r) {
        const double t = (r + 0.5) / kRows, tan = s.alpha_x * t / (1 - t);
        const double theta = std::atan(tan), cos = std::cos(theta);
        // d(cos theta) = sin cos^2 d(tan theta).
        const double step = std::sin(theta) * cos * cos * s.alpha_x / ((1 - t) * (1 - t)) / kRows;
        for (int c = 0; c < kColumns; ++c) {
            const Vec3 wm = from_spherical(theta, (c + 0.5) * 2 * kPi / kColumns);
            sum += s.normal_density(wm) * weight(wm) * step;
        }
    }
    return sum * 2 * kPi / kColumns;
}

TEST(StudentTTest, FacetsProjectToTheWholePlane) {
    // Heitz 2014 eq. 6. With gamma = 1.6 a share tan^-1.2 of the facets lies beyond a slope.
    for (const double gamma : kGammas)
        for (const double alpha_y : {0.3, 0.5}) {
            const StudentTFacets s(0.3, alpha_y, gamma);
            EXPECT_NEAR(over_facets(s, [](Vec3 m) { return m.z; }), 1, 2e-4) << gamma;
        }
}

TEST(StudentTTest, VisibleNormalsAreADensity) {
    // Heitz 2014 eq. 14: the masking follows from the normals and from nothing else. Lambda is in
    // closed form, the integral knows D alone. Tails of 1.6 fall as tan^-0.2: integrals to 75
    // degrees start with 1.75.
    for (const double gamma : kGammas)
        for (const double theta_deg : {1.0, 40.0, 75.0}) {
            if (gamma < 1.75) continue;
            const StudentTFacets s(0.4, 0.7, gamma);
            const Vec3 w = from_spherical(radians(theta_deg), 0.4);
            const double seen =
                over_facets(s, [&](Vec3 m) { return std::max(0.0, dot(w, m)); }) / w.z;
            const double tail = gamma < 2 ? 2e-2 : 1e-3;
            EXPECT_NEAR(s.g1(w) * seen, 1, tail) << gamma << " " << theta_deg;
        }
}

TEST(StudentTTest, GammaTwoIsGgx) {
    const StudentTFacets student(0.3, 0.6, 2);
    const SmithSurface ggx{SlopeFamily::Ggx, 0.3, 0.6};
    for (double theta_deg = 0; theta_deg < 90; theta_deg += 4.7)
        for (const double phi : {0.0, 0.9, 4.0}) {
            const Vec3 w = from_spherical(radians(theta_deg), phi);
            EXPECT_NEAR(student.normal_density(w), ggx.normal_density(w),
                        1e-12 * ggx.normal_density(w));
            EXPECT_NEAR(student.lambda(w), ggx.lambda(w), 1e-12 * (1 + ggx.lambda(w)));
        }
}

/// Largest differences from Beckmann's facets, of D relative to its peak and of G1.
std::pair<double, double> distance_from_beckmann(double gamma) {
    const StudentTFacets student(0.5, 0.5, gamma);
    const SmithSurface beckmann{SlopeFamily::Beckmann, 0.5, 0.5};
    double d = 0, g = 0;
    for (double theta_deg = 0; theta_deg < 90; theta_deg += 1) {
        const Vec3 w = from_spherical(radians(theta_deg), 0.3);
        d = std::max(d, std::abs(student.normal_density(w) - beckmann.normal_density(w)));
        g = std::max(g, std::abs(student.g1(w) - beckmann.g1(w)));
    }
    return {d * kPi * 0.25, g};
}

TEST(StudentTTest, LargeGammaTendsToBeckmann) {
    // (1 + r^2 / (gamma - 1))^-gamma = exp(-r^2) (1 + (r^4 / 2 - r^2) / gamma + ...): the distance
    // falls as 1 / gamma.
    const auto at_100 = distance_from_beckmann(100), at_1000 = distance_from_beckmann(1000);
    EXPECT_LT(at_1000.first, 1e-3);
    EXPECT_LT(at_1000.second, 1e-3);
    EXPECT_GT(at_1000.first, 0);
    EXPECT_NEAR(at_100.first / at_1000.first, 10, 0.5);
    EXPECT_NEAR(at_100.second / at_1000.second, 10, 0.5);
}

TEST(StudentTTest, LambdaByHand) {
    // gamma = 3, alpha = 1: P(s) = (3 / (4 sqrt 2)) (1 + s^2 / 2)^(-5/2), elementary integrals.
    // At mu = sqrt 2: moment = (1 / (2 sqrt 2)) 2^(-3/2) = 1/8; with s = sqrt(2) tan(phi) the tail
    // is 3/4 (2/3 - (sin - sin^3 / 3)) at 45 degrees = (4 - 5 / sqrt 2) / 8.
    const StudentTFacets s(1, 1, 3);
    const Vec3 w = from_spherical(std::atan(1 / std::sqrt(2.0)), 1.1);
    const double tail = (4 - 5 / std::sqrt(2.0)) / 8;
    EXPECT_NEAR(s.lambda(w), 1 / (8 * std::sqrt(2.0)) - tail, 1e-14);
}

TEST(StudentTTest, LambdaEnds) {
    for (const double gamma : kGammas) {
        const StudentTFacets s(0.3, 0.6, gamma);
        EXPECT_EQ(s.lambda({0, 0, 1}), 0);
        EXPECT_EQ(s.g1({1, 0, 0}), 0);
        EXPECT_TRUE(std::isfinite(s.lambda({1, 0, 1e-200})));
        EXPECT_EQ(s.normal_density({1, 0, 0}), 0);
        EXPECT_TRUE(std::isfinite(s.normal_density({1, 0, 1e-200})));
    }
}

TEST(StudentTTest, SampledNormalsStayInTheUpperHemisphere) {
    for (const double gamma : kGammas)
        for (const double theta_deg : {0.0, 45.0, 89.9}) {
            const StudentTFacets s(0.9, 0.2, gamma);
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

TEST(StudentTTest, SamplesHaveTheDensity) {
    // Significance 0.01 for all together, by Sidak.
    constexpr int kTests = 4;
    const double significance = 1 - std::pow(0.99, 1.0 / kTests);
    struct Case {
        const char* spec;
        double theta_deg;
    };
    for (const Case& c :
         {Case{"student-t:alpha=0.5,gamma=1.6", 30}, Case{"student-t:alpha=0.3,gamma=3", 0},
          Case{"student-t:alpha=0.4,alpha_y=0.7,gamma=3", 60},
          Case{"student-t:alpha=0.6,gamma=2", 80}, Case{"student-t:alpha=0.8,gamma=40", 75}}) {
        const auto brdf = parse_brdf_spec(c.spec);
        test::SamplerTest test;
        test.wi = from_spherical(radians(c.theta_deg), 0.7);
        test.rows = 31, test.columns = 40, test.samples = 40000;
        const test::SamplerReport report = test::test_sampler(*brdf, test);
        EXPECT_GT(report.p_value, significance) << c.spec;
        EXPECT_EQ(report.impossible, 0) << c.spec;
        EXPECT_NEAR(report.integral, 1 - report.none_share, 5e-3) << c.spec;
        // Weights are G2 / G1: between 0 and 1.
        EXPECT_LE(report.mean_weight, 1) << c.spec;
    }
}

TEST(StudentTTest, WhiteFurnace) {
    // All mirrors: what is missing is light that meets a second facet; never more than 1, and
    // nearly 1 on a smooth surface. At gamma = 2 the albedo of GGX (its published table, row 31,
    // 22).
    for (const double gamma : {1.6, 2.0, 3.0, 40.0})
        for (const double theta_deg : {0.0, 45.0, 80.0}) {
            for (const double alpha : {0.05, 0.5, 1.0}) {
                const StudentTBrdf brdf("", StudentTFacets(alpha, alpha, gamma),
                                        Masking::Correlated, {});
                double a = 0;
                albedo_by_sampling(brdf, from_spherical(radians(theta_deg), 0), kCoarseLattice,
                                   {&a, 1});
                EXPECT_LE(a, 1 + 1e-9) << gamma << " " << alpha << " " << theta_deg;
                EXPECT_GT(a, 0.05);
            }
        }
    // GGX's albedo along the normal for alpha = 1, an elementary integral.
    double a = 0;
    StudentTBrdf("", StudentTFacets(1, 1, 2), Masking::Correlated, {}).albedo({0, 0, 1}, {&a, 1});
    EXPECT_NEAR(a, 1 - std::log(2.0), 2e-4);
}

TEST(StudentTTest, GammaHasARange) {
    for (const double gamma : {1.5, 0.0, -3.0, 1001.0, std::nan("")})
        EXPECT_THROW(StudentTFacets(0.5, 0.5, gamma), Error) << gamma;
}

}  // namespace
}  // namespace asperity

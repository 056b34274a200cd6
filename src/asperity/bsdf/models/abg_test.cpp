// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/models/abg.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

double albedo_at_degrees(const Bsdf& brdf, double theta_deg) {
    double a = 0;
    brdf.albedo(from_spherical(radians(theta_deg), 0.3), {&a, 1});
    return a;
}

TEST(AbgTest, ValueByHand) {
    // Light at 30 degrees, looked at along the normal: |beta - beta0| = sin 30 = 1/2.
    const auto brdf = parse_brdf_spec("abg:a=0.01/0.02,b=0.25,g=2");
    std::vector<double> f(2);
    brdf->eval(from_spherical(radians(30), 1), {0, 0, 1}, f);
    EXPECT_NEAR(f[0], 0.02, 1e-15);
    EXPECT_NEAR(f[1], 0.04, 1e-15);
    // The mirror direction: A / B. One that goes back at 30 degrees: |beta - beta0| = 1.
    brdf->eval(from_spherical(radians(30), 1), from_spherical(radians(30), 1 + kPi), f);
    EXPECT_NEAR(f[0], 0.04, 1e-15);
    brdf->eval(from_spherical(radians(30), 1), from_spherical(radians(30), 1), f);
    EXPECT_NEAR(f[0], 0.008, 1e-15);
}

TEST(AbgTest, AlbedoAlongTheNormal) {
    // Integral of A / (B + r^g) over the unit disk: g = 2: pi A ln(1 + 1/B); g = 1: 2 pi A
    // (1 - B ln(1 + 1/B)); g = 0: pi A / (B + 1); 1.8 by quadrature.
    EXPECT_NEAR(albedo_at_degrees(AbgBrdf({{0.0025}, 0.001, 2}), 0), 0.0542612, 2e-5);
    EXPECT_NEAR(albedo_at_degrees(AbgBrdf({{0.0025}, 0.001, 1}), 0), 0.0155994, 5e-6);
    EXPECT_NEAR(albedo_at_degrees(AbgBrdf({{0.0025}, 0.001, 1.8}), 0), 0.0413437, 2e-5);
    EXPECT_NEAR(albedo_at_degrees(AbgBrdf({{0.5}, 1, 0}), 0), kPi / 4, 1e-6);
}

TEST(AbgTest, SamplesFollowTheDensity) {
    for (const AbgSettings& s : {AbgSettings{{0.01}, 0.01, 2}, AbgSettings{{0.01}, 0.1, 1.2},
                                 AbgSettings{{0.01}, 0.02, 3}})
        for (const double theta_deg : {0.0, 50.0, 80.0}) {
            const AbgBrdf brdf(s);
            test::SamplerTest test;
            test.wi = from_spherical(radians(theta_deg), 0.7);
            const test::SamplerReport report = test::test_sampler(brdf, test);
            EXPECT_GT(report.p_value, 1e-3) << brdf.name() << " " << theta_deg;
            EXPECT_EQ(report.impossible, 0);
            EXPECT_NEAR(report.integral + report.none_share, 1, 3e-3) << brdf.name();
        }
}

TEST(AbgTest, ReciprocalToRounding) {
    const AbgBrdf brdf({{0.3}, 1e-4, 2.3});
    for (int k = 0; k < 500; ++k) {
        const Vec3 wi = from_spherical(1.5 * std::fmod(k * 0.618, 1), k);
        const Vec3 wo = from_spherical(1.5 * std::fmod(k * 0.414, 1), 2.7 * k);
        double forth = 0, back = 0;
        brdf.eval(wi, wo, {&forth, 1});
        brdf.eval(wo, wi, {&back, 1});
        EXPECT_EQ(forth, back);
        brdf.eval(wi, {wo.x, wo.y, -wo.z}, {&back, 1});
        EXPECT_EQ(back, 0);
    }
}

TEST(AbgTest, RefusesWhatIsOutside) {
    const auto refused = [](const AbgSettings& settings) {
        try {
            const AbgBrdf brdf(settings);
        } catch (const Error& e) {
            return e.where();
        }
        return std::string();
    };
    EXPECT_EQ(refused({{}, 0.1, 2}), "a");
    EXPECT_EQ(refused({{0.1, -1}, 0.1, 2}), "a");
    EXPECT_EQ(refused({{0.1}, 0, 2}), "b");
    EXPECT_EQ(refused({{0.1}, 0.1, -1}), "g");
    EXPECT_EQ(refused({{0.1}, 0.1, 2}), "");
}

}  // namespace
}  // namespace asperity

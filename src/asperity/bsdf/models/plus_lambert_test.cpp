// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/models/plus_lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(PlusLambertTest, IsTheSum) {
    const auto both = parse_brdf_spec("ggx:alpha=0.3,f0=0.04/0.5/0.9,lambert=0.1/0.2/0.3");
    const auto facets = parse_brdf_spec("ggx:alpha=0.3,f0=0.04/0.5/0.9");
    std::vector<double> sum(3), f(3), a(3), b(3);
    const Vec3 wi = from_spherical(0.5, 0.2), wo = from_spherical(0.9, 3);
    both->eval(wi, wo, sum);
    facets->eval(wi, wo, f);
    both->albedo(wi, a);
    facets->albedo(wi, b);
    for (std::size_t c = 0; c < 3; ++c) {
        const double diffuse = 0.1 * static_cast<double>(c + 1);
        EXPECT_NEAR(sum[c], f[c] + diffuse / kPi, 1e-14);
        EXPECT_NEAR(a[c], b[c] + diffuse, 1e-14);
    }
    both->eval(wi, {wo.x, wo.y, -wo.z}, sum);
    EXPECT_EQ(sum, std::vector<double>(3, 0.0));
    EXPECT_TRUE(both->isotropic());
    EXPECT_EQ(both->normal_density({0, 0, 1}), facets->normal_density({0, 0, 1}));
}

TEST(PlusLambertTest, OneChannelCountsForAll) {
    const auto grey = parse_brdf_spec("beckmann:alpha=0.3,lambert=0.1/0.2");
    ASSERT_EQ(grey->channels(), 2);
    std::vector<double> f(2);
    grey->eval({0, 0, 1}, {0, 0, 1}, f);
    // D = 1 / (pi alpha^2) along the normal, no masking: f = D / 4 + albedo / pi.
    EXPECT_NEAR(f[0], 1 / (0.36 * kPi) + 0.1 / kPi, 1e-14);
    EXPECT_NEAR(f[1], 1 / (0.36 * kPi) + 0.2 / kPi, 1e-14);
    EXPECT_EQ(parse_brdf_spec("ggx:alpha=0.3,material=Au,lambert=0.1")->channels(), 3);
}

TEST(PlusLambertTest, NamesReadBackAsThemselves) {
    for (const char* spec : {"ggx:alpha=0.3,lambert=0.2", "beckmann:alpha=0.3,lambert=0.1/0.2/0.3",
                             "abg:a=0.01,b=0.001,g=2,lambert=0.05",
                             "student-t:alpha=0.3,gamma=3,fresnel=conductor,material=Au,lambert=0"})
        EXPECT_EQ(parse_brdf_spec(spec)->name(), spec);
    EXPECT_EQ(parse_brdf_spec("ggx:alpha=0.3,lambert=none")->name(), "ggx:alpha=0.3");
}

TEST(PlusLambertTest, SamplesFollowTheDensity) {
    for (const double theta_deg : {0.0, 60.0}) {
        const auto brdf = parse_brdf_spec("ggx:alpha=0.3,lambert=0.4");
        test::SamplerTest test;
        test.wi = from_spherical(radians(theta_deg), 0.7);
        const test::SamplerReport report = test::test_sampler(*brdf, test);
        EXPECT_GT(report.p_value, 1e-3) << theta_deg;
        EXPECT_EQ(report.impossible, 0);
        double albedo = 0;
        brdf->albedo(test.wi, {&albedo, 1});
        EXPECT_NEAR(report.mean_weight, albedo, 4 * report.mean_weight_error + 1e-3);
    }
}

TEST(PlusLambertTest, SaysWhatIsWrong) {
    const auto message = [](const char* spec) {
        try {
            parse_brdf_spec(spec);
        } catch (const Error& e) {
            return e.message();
        }
        return std::string();
    };
    EXPECT_EQ(message("ggx:alpha=0.3,lambert=1.5"), "lambert: '1.5' must be in 0 .. 1");
    EXPECT_EQ(message("ggx:alpha=0.3,material=Au,lambert=0.1/0.2"),
              "lambert: 2 values given, the model has 3 channels");
}

}  // namespace
}  // namespace asperity

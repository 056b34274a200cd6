// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/measured/analytic_measurement.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/half_vector_map.h>
#include <asperity/measured/hemisphere_weights.h>
#include <asperity/measured/tabulated.h>

#include <gtest/gtest.h>

#include <array>

namespace asperity {
namespace {

std::shared_ptr<const BakedBrdf> bake(const Bsdf& brdf, const BakeSettings& settings = {}) {
    Run run(2);
    return bake_brdf(brdf, run, settings);
}

std::shared_ptr<const BakedBrdf> bake(const std::string& spec, const BakeSettings& settings = {}) {
    return bake(*parse_brdf_spec(spec), settings);
}

/// Coarse tables for tests of what holds for any fineness; quick to make.
constexpr BakeSettings kCoarse = {8, 8, 24};

/// What two BRDFs send into the hemisphere from one incident direction, and how far apart they are.
struct Hemisphere {
    std::array<double, 3> first{}, second{};  ///< integrals of f cos(theta_o)
    double difference = 0;                    ///< integral of |f - f'| cos(theta_o), channel 0
    int unreachable = 0;                      ///< directions with f > 0 that are never drawn
};

Hemisphere integrate(const Bsdf& a, const Bsdf& b, Vec3 wi, int rows = 200) {
    const std::size_t channels = static_cast<std::size_t>(a.channels());
    std::array<double, 3> f{}, g{};
    Hemisphere sums;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < 2 * rows; ++column) {
            const double theta = (row + 0.5) * 0.5 * kPi / rows;
            const Vec3 wo = from_spherical(theta, (column + 0.5) * kPi / rows);
            const double share = wo.z * std::sin(theta) * 0.5 * kPi * kPi / rows / rows;
            a.eval(wi, wo, std::span(f).first(channels));
            b.eval(wi, wo, std::span(g).first(channels));
            for (std::size_t c = 0; c < channels; ++c) {
                sums.first[c] += f[c] * share;
                sums.second[c] += g[c] * share;
            }
            sums.difference += std::abs(f[0] - g[0]) * share;
            if (f[0] > 0 && !(a.pdf(wi, wo) > 0)) ++sums.unreachable;
        }
    }
    return sums;
}

TEST(HalfVectorMapTest, KnownPlaces) {
    // The normal lies in the middle. Along it, the projection shrinks areas to a quarter, the
    // stretch multiplies them by 1 / stretch^2, the mirror divides solid angles by 4.
    const HalfVectorMap map{0.5};
    const HalfVectorMap::Place middle = map.place({0, 0, 2});
    EXPECT_EQ(middle.x, 0);
    EXPECT_EQ(middle.y, 0);
    EXPECT_NEAR(middle.density, 0.25 * 4 * 0.25, 1e-15);
    // A slope of `stretch` is drawn out to 45 degrees: tan(45 / 2 degrees).
    const HalfVectorMap::Place half = map.place({0.5, 0, 1});
    EXPECT_NEAR(half.x, std::sqrt(2.0) - 1, 1e-15);
}

TEST(HalfVectorMapTest, ThereAndBack) {
    const HalfVectorMap map{0.2};
    const Vec3 wi = from_spherical(0.7, 0.3), wo = from_spherical(1.2, 2.5);
    const HalfVectorMap::Place place = map.place(wi + wo);
    const Vec3 h = map.half_vector(place.x, place.y);
    const Vec3 mirrored = reflect(wi, normalize(h));
    EXPECT_NEAR(length(mirrored - wo), 0, 1e-14);
    EXPECT_NEAR(map.density(place.x, place.y, h, wi), place.density, 1e-13 * place.density);
}

TEST(HemisphereWeightsTest, WhiteIsOne) {
    const HalfVectorMap map{0.4};
    constexpr int kSide = 96;
    const HemisphereWeights weights(map, kSide);
    for (const double theta_deg : {0.0, 40.0, 75.0}) {
        const Vec3 wi = from_spherical(radians(theta_deg), 0.7);
        const std::vector<double> all = weights.of(wi);
        double white = 0;
        for (std::size_t node = 0; node < all.size(); ++node) {
            const double x = static_cast<double>(node % kSide),
                         y = static_cast<double>(node / kSide);
            const Vec3 h =
                normalize(map.half_vector(2 * x / (kSide - 1) - 1, 2 * y / (kSide - 1) - 1));
            white += all[node] * (wi.z + reflect(wi, h).z) / kPi;
        }
        EXPECT_NEAR(white, 1, 1e-3) << theta_deg;
    }
}

struct BakedCase {
    const char* spec;
    double theta_deg;
};

class BakedSamplingTest : public testing::TestWithParam<BakedCase> {};

TEST_P(BakedSamplingTest, SamplesFollowTheirDensity) {
    const auto baked = bake(GetParam().spec, kCoarse);
    test::SamplerTest test;
    test.wi = from_spherical(radians(GetParam().theta_deg), 0.4);
    test.samples = 400000;
    test.steps = 6;  // the density has steps of its own
    test.rows = 45;
    test.columns = 60;
    const test::SamplerReport report = test::test_sampler(*baked, test);
    EXPECT_GT(report.p_value, 1e-3);
    EXPECT_EQ(report.impossible, 0);
    EXPECT_NEAR(report.integral, 1 - report.none_share, 2e-3);
    std::array<double, 3> albedo{};
    baked->albedo(test.wi, std::span(albedo).first(static_cast<std::size_t>(baked->channels())));
    EXPECT_NEAR(report.mean_weight, albedo[0], 4 * report.mean_weight_error + 0.02);
}

INSTANTIATE_TEST_SUITE_P(Models, BakedSamplingTest,
                         testing::Values(BakedCase{"lambert:albedo=0.7", 30},
                                         BakedCase{"ggx:alpha=0.5", 0},
                                         BakedCase{"ggx:alpha=0.2", 60},
                                         BakedCase{"ggx:alpha=0.8", 84},
                                         BakedCase{"cook-torrance:roughness=0.6,metallic=0", 70},
                                         BakedCase{"ggx:alpha=0.5,alpha_y=0.2", 50}));

class BakedAccuracyTest : public testing::TestWithParam<const char*> {};

TEST_P(BakedAccuracyTest, KeepsAlbedoAndLobe) {
    const auto original = parse_brdf_spec(GetParam());
    const auto baked = bake(*original);
    const std::size_t channels = static_cast<std::size_t>(baked->channels());
    std::array<double, 3> albedo{};
    for (const double theta_deg : {0.0, 7.0, 31.0, 63.0, 85.0}) {
        const Vec3 wi = from_spherical(radians(theta_deg), 1.0);
        original->albedo(wi, std::span(albedo).first(channels));
        const Hemisphere sums = integrate(*baked, *original, wi);
        for (std::size_t c = 0; c < channels; ++c)
            EXPECT_NEAR(sums.first[c], albedo[c], 1e-3) << theta_deg;
        EXPECT_LT(sums.difference, 0.005 * sums.second[0]) << theta_deg;
        EXPECT_EQ(sums.unreachable, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, BakedAccuracyTest,
                         testing::Values("lambert:albedo=0.9/0.5/0.1", "beckmann:alpha=1",
                                         "ggx:alpha=0.2,material=Au", "beckmann:alpha=0.15",
                                         "cook-torrance:roughness=0.5,metallic=0,albedo=0.6"));

TEST(BakedBrdfTest, NarrowLobesKeepTheirAlbedo) {
    // Too narrow for a grid over the hemisphere: E[f cos / pdf] instead, by a fine lattice.
    const auto original = parse_brdf_spec("beckmann:alpha=0.05");
    const auto baked = bake(*original);
    for (const double theta_deg : {0.0, 33.0, 60.0, 80.0, 85.0}) {
        const Vec3 wi = from_spherical(radians(theta_deg), 1.0);
        double integral = 0, albedo = 0;
        baked->Bsdf::albedo(wi, {&integral, 1});
        original->albedo(wi, {&albedo, 1});
        EXPECT_NEAR(integral, albedo, 2e-3) << theta_deg;
    }
}

TEST(BakedBrdfTest, AnisotropicLobesTurnWithTheSurface) {
    const auto original = parse_brdf_spec("ggx:alpha=0.6,alpha_y=0.2");
    const auto baked = bake(*original, {12, 12, 48});
    EXPECT_FALSE(baked->isotropic());
    for (const double phi_deg : {0.0, 20.0, 90.0, 200.0, 359.0}) {
        const Vec3 wi = from_spherical(radians(50), radians(phi_deg));
        const Hemisphere sums = integrate(*baked, *original, wi, 150);
        EXPECT_NEAR(sums.first[0], sums.second[0], 5e-3) << phi_deg;
        EXPECT_LT(sums.difference, 0.02 * sums.second[0]) << phi_deg;
    }
}

TEST(BakedBrdfTest, AMeasurementKeepsItsOwnAlbedo) {
    // A tabulated BRDF is off its own albedo by up to a percent between layers; baked, it is not.
    Experiment e;
    e.detector.resolution = 64;
    e.illumination.layers = 8;
    const auto table = make_tabulated_brdf(
        test::measurement_of(*parse_brdf_spec("ggx:alpha=0.4,f0=0.9/0.6/0.3"), e));
    const auto baked = bake(*table);
    std::array<double, 3> albedo{};
    for (const double theta_deg : {0.0, 11.0, 40.0, 71.0, 80.0}) {
        const Vec3 wi = from_spherical(radians(theta_deg), 0);
        table->albedo(wi, albedo);
        const Hemisphere sums = integrate(*baked, *table, wi, 150);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sums.first[c], albedo[c], 1e-3);
        EXPECT_LT(sums.difference, 0.03 * albedo[0]) << theta_deg;
    }
    EXPECT_EQ(baked->name(), table->name());
}

TEST(BakedBrdfTest, AMeasurementIsBakedAsItsTableIs) {
    // Its table goes without the factors that keep the albedo between layers: baking has its own.
    Experiment e;
    e.detector.resolution = 64;
    e.illumination.layers = 8;
    for (const char* spec : {"ggx:alpha=0.4,f0=0.9/0.6/0.3", "beckmann:alpha=0.1"}) {
        const Measurement m = test::measurement_of(*parse_brdf_spec(spec), e);
        const auto table = make_tabulated_brdf(m);
        asperity::Run run(2);
        const auto baked = bake_brdf(m, run);
        EXPECT_EQ(baked->name(), table->name());
        const std::size_t channels = static_cast<std::size_t>(table->channels());
        std::array<double, 3> albedo{};
        for (const double theta_deg : {0.0, 17.0, 40.0, 71.0}) {
            const Vec3 wi = from_spherical(radians(theta_deg), 0);
            table->albedo(wi, std::span(albedo).first(channels));
            const Hemisphere sums = integrate(*baked, *table, wi, 150);
            for (std::size_t c = 0; c < channels; ++c)
                EXPECT_NEAR(sums.first[c], albedo[c], 1e-3) << spec << " " << theta_deg;
            // No further from the table than what is baked from that
            const Hemisphere indirect = integrate(*bake(*table), *table, wi, 150);
            EXPECT_LT(sums.difference, indirect.difference + 1e-3) << spec << " " << theta_deg;
        }
    }
}

TEST(BakedBrdfTest, OneLookSaysTheSame) {
    const auto baked = bake("cook-torrance:roughness=0.4,metallic=1,albedo=0.9/0.6/0.2", kCoarse);
    const Vec3 wi = from_spherical(0.9, 2), wo = from_spherical(0.4, 5);
    std::array<double, 3> f{}, g{};
    baked->eval(wi, wo, f);
    EXPECT_EQ(baked->eval_pdf(wi, wo, g), baked->pdf(wi, wo));
    EXPECT_EQ(f, g);
    EXPECT_GT(f[0], f[2]);
    for (const Vec3 below : {Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
        EXPECT_EQ(baked->eval_pdf(wi, below, g), 0);
        EXPECT_EQ(g, (std::array<double, 3>{}));
        EXPECT_FALSE(baked->sample(below, 0.5, 0.5));
    }
}

TEST(BakedBrdfTest, SameBitsForAnyNumberOfThreads) {
    const auto original = parse_brdf_spec("ggx:alpha=0.3");
    asperity::Run one(1), three(3);
    const auto a = bake_brdf(*original, one, kCoarse), b = bake_brdf(*original, three, kCoarse);
    const CounterRandom random(5, 0);
    for (std::uint64_t k = 0; k < 2000; ++k) {
        const auto u = random.uniform2(k, 0), v = random.uniform2(k, 1);
        const Vec3 wi = from_spherical(std::acos(u[0]), 2 * kPi * u[1]);
        const auto s = a->sample(wi, v[0], v[1]), t = b->sample(wi, v[0], v[1]);
        ASSERT_EQ(s.has_value(), t.has_value());
        if (!s) continue;
        EXPECT_EQ(s->wo, t->wo);
        double f = 0, g = 0;
        EXPECT_EQ(a->eval_pdf(wi, s->wo, {&f, 1}), b->eval_pdf(wi, s->wo, {&g, 1}));
        EXPECT_EQ(f, g);
    }
}

TEST(BakedBrdfTest, BlackStaysBlack) {
    const auto black = bake("lambert:albedo=0", kCoarse);
    const Vec3 wi = from_spherical(0.5, 0);
    int drawn = 0;
    for (double u = 0.05; u < 1; u += 0.1) {
        const auto s = black->sample(wi, u, 0.5);
        if (!s) continue;
        ++drawn;
        double f = 1;
        EXPECT_GT(black->eval_pdf(wi, s->wo, {&f, 1}), 0);
        EXPECT_EQ(f, 0);
    }
    EXPECT_GT(drawn, 2);
}

TEST(BakedBrdfTest, RefusesWhatIsNoColour) {
    const LambertBrdf two({0.5, 0.5});
    asperity::Run run(1);
    try {
        bake_brdf(two, run);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "brdf");
        EXPECT_NE(error.message().find("2 channels"), std::string::npos);
    }
    const LambertBrdf grey({0.5});
    EXPECT_THROW(bake_brdf(grey, run, {7, 0, 0}), Error);
    EXPECT_THROW(bake_brdf(grey, run, {0, 0, 1000}), Error);
    run.request_stop();
    try {
        bake_brdf(grey, run);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Stopped);
    }
}

}  // namespace
}  // namespace asperity

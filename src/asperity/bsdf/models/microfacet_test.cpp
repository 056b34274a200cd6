// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

double albedo_at(const Bsdf& brdf, double mu) {
    double a = 0;
    brdf.albedo({std::sqrt(1 - mu * mu), 0, mu}, {&a, 1});
    return a;
}

std::unique_ptr<Bsdf> model(SlopeFamily distribution, double alpha,
                            Masking masking = Masking::Correlated) {
    MicrofacetSettings s;
    s.distribution = distribution;
    s.alpha_x = s.alpha_y = alpha;
    s.masking = masking;
    return std::make_unique<MicrofacetBrdf>(s);
}

TEST(MicrofacetTest, GgxAlbedoIsThePublishedTable) {
    // Blender Cycles, scene/shader.tables, table_ggx_E: row mu = j / 31, alpha = (i / 31)^2.
    struct Row {
        int i;
        double at_31, at_15, at_8;  // mu = 1, 15/31, 8/31
    };
    constexpr Row rows[] = {
        {31, .306853, .457779, .591195}, {27, .457373, .565860, .672105},
        {22, .684249, .698566, .760476}, {17, .876756, .819794, .823720},
        {14, .945407, .889415, .856078}, {10, .987261, .964995, .920251},
    };
    for (const Row& row : rows) {
        const auto brdf = model(SlopeFamily::Ggx, row.i * row.i / 961.0);
        EXPECT_NEAR(albedo_at(*brdf, 1), row.at_31, 3e-4) << row.i;
        EXPECT_NEAR(albedo_at(*brdf, 15.0 / 31), row.at_15, 3e-4) << row.i;
        EXPECT_NEAR(albedo_at(*brdf, 8.0 / 31), row.at_8, 3e-4) << row.i;
    }
}

TEST(MicrofacetTest, RoughestGgxAlongTheNormalIsOneMinusLogTwo) {
    // alpha = 1, wi = z: with t = tan^2(theta_m) the albedo is an elementary integral, 1 - ln 2.
    EXPECT_NEAR(albedo_at(*model(SlopeFamily::Ggx, 1), 1), 1 - std::log(2.0), 2e-4);
}

/// Twice the mean of the albedo times mu: hemispherical albedo, by the midpoint rule.
double average_albedo(const Bsdf& brdf) {
    constexpr int kSteps = 20;
    double sum = 0;
    for (int k = 0; k < kSteps; ++k) {
        const double mu = (k + 0.5) / kSteps;
        sum += 2 * mu * albedo_at(brdf, mu) / kSteps;
    }
    return sum;
}

TEST(MicrofacetTest, HemisphericalAlbedo) {
    // GGX: the same tables' E_avg. Beckmann: independent quadrature of the same integral.
    EXPECT_NEAR(average_albedo(*model(SlopeFamily::Ggx, 1)), .409137, 1e-3);
    EXPECT_NEAR(average_albedo(*model(SlopeFamily::Ggx, .5)), .7002, 1e-3);
    EXPECT_NEAR(average_albedo(*model(SlopeFamily::Beckmann, .5)), .8934, 1e-3);
    EXPECT_NEAR(average_albedo(*model(SlopeFamily::Beckmann, 1)), .6637, 1e-3);
}

TEST(MicrofacetTest, CorrelatedAndSeparableMasking) {
    // Single scattering of Smith-Beckmann by quadrature: alpha, theta, correlated, separable.
    constexpr double rows[][4] = {{.5, 60, .8694, .8689},
                                  {.5, 75, .9053, .9000},
                                  {.8, 60, .8183, .8143},
                                  {.8, 75, .8988, .8826},
                                  {.2, 75, .9141, .9140}};
    for (const auto& row : rows) {
        const double mu = std::cos(radians(row[1]));
        EXPECT_NEAR(albedo_at(*model(SlopeFamily::Beckmann, row[0]), mu), row[2], 4e-4);
        EXPECT_NEAR(albedo_at(*model(SlopeFamily::Beckmann, row[0], Masking::Separable), mu),
                    row[3], 4e-4);
    }
}

TEST(MicrofacetTest, RoughGold) {
    // alpha = 0.5, light along the normal, single scattering at 450, 550 and 650 nm.
    const auto gold = parse_brdf_spec("ggx:alpha=0.5,material=Au,wavelengths=450/550/650");
    std::vector<double> a(3);
    gold->albedo({0, 0, 1}, a);
    EXPECT_NEAR(a[0], .281, 1e-3);
    EXPECT_NEAR(a[1], .544, 1e-3);
    EXPECT_NEAR(a[2], .657, 1e-3);
}

/// Angle of the highest f in the plane of incidence [degrees, forward positive].
double peak_deg(const Bsdf& brdf, double theta_i_deg) {
    double best = -1, at = 0;
    for (double deg = 0; deg < 89.5; deg += 0.05) {
        double f = 0;
        brdf.eval(from_spherical(radians(theta_i_deg), 0), from_spherical(radians(deg), kPi),
                  {&f, 1});
        if (f > best) best = f, at = deg;
    }
    return at;
}

TEST(MicrofacetTest, OffSpecularPeak) {
    // Torrance and Sparrow's peak beyond the mirror angle; values by independent quadrature.
    EXPECT_NEAR(peak_deg(*model(SlopeFamily::Beckmann, .1), 45), 46.2, .15);
    EXPECT_NEAR(peak_deg(*model(SlopeFamily::Beckmann, .1), 60), 62.2, .15);
    EXPECT_NEAR(peak_deg(*model(SlopeFamily::Beckmann, .2), 45), 51.2, .15);
    EXPECT_NEAR(peak_deg(*model(SlopeFamily::Ggx, .1), 70), 71.7, .15);
    EXPECT_NEAR(peak_deg(*model(SlopeFamily::Ggx, .2), 60), 64.8, .15);
}

TEST(MicrofacetTest, ReciprocalToRounding) {
    const char* specs[] = {"ggx:alpha=0.05",
                           "ggx:alpha=0.6,alpha_y=0.1,masking=separable",
                           "beckmann:alpha=0.3,material=Cu",
                           "beckmann:alpha=0.9,ior=1.5",
                           "cook-torrance:roughness=0.3,metallic=0.5,albedo=0.9/0.5/0.1",
                           "cook-torrance:roughness=1,metallic=0,k=ibl",
                           "student-t:alpha=0.4,gamma=1.7",
                           "student-t:alpha=0.4,alpha_y=0.2,gamma=5,masking=separable,ior=1.5",
                           "lambert:albedo=0.3"};
    const CounterRandom random(7, 0);
    for (const char* spec : specs) {
        const auto brdf = parse_brdf_spec(spec);
        std::vector<double> forth(static_cast<std::size_t>(brdf->channels())), back(forth.size());
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const auto a = random.uniform2(i, 0), b = random.uniform2(i, 1);
            const Vec3 wi = from_spherical(0.5 * kPi * a[0], 2 * kPi * a[1]);
            const Vec3 wo = from_spherical(0.5 * kPi * b[0], 2 * kPi * b[1]);
            brdf->eval(wi, wo, forth);
            brdf->eval(wo, wi, back);
            for (std::size_t c = 0; c < forth.size(); ++c)
                EXPECT_NEAR(forth[c], back[c], 1e-12 * forth[c]) << spec;
        }
    }
}

TEST(MicrofacetTest, NothingAtOrBelowTheHorizon) {
    const auto brdf = model(SlopeFamily::Ggx, .3);
    const Vec3 up = from_spherical(0.5, 0), down = {0.6, 0, -0.8}, along = {1, 0, 0};
    double f = 1;
    for (const Vec3 w : {down, along}) {
        brdf->eval(up, w, {&f, 1});
        EXPECT_EQ(f, 0);
        brdf->eval(w, up, {&f, 1});
        EXPECT_EQ(f, 0);
        EXPECT_EQ(brdf->pdf(up, w), 0);
        EXPECT_EQ(brdf->pdf(w, up), 0);
        EXPECT_FALSE(brdf->sample(w, 0.5, 0.5));
        EXPECT_EQ(albedo_at(*brdf, -0.1), 0);
    }
}

TEST(MicrofacetTest, ValueByHand) {
    // GGX, alpha = 1/2, both directions along the normal: D = 4 / pi, no masking, f = D / 4.
    double f = 0;
    const Vec3 z = {0, 0, 1};
    model(SlopeFamily::Ggx, .5)->eval(z, z, {&f, 1});
    EXPECT_NEAR(f, 1 / kPi, 1e-14);
    // alpha = 1, mirror pair at 45 degrees: D = 1 / pi; Lambda = (sqrt 2 - 1) / 2 each, so
    // G = 1 / sqrt 2; 4 cos cos = 2: f = 1 / (2 sqrt 2 pi).
    model(SlopeFamily::Ggx, 1)
        ->eval(from_spherical(kPi / 4, 0), from_spherical(kPi / 4, kPi), {&f, 1});
    EXPECT_NEAR(f, 1 / (2 * std::sqrt(2.0) * kPi), 1e-14);
    // Separable: G = (1 / (1 + Lambda))^2 = 4 / (1 + sqrt 2)^2.
    model(SlopeFamily::Ggx, 1, Masking::Separable)
        ->eval(from_spherical(kPi / 4, 0), from_spherical(kPi / 4, kPi), {&f, 1});
    EXPECT_NEAR(f, 4 / std::pow(1 + std::sqrt(2.0), 2) / (2 * kPi), 1e-14);
}

}  // namespace
}  // namespace asperity

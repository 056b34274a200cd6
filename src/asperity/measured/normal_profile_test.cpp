// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/normal_profile.h>

#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/models/microfacet.h>
#include <asperity/bsdf/smith.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/normal_distribution.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

Heightfield rough() {
    SurfaceSettings settings;
    settings.size = 96;
    settings.roughness = 0.6;
    Run run(1);
    return make_surface(settings, run);
}

TEST(NormalProfileTest, IsTheNormalDistributionOfOneColumn) {
    const Heightfield surface = rough();
    const NormalDistribution d = normal_distribution(surface, 45, 1, 1);
    for (const int threads : {1, 3}) {
        const NormalProfile profile = normal_profile(surface, 45, asperity::Run(threads));
        ASSERT_EQ(profile.bins(), 45);
        for (std::size_t t = 0; t < 45; ++t)
            EXPECT_NEAR(profile.density[t], d.density[t], 1e-12 * d.density[t]);
    }
}

TEST(NormalProfileTest, OfALawIsItsDensity) {
    for (const SlopeFamily family : {SlopeFamily::Beckmann, SlopeFamily::Ggx})
        for (const double alpha : {0.1, 0.5, 1.0}) {
            const NormalProfile profile = normal_profile(family, alpha, 1800);
            const SmithSurface smith{family, alpha, alpha};
            double projected = 0;
            for (int t = 0; t < profile.bins(); ++t) {
                const double theta = profile.theta_centre(t);
                const double d = smith.normal_density(from_spherical(theta, 0));
                EXPECT_NEAR(profile.density[static_cast<std::size_t>(t)], d, 2e-3 * d + 1e-9)
                    << theta;
                const double s1 = std::sin(profile.theta_edge(t));
                const double s2 = std::sin(profile.theta_edge(t + 1));
                projected +=
                    profile.density[static_cast<std::size_t>(t)] * kPi * (s2 * s2 - s1 * s1);
            }
            EXPECT_NEAR(projected, 1, 1e-12);
        }
}

TEST(NormalProfileTest, OfAModelIsThatOfItsLaw) {
    const asperity::Run run(1);
    for (const SlopeFamily family : {SlopeFamily::Beckmann, SlopeFamily::Ggx})
        for (const double alpha : {1e-3, 0.1, 1.0}) {
            const NormalProfile law = normal_profile(family, alpha, 180);
            MicrofacetSettings settings;
            settings.distribution = family;
            settings.alpha_x = settings.alpha_y = alpha;
            const auto profile = normal_profile(MicrofacetBrdf(settings), 180, run);
            ASSERT_TRUE(profile);
            for (std::size_t t = 0; t < 180; ++t)
                EXPECT_NEAR(profile->density[t], law.density[t], 1e-3 * law.density[0])
                    << alpha << " " << t;
        }
    // Of an anisotropic one the mean over the azimuth: all normals are in it.
    MicrofacetSettings settings;
    settings.alpha_x = 0.2, settings.alpha_y = 0.6;
    const auto profile = normal_profile(MicrofacetBrdf(settings), 180, run);
    double projected = 0;
    for (int t = 0; t < 180; ++t) {
        const double s1 = std::sin(profile->theta_edge(t)),
                     s2 = std::sin(profile->theta_edge(t + 1));
        projected += profile->density[static_cast<std::size_t>(t)] * kPi * (s2 * s2 - s1 * s1);
    }
    EXPECT_NEAR(projected, 1, 1e-3);
    EXPECT_FALSE(normal_profile(LambertBrdf({1.0}), 180, run).has_value());
}

TEST(NormalProfileTest, StopsAndRefuses) {
    const Heightfield surface = rough();
    asperity::Run run(1);
    EXPECT_THROW(normal_profile(surface, 0, run), Error);
    EXPECT_THROW(normal_profile(SlopeFamily::Ggx, 0.5, 5000), Error);
    run.request_stop();
    try {
        normal_profile(surface, 10, run);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Stopped);
    }
}

}  // namespace
}  // namespace asperity

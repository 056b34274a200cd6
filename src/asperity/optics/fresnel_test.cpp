// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/materials.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <limits>

namespace asperity {
namespace {

TEST(FresnelTest, NormalIncidenceIsTheTextbookRatio) {
    // ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2); glass: (0.5 / 2.5)^2 = 0.04.
    EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
    EXPECT_NEAR(f0_from_indices(1, 1.5), 0.04, 1e-15);
    EXPECT_NEAR(f0_from_indices(1.5, 1), 0.04, 1e-15);
    // n = 2, k = 3: (1 + 9) / (9 + 9) = 5 / 9.
    EXPECT_NEAR(fresnel_conductor(1, 2, 3), 5.0 / 9, 1e-15);
    // n = 0.25, k = 3: (0.5625 + 9) / (1.5625 + 9).
    EXPECT_NEAR(fresnel_conductor(1, 0.25, 3), 9.5625 / 10.5625, 1e-15);
}

TEST(FresnelTest, GrazingLightIsReflectedWhole) {
    EXPECT_DOUBLE_EQ(fresnel_dielectric(0, 1.5), 1);
    EXPECT_DOUBLE_EQ(fresnel_dielectric(0, 0.6), 1);
    EXPECT_DOUBLE_EQ(fresnel_conductor(0, 0.2, 3.4), 1);
    EXPECT_DOUBLE_EQ(fresnel_conductor(0, 3, 3), 1);
    EXPECT_DOUBLE_EQ(fresnel_schlick(0, 0.04), 1);
}

TEST(FresnelTest, BrewsterAngleLeavesOnlyTheSPolarisedHalf) {
    // At tan(theta) = n the p part vanishes and theta_i + theta_t = 90 degrees, so the s amplitude
    // is -sin(theta_i - theta_t) = cos(2 theta_i) = (1 - n^2) / (1 + n^2).
    for (const double n : {1.1, 1.5, 2.4}) {
        const double rs = (1 - n * n) / (1 + n * n);
        EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(n)), n), 0.5 * rs * rs, 1e-15);
    }
    // By hand for n = 1.5: (1.25 / 3.25)^2 / 2 = 0.0739644970...
    EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(1.5)), 1.5), 0.07396449704142012, 1e-15);
}

TEST(FresnelTest, FortyFiveDegreesObeysRpEqualsRsSquared) {
    // At 45 degrees R_p = R_s^2 for every index, also complex ones (Born and Wolf).
    const std::complex<double> eta2 = std::pow(std::complex<double>(0.42, 2.47), 2);
    const std::complex<double> t = std::sqrt(eta2 - 0.5);
    const double c = std::sqrt(0.5), rs = std::norm((c - t) / (c + t));
    EXPECT_NEAR(fresnel_conductor(c, 0.42, 2.47), 0.5 * (rs + rs * rs), 1e-14);
}

TEST(FresnelTest, ConductorAgreesWithComplexArithmetic) {
    for (const double n : {0.05, 0.7, 1.0, 3.2})
        for (const double k : {1e-6, 0.3, 3.0, 8.0})
            for (double c = 0.01; c <= 1; c += 0.09) {
                const std::complex<double> eta2 = std::complex<double>(n, k) * std::complex(n, k);
                const std::complex<double> t = std::sqrt(eta2 - (1 - c * c));
                const double rs = std::norm((c - t) / (c + t));
                const double rp = std::norm((eta2 * c - t) / (eta2 * c + t));
                EXPECT_NEAR(fresnel_conductor(c, n, k), 0.5 * (rs + rp), 2e-9)
                    << n << " " << k << " " << c;
            }
}

TEST(FresnelTest, TotalInternalReflection) {
    // Glass to air, eta = 1/1.5: everything beyond sin(theta) = 1/1.5, theta = 41.81 degrees.
    EXPECT_DOUBLE_EQ(fresnel_dielectric(std::cos(radians(41.82)), 1 / 1.5), 1);
    EXPECT_LT(fresnel_dielectric(std::cos(radians(41.80)), 1 / 1.5), 0.95);
    EXPECT_DOUBLE_EQ(fresnel_dielectric(std::cos(radians(60)), 1 / 1.5), 1);
}

TEST(FresnelTest, ReflectanceIsTheSameFromBothSides) {
    // Stokes' reversibility: R(theta_i, n) = R(theta_t, 1/n) with sin(theta_t) = sin(theta_i) / n.
    for (double theta = 0; theta < 1.5; theta += 0.1) {
        const double theta_t = std::asin(std::sin(theta) / 1.7);
        EXPECT_NEAR(fresnel_dielectric(std::cos(theta), 1.7),
                    fresnel_dielectric(std::cos(theta_t), 1 / 1.7), 1e-13);
    }
}

TEST(FresnelTest, ConductorWithoutAbsorptionIsADielectric) {
    for (double c = 0; c <= 1; c += 0.05) {
        EXPECT_DOUBLE_EQ(fresnel_conductor(c, 1.5, 0), fresnel_dielectric(c, 1.5));
        EXPECT_NEAR(fresnel_conductor(c, 1.5, 1e-10), fresnel_dielectric(c, 1.5), 1e-9);
        EXPECT_EQ(fresnel_conductor(c, 1, 0), 0);
    }
}

TEST(FresnelTest, SchlickEnds) {
    EXPECT_DOUBLE_EQ(fresnel_schlick(1, 0.3), 0.3);
    EXPECT_DOUBLE_EQ(fresnel_schlick(0, 0.3), 1);
    // (1 - 1/2)^5 = 1/32.
    EXPECT_DOUBLE_EQ(fresnel_schlick(0.5, 0), 1.0 / 32);
    EXPECT_DOUBLE_EQ(fresnel_schlick(0.5, 1), 1);
}

TEST(FresnelTest, SchlickIsAsFarFromMetalsAsKnown) {
    // Largest difference between Schlick with the true F0 and the exact equations at 550 nm.
    const std::pair<const char*, double> known[] = {
        {"Al", 0.096}, {"Ag", 0.007}, {"Au", 0.010}, {"Cu", 0.039}, {"Cr", 0.198}};
    for (const auto& [name, expected] : known) {
        const ComplexIndex index = refractive_index(name, 550);
        const double f0 = fresnel_conductor(1, index.n, index.k);
        double worst = 0;
        for (double deg = 0; deg <= 90; deg += 0.05) {
            const double c = std::cos(radians(deg));
            worst = std::max(
                worst, std::abs(fresnel_schlick(c, f0) - fresnel_conductor(c, index.n, index.k)));
        }
        EXPECT_NEAR(worst, expected, 0.0006) << name;
    }
}

TEST(FresnelTest, DefaultIsAPerfectMirror) {
    const Fresnel fresnel;
    EXPECT_TRUE(fresnel.perfect());
    EXPECT_EQ(fresnel.channels(), 1);
    EXPECT_EQ(fresnel.channel_names(), std::vector<std::string>{"all"});
    double f = 0;
    fresnel.eval(0.3, {&f, 1});
    EXPECT_EQ(f, 1);
}

std::vector<double> evaluated(const OpticsSettings& settings, double cos_theta) {
    const Fresnel fresnel(settings);
    std::vector<double> f(static_cast<std::size_t>(fresnel.channels()));
    fresnel.eval(cos_theta, f);
    return f;
}

TEST(FresnelTest, ChannelsFollowTheSettings) {
    OpticsSettings s;
    s.fresnel = FresnelKind::Schlick;
    s.f0 = {0.9, 0.6, 0.2};
    EXPECT_EQ(Fresnel(s).channel_names(), (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(evaluated(s, 1), s.f0);

    s.f0.clear();
    s.ior = {1.5};  // thesis eq. 3.5 against air
    EXPECT_NEAR(evaluated(s, 1)[0], 0.04, 1e-15);
    EXPECT_NEAR(evaluated(s, 0.5)[0], 0.04 + 0.96 / 32, 1e-15);

    s.fresnel = FresnelKind::Dielectric;
    EXPECT_NEAR(evaluated(s, 0.5)[0], fresnel_dielectric(0.5, 1.5), 1e-15);

    s.fresnel = FresnelKind::Conductor;
    s.ior = {0.2};
    s.k = {3, 2};  // one index serves both channels
    const auto f = evaluated(s, 0.4);
    ASSERT_EQ(f.size(), 2u);
    EXPECT_DOUBLE_EQ(f[0], fresnel_conductor(0.4, 0.2, 3));
    EXPECT_DOUBLE_EQ(f[1], fresnel_conductor(0.4, 0.2, 2));
}

TEST(FresnelTest, MaterialBringsItsChannels) {
    OpticsSettings s;
    s.fresnel = FresnelKind::Conductor;
    s.material = "Au";
    EXPECT_EQ(Fresnel(s).channel_names(), (std::vector<std::string>{"R", "G", "B"}));
    const auto rgb = evaluated(s, 1);
    EXPECT_GT(rgb[0], rgb[1]);  // gold is red first
    EXPECT_GT(rgb[1], rgb[2]);

    s.wavelengths = {450};
    EXPECT_EQ(Fresnel(s).channel_names(), std::vector<std::string>{"450nm"});
    EXPECT_DOUBLE_EQ(evaluated(s, 0.7)[0], [] {
        const ComplexIndex index = refractive_index("Au", 450);
        return fresnel_conductor(0.7, index.n, index.k);
    }());
    s.wavelengths = {650, 550, 450};
    EXPECT_EQ(Fresnel(s).channel_names(), (std::vector<std::string>{"R", "G", "B"}));
    s.wavelengths = {400, 700};
    EXPECT_EQ(Fresnel(s).channel_names(), (std::vector<std::string>{"400nm", "700nm"}));
}

struct BadSetting {
    OpticsSettings settings;
    const char* where;
};

TEST(FresnelTest, ErrorsNameTheSetting) {
    using K = FresnelKind;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const BadSetting bad[] = {
        {{K::None, {0.5}, {}, {}, "", {}}, "f0"},
        {{K::None, {}, {}, {}, "Au", {}}, "material"},
        {{K::None, {}, {}, {}, "", {550}}, "wavelengths"},
        {{K::Schlick, {}, {}, {}, "", {}}, "f0"},
        {{K::Schlick, {0.5}, {1.5}, {}, "", {}}, "f0"},
        {{K::Schlick, {1.1}, {}, {}, "", {}}, "f0"},
        {{K::Schlick, {-0.1}, {}, {}, "", {}}, "f0"},
        {{K::Schlick, {nan}, {}, {}, "", {}}, "f0"},
        {{K::Schlick, {0.5}, {}, {1}, "", {}}, "k"},
        {{K::Schlick, std::vector<double>(65, 0.5), {}, {}, "", {}}, "f0"},
        {{K::Dielectric, {}, {}, {}, "", {}}, "ior"},
        {{K::Dielectric, {}, {0}, {}, "", {}}, "ior"},
        {{K::Dielectric, {}, {nan}, {}, "", {}}, "ior"},
        {{K::Dielectric, {0.1}, {1.5}, {}, "", {}}, "f0"},
        {{K::Conductor, {}, {0.2}, {}, "", {}}, "k"},
        {{K::Conductor, {}, {}, {3}, "", {}}, "ior"},
        {{K::Conductor, {}, {0.2, 0.3}, {3, 2, 1}, "", {}}, "k"},
        {{K::Conductor, {}, {0.2}, {-1}, "", {}}, "k"},
        {{K::Conductor, {}, {0.2}, {}, "Au", {}}, "ior"},
        {{K::Conductor, {}, {}, {}, "Unobtainium", {}}, "material"},
        {{K::Conductor, {}, {}, {}, "Au", {399}}, "wavelengths"},
        {{K::Conductor, {}, {}, {}, "Au", {nan}}, "wavelengths"},
        {{K::Conductor, {}, {}, {}, "Au", {500, 500}}, "wavelengths"},
        {{K::Conductor, {}, {0.2}, {3}, "", {500}}, "wavelengths"},
        {{static_cast<K>(17), {}, {}, {}, "", {}}, "fresnel"},
    };
    for (const BadSetting& b : bad) {
        try {
            const Fresnel fresnel(b.settings);
            ADD_FAILURE() << "accepted a bad " << b.where;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::Usage);
            EXPECT_EQ(e.where(), b.where) << e.what();
        }
    }
}

TEST(FresnelTest, ManyAnglesAtOnceMeanTheSame) {
    // 1003 angles: not a multiple of any number of lanes
    std::vector<float> cosines;
    for (int n = 0; n < 1003; ++n) cosines.push_back(static_cast<float>(n) / 1002);
    std::vector<OpticsSettings> all(5);
    all[1].fresnel = FresnelKind::Schlick;
    all[1].f0 = {0.04, 0.9};
    all[2].fresnel = FresnelKind::Dielectric;
    all[2].ior = {1.5, 1 / 1.5, 1};
    all[3].fresnel = FresnelKind::Conductor;
    all[3].material = "Au";
    all[4].fresnel = FresnelKind::Conductor;
    all[4].ior = {3, 0.05, 1.5};
    all[4].k = {1, 4, 0};
    for (const OpticsSettings& settings : all) {
        const Fresnel fresnel(settings);
        const auto channels = static_cast<std::size_t>(fresnel.channels());
        std::vector<std::vector<float>> many(channels, std::vector<float>(cosines.size()));
        std::vector<float*> out;
        for (std::vector<float>& f : many) out.push_back(f.data());
        fresnel.eval(cosines, out);
        std::vector<double> one(channels);
        for (std::size_t n = 0; n < cosines.size(); ++n) {
            fresnel.eval(double{cosines[n]}, one);
            // Near the critical angle of total reflection the cosine's own rounding counts most
            for (std::size_t c = 0; c < channels; ++c) {
                const bool total = settings.fresnel == FresnelKind::Dielectric && c == 1;
                EXPECT_NEAR(many[c][n], one[c], total ? 2e-5 : 2e-6) << cosines[n];
            }
        }
    }
}

TEST(FresnelTest, ManyAnglesOfAChannelMeanTheSame) {
    std::vector<double> cosines, many(1003);
    for (int n = 0; n < 1003; ++n) cosines.push_back(n / 1002.0);
    std::vector<OpticsSettings> all(3);
    all[1].fresnel = FresnelKind::Schlick;
    all[1].f0 = {0.04, 0.9};
    all[2].fresnel = FresnelKind::Conductor;
    all[2].ior = {3, 0.05, 1.5};  // k above n, below, and none
    all[2].k = {1, 4, 0};
    for (const OpticsSettings& settings : all) {
        const Fresnel fresnel(settings);
        std::vector<double> one(static_cast<std::size_t>(fresnel.channels()));
        for (std::size_t c = 0; c < one.size(); ++c) {
            fresnel.eval(static_cast<int>(c), cosines, many.data());
            for (std::size_t n = 0; n < cosines.size(); ++n) {
                fresnel.eval(cosines[n], one);
                ASSERT_NEAR(many[n], one[c], 1e-14) << cosines[n];
            }
        }
    }
}

}  // namespace
}  // namespace asperity

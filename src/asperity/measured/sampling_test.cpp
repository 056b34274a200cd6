// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/measured/compare.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

struct SampledBrdf {
    const char* spec;
    double theta_deg, phi_deg;
};

// Smooth and rough, isotropic and not, along the normal, oblique and grazing.
constexpr SampledBrdf kCases[] = {
    {"lambert:albedo=0.7", 30, 10},
    {"cook-torrance:roughness=0.5,metallic=1", 40, 200},
    {"cook-torrance:roughness=0.7,metallic=0,albedo=0.8,k=ibl", 70, 0},
    {"ggx:alpha=0.5", 0, 0},
    {"ggx:alpha=0.2", 60, 75},
    {"ggx:alpha=0.8", 84, 0},
    {"ggx:alpha=0.5,alpha_y=0.15", 50, 33},
    {"ggx:alpha=0.3,masking=separable,f0=0.04", 45, 180},
    {"beckmann:alpha=0.5", 0, 0},
    {"beckmann:alpha=0.2", 60, 300},
    {"beckmann:alpha=0.8", 84, 0},
    {"beckmann:alpha=0.15,alpha_y=0.6", 50, 120},
};
// Sidak: all cases together fail by chance once in a hundred.
const double kSignificance = 1 - std::pow(1 - 0.01, 1.0 / std::size(kCases));

class SamplingTest : public testing::TestWithParam<SampledBrdf> {};

TEST_P(SamplingTest, SamplesFollowTheirDensity) {
    const auto brdf = parse_brdf_spec(GetParam().spec);
    const double theta = radians(GetParam().theta_deg), phi = radians(GetParam().phi_deg);
    test::SamplerTest test;
    test.wi = from_spherical(theta, phi);
    const test::SamplerReport report = test::test_sampler(*brdf, test);
    EXPECT_GT(report.p_value, kSignificance);
    EXPECT_EQ(report.impossible, 0);
    // The density misses 1 by the share of samples mirrored below the horizon.
    EXPECT_NEAR(report.integral, 1 - report.none_share, 1e-3);

    // E[f cos / pdf] against the albedo integrated on other grounds: cell by cell.
    const Detector detector({DetectorKind::LatLong, 64, 1});
    const double albedo = average_over_cells(*brdf, detector, theta, phi, false, 2).albedo[0];
    EXPECT_NEAR(report.mean_weight, albedo, 4 * report.mean_weight_error + 5e-5);
    std::vector<double> a(static_cast<std::size_t>(brdf->channels()));
    brdf->albedo(test.wi, a);
    EXPECT_NEAR(a[0], albedo, 1e-3 * albedo);
}

INSTANTIATE_TEST_SUITE_P(Models, SamplingTest, testing::ValuesIn(kCases));

/// Lambert with a sampler that forgets the square root, or a little of it.
class Forgetful final : public Bsdf {
  public:
    explicit Forgetful(double slip) : slip_(slip) {}
    int channels() const override { return 1; }
    std::string name() const override { return "forgetful"; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override { lambert_.eval(wi, wo, f); }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return lambert_.sample(wi, std::pow(u1, 1 + slip_), u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return lambert_.pdf(wi, wo); }

  private:
    double slip_;
    LambertBrdf lambert_{{1.0}};
};

TEST(ChiSquareTest, CatchesAWrongSampler) {
    test::SamplerTest test;
    test.wi = {0, 0, 1};
    EXPECT_LT(test::test_sampler(Forgetful(1), test).p_value, 1e-9);
    EXPECT_LT(test::test_sampler(Forgetful(0.04), test).p_value, 1e-4);
}

TEST(ChiSquareTest, TailIsTheTabulatedOne) {
    // Upper 5 % and 1 % points of the distribution as printed in tables.
    EXPECT_NEAR(test::chi_square_tail(18.307, 10), 0.05, 5e-4);
    EXPECT_NEAR(test::chi_square_tail(124.342, 100), 0.05, 1e-4);
    EXPECT_NEAR(test::chi_square_tail(135.807, 100), 0.01, 1e-4);
}

}  // namespace
}  // namespace asperity

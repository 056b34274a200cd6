// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/render/material.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace asperity {
namespace {

std::shared_ptr<const Bsdf> brdf_of(const std::string& spec) {
    return parse_brdf_spec(spec);
}

/// A Material as a Bsdf, its red channel: what samplers are tested with.
class MaterialAsBrdf final : public Bsdf {
  public:
    explicit MaterialAsBrdf(Material material) : material_(std::move(material)) {}
    int channels() const override { return 1; }
    std::string name() const override { return material_.name(); }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        f[0] = material_.eval(wi, wo).r;
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        const auto drawn = material_.sample(wi, u1, u2);
        if (!drawn) return std::nullopt;
        return BsdfSample{drawn->light, drawn->pdf};
    }
    double pdf(Vec3 wi, Vec3 wo) const override {
        double density = 0;
        material_.eval_pdf(wi, wo, density);
        return density;
    }

  private:
    Material material_;
};

TEST(Material, IsTheThesisSum) {
    // Eq. 4.1: albedo / pi + factor * f
    const auto ggx = brdf_of("ggx:alpha=0.4");
    const Material material(ggx, {.normalize_factor = 2.5, .albedo = {0.3, 0.2, 0.1}});
    const Vec3 view = from_spherical(0.5, 0.3), light = from_spherical(0.9, 3.0);
    double f = 0;
    ggx->eval(view, light, {&f, 1});
    const Rgb sum = material.eval(view, light);
    EXPECT_DOUBLE_EQ(sum.r, 0.3 / kPi + 2.5 * f);
    EXPECT_DOUBLE_EQ(sum.g, 0.2 / kPi + 2.5 * f);
    EXPECT_DOUBLE_EQ(sum.b, 0.1 / kPi + 2.5 * f);
    double pdf = 0;
    EXPECT_EQ(material.eval_pdf(view, light, pdf), sum);
    EXPECT_EQ(material.eval(view, {0, 0, -1}), Rgb{});
    EXPECT_EQ(material.eval({0, 0, -1}, light), Rgb{});
    EXPECT_EQ(material.eval_pdf(view, {1, 0, 0}, pdf), Rgb{});
    EXPECT_EQ(pdf, 0);
}

TEST(Material, TakesViewForWi) {
    // f tells which way round it is asked: it is that of a table, exact for its wi alone
    class OneWay final : public Bsdf {
        int channels() const override { return 1; }
        std::string name() const override { return "one-way"; }
        void eval(Vec3 wi, Vec3, std::span<double> f) const override { f[0] = wi.z; }
        std::optional<BsdfSample> sample(Vec3, double u1, double u2) const override {
            const Vec3 wo = sample_cosine(u1, u2);
            return BsdfSample{wo, wo.z / kPi};
        }
        double pdf(Vec3, Vec3 wo) const override { return wo.z / kPi; }
    };
    const Material material(std::make_shared<OneWay>());
    const Vec3 view = from_spherical(0.2, 0), light = from_spherical(1.2, 1);
    EXPECT_DOUBLE_EQ(material.eval(view, light).g, view.z);
    EXPECT_NEAR(material.albedo(view).g, kPi * view.z, 1e-3);
}

TEST(Material, KeepsColours) {
    const Material material(brdf_of("lambert:albedo=0.9/0.5/0.1"));
    const Rgb f = material.eval({0, 0, 1}, {0, 0, 1});
    EXPECT_DOUBLE_EQ(f.r, 0.9 / kPi);
    EXPECT_DOUBLE_EQ(f.b, 0.1 / kPi);
    EXPECT_DOUBLE_EQ(material.albedo({0, 0, 1}).g, 0.5);
}

TEST(Material, SamplesWhatItsDensitySays) {
    for (const double theta_deg : {10.0, 70.0}) {
        const Material material(brdf_of("ggx:alpha=0.3"),
                                {.normalize_factor = 0.7, .albedo = {0.5, 0.5, 0.5}});
        const Vec3 view = from_spherical(radians(theta_deg), 0.4);
        const auto report = test::test_sampler(MaterialAsBrdf(material), {.wi = view});
        EXPECT_GT(report.p_value, 0.01) << theta_deg;
        EXPECT_EQ(report.impossible, 0);
        EXPECT_NEAR(report.mean_weight, material.albedo(view).r, 4 * report.mean_weight_error);
    }
}

TEST(Material, DrawsOnlyFromWhatReflects) {
    // Nothing but the diffuse term: every sample weighs its albedo
    const Material diffuse(brdf_of("ggx:alpha=0.3"),
                           {.normalize_factor = 0, .albedo = {0.5, 0.5, 0.5}});
    const auto drawn = diffuse.sample(from_spherical(0.3, 0), 0.999, 0.2);
    ASSERT_TRUE(drawn);
    EXPECT_DOUBLE_EQ(drawn->f.r * drawn->light.z / drawn->pdf, 0.5);
    EXPECT_FALSE(diffuse.sample({0, 0, -1}, 0.5, 0.5));
}

TEST(Material, NamesWhatIsNotAsByDefault) {
    const auto ggx = brdf_of("ggx:alpha=0.25");
    EXPECT_EQ(Material(ggx).name(), ggx->name());
    EXPECT_EQ(Material(ggx, {.normalize_factor = 2, .albedo = {0.5, 0.25, 0}}).name(),
              ggx->name() + ", normalize factor 2, albedo 0.5/0.25/0");
}

std::string complaint(const std::shared_ptr<const Bsdf>& brdf, const MaterialSettings& settings) {
    try {
        const Material material(brdf, settings);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.where();
    }
    return {};
}

TEST(Material, RefusesWhatHasNoColour) {
    const auto two = std::make_shared<LambertBrdf>(std::vector<double>{0.5, 0.5});
    EXPECT_EQ(complaint(two, {}), "brdf");
    EXPECT_EQ(complaint(nullptr, {}), "brdf");
    const auto grey = brdf_of("lambert:albedo=0.5");
    EXPECT_EQ(complaint(grey, {.normalize_factor = -1}), "normalize-factor");
    EXPECT_EQ(complaint(grey, {.normalize_factor = std::numeric_limits<double>::infinity()}),
              "normalize-factor");
    EXPECT_EQ(complaint(grey, {.albedo = {0, 1.01, 0}}), "albedo");
    EXPECT_EQ(complaint(grey, {.normalize_factor = 0}), "");
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// A model of your own: a class and a row. From then on it is read, listed and compared like any
// other.
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/measured/compare.h>
#include <asperity/params/fields.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

struct PhongSettings {
    double exponent = 20;
    double strength = 1;
};

/// Lafortune and Willems' energy-conserving Phong: f = strength (n + 2) / (2 pi) cos^n(a), a being
/// the angle between wo and the mirror direction of wi.
class PhongBrdf final : public asperity::Bsdf {
  public:
    explicit PhongBrdf(const PhongSettings& settings) : s_(settings) {}

    int channels() const override { return 1; }
    std::string name() const override { return "phong"; }
    bool isotropic() const override { return true; }
    void eval(asperity::Vec3 wi, asperity::Vec3 wo, std::span<double> f) const override {
        const double cos_a = std::max(0.0, dot(wo, asperity::Vec3{-wi.x, -wi.y, wi.z}));
        const bool above = wi.z > 0 && wo.z > 0;
        f[0] = above ? s_.strength * (s_.exponent + 2) / (2 * asperity::kPi) *
                           std::pow(cos_a, s_.exponent)
                     : 0;
    }
    // Directions by the cosine: right for every model, if noisy for a sharp one.
    std::optional<asperity::BsdfSample> sample(asperity::Vec3 wi, double u1,
                                               double u2) const override {
        if (wi.z <= 0) return std::nullopt;
        const asperity::Vec3 wo = asperity::sample_cosine(u1, u2);
        return asperity::BsdfSample{wo, wo.z / asperity::kPi};
    }
    double pdf(asperity::Vec3 wi, asperity::Vec3 wo) const override {
        return wi.z > 0 && wo.z > 0 ? wo.z / asperity::kPi : 0;
    }

  private:
    PhongSettings s_;
};

asperity::BsdfModel phong_model() {
    using S = PhongSettings;
    return asperity::bsdf_model<S>(
        "phong", "Phong", "a lobe about the mirror direction",
        {asperity::field(
             &S::exponent,
             {.name = "exponent", .range = {0, 1e4}, .doc = "the larger, the narrower the lobe"}),
         asperity::field(&S::strength, {.name = "strength",
                                        .range = asperity::kZeroToOne,
                                        .doc = "albedo for light along the normal"})},
        [](const S& s) { return std::make_unique<PhongBrdf>(s); });
}

}  // namespace

int main() {
    asperity::add_bsdf_model(phong_model());
    const auto phong = asperity::parse_brdf_spec("phong:exponent=40,strength=0.9");

    asperity::Experiment experiment;
    experiment.illumination.theta_deg = {0, 45};
    const auto ggx = asperity::parse_brdf_spec("ggx:alpha=0.3");
    const auto apart = asperity::compare(*phong, *ggx, experiment, 1);
    std::printf("phong: albedo %.3f along the normal; L1 from ggx at 45 degrees: %.2f\n",
                apart.layers[0].albedo_a, apart.layers[1].l1);
}

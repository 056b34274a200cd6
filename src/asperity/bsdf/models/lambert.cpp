// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

namespace asperity {

LambertBrdf::LambertBrdf(std::vector<double> albedo) : albedo_(std::move(albedo)) {
    if (albedo_.empty() || albedo_.size() > static_cast<std::size_t>(kMaxBsdfChannels))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} values given, between 1 and {} are taken", albedo_.size(),
                                kMaxBsdfChannels),
                    "albedo");
    for (const double a : albedo_)
        if (!(a >= 0 && a <= 1))
            throw Error(ErrorCode::Usage, fmt::format("{} is not within 0 .. 1", a), "albedo");
}

std::string LambertBrdf::name() const {
    return fmt::format("lambert:albedo={}", fmt::join(albedo_, "/"));
}

void LambertBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    const bool above = wi.z > 0 && wo.z > 0;
    for (std::size_t c = 0; c < f.size(); ++c) f[c] = above ? albedo_[c] / kPi : 0.0;
}

std::optional<BsdfSample> LambertBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    const Vec3 wo = sample_cosine(u1, u2);
    return BsdfSample{wo, wo.z / kPi};
}

double LambertBrdf::pdf(Vec3 wi, Vec3 wo) const {
    return wi.z > 0 && wo.z > 0 ? wo.z / kPi : 0.0;
}

void LambertBrdf::albedo(Vec3 wi, std::span<double> a) const {
    for (std::size_t c = 0; c < a.size(); ++c) a[c] = wi.z > 0 ? albedo_[c] : 0.0;
}

Vec3 sample_cosine(double u1, double u2) {
    // The projection onto the plane is a uniform disk; 1 - u1 > 0 keeps z above zero.
    const double r = std::sqrt(u1), phi = 2 * kPi * u2;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u1)};
}

namespace {

struct LambertSettings {
    std::vector<double> albedo = {1.0};
};

}  // namespace

BsdfModel lambert_model() {
    using S = LambertSettings;
    return bsdf_model<S>("lambert", "Lambert", "a perfectly diffuse surface: f = albedo / pi",
                         {field(&S::albedo, {.name = "albedo",
                                             .metavar = "X[/Y/Z]",
                                             .range = kZeroToOne,
                                             .doc = "share of the light that is reflected, one "
                                                    "value or one per channel"})},
                         [](const S& s) { return std::make_unique<LambertBrdf>(s.albedo); });
}

}  // namespace asperity

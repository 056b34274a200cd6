// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/abg.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr Range kScales = {1e-12, 1e6};  ///< of A and B
constexpr Range kExponents = {0, 10};
constexpr double kSmallestRadius = 1e-6;  ///< of a ring
constexpr std::size_t kRings = 400;

void require(const Range& range, const char* name, double value) {
    if (!range.contains(value))
        throw Error(ErrorCode::Usage, fmt::format("{} is not within {}", value, range.text()),
                    name);
}

/// |beta - beta0|: the mirror direction of wi lies at -wi along the surface.
double off_specular(Vec3 wi, Vec3 wo) {
    return std::hypot(wi.x + wo.x, wi.y + wo.y);
}

/// The farthest from beta0 that the unit disk reaches.
double reach(Vec3 wi) {
    return 1 + std::min(1.0, std::hypot(wi.x, wi.y));
}

}  // namespace

AbgBrdf::AbgBrdf(AbgSettings settings) : settings_(std::move(settings)) {
    if (settings_.a.empty() || settings_.a.size() > static_cast<std::size_t>(kMaxBsdfChannels))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} values given, between 1 and {} are taken", settings_.a.size(),
                                kMaxBsdfChannels),
                    "a");
    for (const double a : settings_.a) require(kScales, "a", a);
    require(kScales, "b", settings_.b);
    require(kExponents, "g", settings_.g);
    radii_.push_back(0);
    sums_.push_back(0);
    for (std::size_t k = 0; k < kRings; ++k) {
        const double place = static_cast<double>(k) / (kRings - 1);
        radii_.push_back(kSmallestRadius * std::pow(2 / kSmallestRadius, place));
        const double inner = radii_[k], outer = radii_[k + 1];
        densities_.push_back(1 / (settings_.b + std::pow(0.5 * (inner + outer), settings_.g)));
        sums_.push_back(sums_[k] + densities_[k] * kPi * (outer * outer - inner * inner));
    }
}

std::string AbgBrdf::name() const {
    return fmt::format("abg:a={},b={},g={}", fmt::join(settings_.a, "/"), settings_.b, settings_.g);
}

void AbgBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    const bool above = wi.z > 0 && wo.z > 0;
    const double lobe =
        above ? 1 / (settings_.b + std::pow(off_specular(wi, wo), settings_.g)) : 0.0;
    for (std::size_t c = 0; c < f.size(); ++c) f[c] = settings_.a[c] * lobe;
}

double AbgBrdf::below(double radius) const {
    const auto ring = static_cast<std::size_t>(
        std::upper_bound(radii_.begin(), radii_.end() - 1, radius) - radii_.begin() - 1);
    const std::size_t k = std::min(ring, kRings - 1);
    return sums_[k] + densities_[k] * kPi * (radius * radius - radii_[k] * radii_[k]);
}

std::optional<BsdfSample> AbgBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    const double mass = u1 * below(reach(wi));
    const auto above = std::upper_bound(sums_.begin(), sums_.end() - 1, mass);
    const auto k = std::min(static_cast<std::size_t>(above - sums_.begin() - 1), kRings - 1);
    const double radius =
        std::sqrt(radii_[k] * radii_[k] + (mass - sums_[k]) / (kPi * densities_[k]));
    const double phi = 2 * kPi * u2;
    const double x = radius * std::cos(phi) - wi.x, y = radius * std::sin(phi) - wi.y;
    const double z2 = 1 - x * x - y * y;
    if (!(z2 > 0)) return std::nullopt;
    const Vec3 wo = {x, y, std::sqrt(z2)};
    return BsdfSample{wo, pdf(wi, wo)};
}

double AbgBrdf::pdf(Vec3 wi, Vec3 wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    const double radius = off_specular(wi, wo), farthest = reach(wi);
    if (radius > farthest) return 0;
    const auto ring = static_cast<std::size_t>(
        std::upper_bound(radii_.begin(), radii_.end() - 1, radius) - radii_.begin() - 1);
    // d(beta) = cos(theta) d(omega).
    return densities_[std::min(ring, kRings - 1)] * wo.z / below(farthest);
}

BsdfModel abg_model() {
    using S = AbgSettings;
    return bsdf_model<S>(
        "abg", "ABg", "polished surfaces, A / (B + |beta - beta0|^g): no facets, no Fresnel factor",
        {field(&S::a, {.name = "a",
                       .label = "A",
                       .metavar = "X[/Y/Z]",
                       .unit = "1/sr",
                       .range = kScales,
                       .doc = "A, one value or one per channel; A / B is f along the mirror "
                              "direction"}),
         field(&S::b, {.name = "b",
                       .label = "B",
                       .range = kScales,
                       .doc = "B; the lobe bends at B^(1/g), a sine of an angle"}),
         field(&S::g, {.name = "g",
                       .label = "g",
                       .range = kExponents,
                       .doc = "g, the slope beyond that, in a plot of logarithms"})},
        [](const S& s) { return std::make_unique<AbgBrdf>(s); }, {"a", "b", "g"});
}

}  // namespace asperity

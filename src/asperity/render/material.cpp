// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/material.h>

#include <fmt/format.h>

#include <array>
#include <utility>

namespace asperity {

namespace {

/// Room for the channels of a Bsdf, and their colour.
class Channels {
  public:
    explicit Channels(const Bsdf& brdf) : count_(static_cast<std::size_t>(brdf.channels())) {}

    operator std::span<double>() { return {values_.data(), count_}; }
    Rgb colour() const {
        return count_ == 1 ? Rgb{values_[0], values_[0], values_[0]}
                           : Rgb{values_[0], values_[1], values_[2]};
    }

  private:
    std::array<double, 3> values_{};
    std::size_t count_;
};

bool is_share(double x) {
    return x >= 0 && x <= 1;
}

/// Part of the samples for the diffuse term: its part in the albedo, seen from 45 degrees.
double diffuse_share(const Bsdf& brdf, const MaterialSettings& settings) {
    const double diffuse = luminance(settings.albedo);
    if (diffuse == 0) return 0;
    if (settings.normalize_factor == 0) return 1;
    Channels rest(brdf);
    brdf.albedo(from_spherical(radians(45), 0), rest);
    return diffuse / (diffuse + settings.normalize_factor * luminance(rest.colour()));
}

}  // namespace

Material::Material(std::shared_ptr<const Bsdf> brdf, const MaterialSettings& settings)
    : brdf_(std::move(brdf)), settings_(settings) {
    if (brdf_ == nullptr) throw Error(ErrorCode::Usage, "a material needs a BRDF", "brdf");
    if (brdf_->channels() != 1 && brdf_->channels() != 3)
        throw Error(ErrorCode::Usage,
                    fmt::format("a picture needs a BRDF of 1 or 3 channels, this one has {}",
                                brdf_->channels()),
                    "brdf");
    if (!(settings.normalize_factor >= 0) || !std::isfinite(settings.normalize_factor))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is not a number from 0 on", settings.normalize_factor),
                    "normalize-factor");
    const Rgb a = settings.albedo;
    if (!is_share(a.r) || !is_share(a.g) || !is_share(a.b))
        throw Error(ErrorCode::Usage, "each part of an albedo lies within 0 .. 1", "albedo");
    diffuse_share_ = diffuse_share(*brdf_, settings_);
}

std::string Material::name() const {
    std::string name = brdf_->name();
    if (settings_.normalize_factor != 1)
        name += fmt::format(", normalize factor {}", settings_.normalize_factor);
    if (const Rgb a = settings_.albedo; !is_black(a))
        name += fmt::format(", albedo {}/{}/{}", a.r, a.g, a.b);
    return name;
}

Rgb Material::eval(Vec3 view, Vec3 light) const {
    if (view.z <= 0 || light.z <= 0) return {};
    Channels f(*brdf_);
    brdf_->eval(view, light, f);
    return (1 / kPi) * settings_.albedo + settings_.normalize_factor * f.colour();
}

Rgb Material::eval_pdf(Vec3 view, Vec3 light, double& pdf) const {
    pdf = 0;
    if (view.z <= 0 || light.z <= 0) return {};
    Channels f(*brdf_);
    pdf = brdf_->eval_pdf(view, light, f);
    pdf = diffuse_share_ * (light.z / kPi) + (1 - diffuse_share_) * pdf;
    return (1 / kPi) * settings_.albedo + settings_.normalize_factor * f.colour();
}

std::optional<MaterialSample> Material::sample(Vec3 view, double u1, double u2) const {
    if (view.z <= 0) return std::nullopt;
    // Which part: then u1 is again uniform in [0, 1)
    MaterialSample drawn;
    if (u1 < diffuse_share_) {
        drawn.light = sample_cosine(u1 / diffuse_share_, u2);
    } else {
        const double rest = (u1 - diffuse_share_) / (1 - diffuse_share_);
        const auto sample = brdf_->sample(view, rest, u2);
        if (!sample) return std::nullopt;
        drawn.light = sample->wo;
    }
    drawn.f = eval_pdf(view, drawn.light, drawn.pdf);
    if (!(drawn.pdf > 0)) return std::nullopt;
    return drawn;
}

Rgb Material::albedo(Vec3 view) const {
    if (view.z <= 0) return {};
    Channels a(*brdf_);
    brdf_->albedo(view, a);
    return settings_.albedo + settings_.normalize_factor * a.colour();
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/finite.h>
#include <asperity/render/light.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace asperity {

namespace {

[[noreturn]] void refuse(const char* setting, const std::string& why) {
    throw Error(ErrorCode::Usage, why, setting);
}

void expect_intensity(double intensity) {
    if (!std::isfinite(intensity) || intensity < 0)
        refuse("light-intensity", fmt::format("{} is no finite number from 0 up", intensity));
}

void expect_colour(Rgb colour) {
    if (!is_finite(colour) || std::min({colour.r, colour.g, colour.b}) < 0)
        refuse("light-colour", "a colour is three finite numbers, none below 0");
}

class PointLight final : public Light {
  public:
    explicit PointLight(const PointLightSettings& settings)
        : settings_(settings), intensity_(settings.intensity * settings.colour) {}

    std::string name() const override {
        const Vec3 p = settings_.position;
        const Rgb c = settings_.colour;
        return fmt::format("point light at ({}, {}, {}), intensity {}, colour {}/{}/{}", p.x, p.y,
                           p.z, settings_.intensity, c.r, c.g, c.b);
    }
    bool is_delta() const override { return true; }

    std::optional<LightSample> sample(Vec3 point, double, double) const override {
        const Vec3 to_light = settings_.position - point;
        const double distance = length(to_light);
        const Rgb radiance = (1 / (distance * distance)) * intensity_;
        // A point that is the light itself has no direction to it.
        if (is_black(intensity_) || !asperity::is_finite(radiance)) return std::nullopt;
        return LightSample{(1 / distance) * to_light, distance, radiance, 1};
    }

    Rgb radiance(Vec3) const override { return {}; }
    double pdf(Vec3) const override { return 0; }

    double weight() const override {
        // A model reaches out to 1, so a light at its middle is not infinitely near to it.
        constexpr double kLeast = 0.1;
        const double distance = std::max(length(settings_.position), kLeast);
        return luminance(intensity_) / (distance * distance);
    }

  private:
    PointLightSettings settings_;
    Rgb intensity_;
};

class DirectionalLight final : public Light {
  public:
    explicit DirectionalLight(const DirectionalLightSettings& settings)
        : settings_(settings),
          direction_(normalize(settings.direction)),
          irradiance_(settings.irradiance * settings.colour) {}

    std::string name() const override {
        const Vec3 d = settings_.direction;
        const Rgb c = settings_.colour;
        return fmt::format("directional light from ({}, {}, {}), irradiance {}, colour {}/{}/{}",
                           d.x, d.y, d.z, settings_.irradiance, c.r, c.g, c.b);
    }
    bool is_delta() const override { return true; }

    std::optional<LightSample> sample(Vec3, double, double) const override {
        if (is_black(irradiance_)) return std::nullopt;
        return LightSample{direction_, kFarAway, irradiance_, 1};
    }

    Rgb radiance(Vec3) const override { return {}; }
    double pdf(Vec3) const override { return 0; }
    double weight() const override { return luminance(irradiance_); }

  private:
    DirectionalLightSettings settings_;
    Vec3 direction_;
    Rgb irradiance_;
};

class ConstantLight final : public Light {
  public:
    explicit ConstantLight(Rgb radiance) : radiance_(radiance) {}

    std::string name() const override {
        return fmt::format("constant light, radiance {}/{}/{}", radiance_.r, radiance_.g,
                           radiance_.b);
    }

    std::optional<LightSample> sample(Vec3, double u1, double u2) const override {
        if (is_black(radiance_)) return std::nullopt;
        // Archimedes: heights on the sphere are uniform.
        const double y = 1 - 2 * u1, r = std::sqrt(std::max(0.0, 1 - y * y)), phi = 2 * kPi * u2;
        return LightSample{{r * std::cos(phi), y, r * std::sin(phi)}, kFarAway, radiance_, kPdf};
    }

    Rgb radiance(Vec3) const override { return radiance_; }
    double pdf(Vec3) const override { return is_black(radiance_) ? 0 : kPdf; }
    double weight() const override { return kPi * luminance(radiance_); }

  private:
    static constexpr double kPdf = 1 / (4 * kPi);
    Rgb radiance_;
};

}  // namespace

std::unique_ptr<Light> make_light(const PointLightSettings& settings) {
    if (!is_finite(settings.position)) refuse("light-position", "a place is three finite numbers");
    expect_intensity(settings.intensity);
    expect_colour(settings.colour);
    return std::make_unique<PointLight>(settings);
}

std::unique_ptr<Light> make_light(const DirectionalLightSettings& settings) {
    const double length_of_direction = length(settings.direction);
    if (!std::isfinite(length_of_direction) || !(length_of_direction > 0))
        refuse("light-direction", "a direction is three finite numbers, not all 0");
    expect_intensity(settings.irradiance);
    expect_colour(settings.colour);
    return std::make_unique<DirectionalLight>(settings);
}

std::unique_ptr<Light> make_light(const ConstantLightSettings& settings) {
    expect_colour(settings.radiance);
    return std::make_unique<ConstantLight>(settings.radiance);
}

}  // namespace asperity

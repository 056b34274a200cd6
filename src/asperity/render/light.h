// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/render/rgb.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace asperity {

/// The distance of lights that are no place.
inline constexpr double kFarAway = std::numeric_limits<double>::infinity();

/// Light that reaches a point from one direction.
struct LightSample {
    Vec3 direction;       ///< unit vector from the point to the light
    double distance = 0;  ///< to the light; infinite for light from far away
    Rgb radiance;         ///< L; its share of the picture is f cos(theta) L / pdf
    /// Density of `direction` [1/sr]; 1 for a light of no extent, whose L is then its irradiance on
    /// a plane that faces it.
    double pdf = 0;
};

/// What shines on a scene. Lights have no body: they are either far away, or points.
///
/// All functions are const, thread-safe and free of allocation. Directions are unit vectors in the
/// world (y up), from the surface to the light. A light does not know what hides it.
class Light {
  public:
    virtual ~Light() = default;

    /// One line that names the light and its parameters.
    virtual std::string name() const = 0;

    /// True for a light of no extent (point, directional): no direction drawn by a BRDF finds it,
    /// so radiance() and pdf() are zero.
    virtual bool is_delta() const { return false; }

    /// Draws a direction to the light as seen from `point`, from two numbers uniform in [0, 1);
    /// none where no light comes from. E[L / pdf] = the integral of L over all directions.
    virtual std::optional<LightSample> sample(Vec3 point, double u1, double u2) const = 0;

    /// What a ray that leaves the scene in `direction` brings back [radiance].
    virtual Rgb radiance(Vec3 direction) const = 0;

    /// Density of sample() [1/sr].
    virtual double pdf(Vec3 direction) const = 0;

    /// What is drawn behind the model: radiance(), smoothed where it is made of texels.
    virtual Rgb background(Vec3 direction) const { return radiance(direction); }

    /// Mean irradiance at the origin, that of a plane that faces a delta light: how often this
    /// light is worth a sample beside others. >= 0, finite.
    virtual double weight() const = 0;
};

/// The thesis' light. Radiant intensity I in all directions: L = I / d^2.
struct PointLightSettings {
    Vec3 position{1, 1, 1};
    double intensity = 300;  ///< >= 0
    Rgb colour{1, 1, 1};     ///< each >= 0; multiplies the intensity
};

/// Parallel light.
struct DirectionalLightSettings {
    Vec3 direction{1, 1, 1};  ///< from the model to the light; any length but 0
    double irradiance = 3;    ///< on a plane that faces the light, >= 0
    Rgb colour{1, 1, 1};
};

/// The same from everywhere: the white furnace. sample() is uniform over the sphere.
struct ConstantLightSettings {
    Rgb radiance{1, 1, 1};  ///< each >= 0
};

// Throw Error(Usage, "light-position" | "light-intensity" | "light-colour" | "light-direction")
// for what is not finite, negative, or no direction.
std::unique_ptr<Light> make_light(const PointLightSettings& settings);
std::unique_ptr<Light> make_light(const DirectionalLightSettings& settings);
std::unique_ptr<Light> make_light(const ConstantLightSettings& settings);

}  // namespace asperity

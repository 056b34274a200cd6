// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/render/rgb.h>

#include <memory>
#include <optional>
#include <string>

namespace asperity {

/// What a Material adds to a Bsdf: the two fields of the thesis' simulated model (2.3.1.2).
struct MaterialSettings {
    double normalize_factor = 1;  ///< times the Bsdf, >= 0; 1 is physically right
    Rgb albedo{0, 0, 0};          ///< of the diffuse term, each 0 .. 1; black: none
};

/// A direction drawn by Material::sample, with f there.
struct MaterialSample {
    Vec3 light;      ///< unit vector to where light may come from, light.z > 0
    Rgb f;           ///< [1/sr], without the cosine
    double pdf = 0;  ///< [1/sr], > 0
};

/// What shades a point (thesis eq. 4.1 and the shader of its simulated model):
///
///     f(view, light) = albedo / pi + normalize_factor * brdf(view, light)
///
/// `view` and `light` are unit vectors away from the surface in the frame of a Bsdf, z the
/// normal; where view.z <= 0 or light.z <= 0, f = 0. `view` takes the place of wi and `light` that
/// of wo: a BRDF is the same both ways (Helmholtz), and a measured one, which keeps that only
/// within its noise, was made exact for its wi. So a white furnace shows Bsdf::albedo(view).
///
/// A Bsdf of one channel is grey. Const, thread-safe, free of allocation. Sharing: copies share the
/// Bsdf, so a change of the settings is cheap.
class Material {
  public:
    /// Throws Error(Usage, "brdf") for a Bsdf of other than 1 or 3 channels, Error(Usage,
    /// "normalize-factor" | "albedo").
    explicit Material(std::shared_ptr<const Bsdf> brdf, const MaterialSettings& settings = {});

    const Bsdf& brdf() const { return *brdf_; }
    const MaterialSettings& settings() const { return settings_; }
    /// One line for provenance: the Bsdf's name, followed by what is not as by default.
    std::string name() const;

    Rgb eval(Vec3 view, Vec3 light) const;

    /// eval() and the density of sample() [1/sr] at once, cheaper than one after the other.
    Rgb eval_pdf(Vec3 view, Vec3 light, double& pdf) const;

    /// Draws `light` for this view from two numbers uniform in [0, 1): from the Bsdf, or from a
    /// cosine for the diffuse term, as often as its part in the albedo. None when f must be 0.
    std::optional<MaterialSample> sample(Vec3 view, double u1, double u2) const;

    /// Share of the light that comes from `view` and is reflected: the white furnace.
    Rgb albedo(Vec3 view) const;

  private:
    std::shared_ptr<const Bsdf> brdf_;
    MaterialSettings settings_;
    double diffuse_share_ = 0;  ///< of the samples
};

}  // namespace asperity

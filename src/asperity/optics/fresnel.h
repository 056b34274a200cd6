// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>
#include <asperity/optics/scattering_law.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace asperity {

/// Representative wavelengths of red, green and blue [nm].
inline constexpr std::array<double, 3> kRgbWavelengths = {650, 550, 450};

/// Largest number of channels one path carries.
inline constexpr int kMaxChannels = 64;

/// Schlick 1994: f0 + (1 - f0) (1 - cos_theta)^5; cos_theta in [0, 1]. Thesis eq. 3.3.
double fresnel_schlick(double cos_theta, double f0);

/// ((n1 - n2) / (n1 + n2))^2, thesis eq. 3.5.
double f0_from_indices(double n1, double n2);

/// Exact reflectance of a dielectric for unpolarised light; `eta` = n_inside / n_outside > 0.
double fresnel_dielectric(double cos_theta, double eta);

/// Exact reflectance of a conductor for unpolarised light; index n + i k against the outside.
double fresnel_conductor(double cos_theta, double n, double k);

/// The kind that settings given without one can only mean: a material or k a conductor, f0 Schlick,
/// an index alone a dielectric, nothing perfect mirrors.
FresnelKind implied_fresnel(const OpticsSettings& settings);

/// Of the channels of a material [nm]; empty where none is named.
std::vector<double> wavelengths_of(const OpticsSettings& settings);

/// The reflectance of the facets, per channel, ready to evaluate.
class Fresnel {
  public:
    /// F = 1 on one channel.
    Fresnel() = default;
    /// Throws Error(Usage, "name of the setting") for values outside their range, lists of unequal
    /// length, missing or superfluous settings, an unknown material.
    explicit Fresnel(const OpticsSettings& settings);

    int channels() const { return static_cast<int>(channels_.size()); }
    /// "all" (one channel), "R", "G", "B" (three without wavelengths or with the default ones), or
    /// "550nm"...
    const std::vector<std::string>& channel_names() const { return names_; }
    /// True when F = 1 on every channel: weights never change.
    bool perfect() const { return law_->kind == FresnelKind::None; }

    /// Writes the reflectance of each channel; cos_theta in [0, 1] between wi and wm;
    /// f.size() == channels().
    void eval(double cos_theta, std::span<double> f) const;
    /// The same of one channel for many angles, up to rounding: f[k] for cos_theta[k].
    void eval(int channel, std::span<const double> cos_theta, double* f) const;
    /// The same for many angles, in single precision: f[channel][k] for cos_theta[k].
    void eval(std::span<const float> cos_theta, std::span<float* const> f) const;

  private:
    const ScatteringLaw* law_ = &scattering_law(FresnelKind::None);
    std::vector<FacetChannel> channels_ = {FacetChannel{}};
    std::vector<std::string> names_ = {"all"};
};

}  // namespace asperity

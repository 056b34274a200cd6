// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/fresnel.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity {
namespace {

std::vector<std::string> names_without_wavelengths(std::size_t count) {
    if (count == 1) return {"all"};
    if (count == 3) return {"R", "G", "B"};
    std::vector<std::string> names;
    for (std::size_t c = 0; c < count; ++c) names.push_back(fmt::format("c{}", c + 1));
    return names;
}

std::vector<std::string> names_of_wavelengths(const std::vector<double>& wavelengths) {
    if (std::equal(wavelengths.begin(), wavelengths.end(), kRgbWavelengths.begin(),
                   kRgbWavelengths.end()))
        return {"R", "G", "B"};
    std::vector<std::string> names;
    for (const double w : wavelengths) names.push_back(fmt::format("{}nm", w));
    return names;
}

}  // namespace

FresnelKind implied_fresnel(const OpticsSettings& optics) {
    if (!optics.material.empty() || !optics.k.empty()) return FresnelKind::Conductor;
    if (!optics.f0.empty()) return FresnelKind::Schlick;
    if (!optics.ior.empty()) return FresnelKind::Dielectric;
    return FresnelKind::None;
}

std::vector<double> wavelengths_of(const OpticsSettings& s) {
    if (s.material.empty() || !s.wavelengths.empty()) return s.wavelengths;
    return {kRgbWavelengths.begin(), kRgbWavelengths.end()};
}

Fresnel::Fresnel(const OpticsSettings& s)
    : law_(&scattering_law(s.fresnel)), channels_(law_->channels(s)) {
    names_ = s.material.empty() ? names_without_wavelengths(channels_.size())
                                : names_of_wavelengths(wavelengths_of(s));
}

void Fresnel::eval(double cos_theta, std::span<double> f) const {
    for (std::size_t c = 0; c < channels_.size(); ++c)
        f[c] = law_->reflectance(cos_theta, channels_[c]);
}

void Fresnel::eval(int channel, std::span<const double> cos_theta, double* f) const {
    const FacetChannel& c = channels_[static_cast<std::size_t>(channel)];
    if (law_->precise_reflectances != nullptr) {
        law_->precise_reflectances(cos_theta, c, f);
        return;
    }
    for (std::size_t k = 0; k < cos_theta.size(); ++k) f[k] = law_->reflectance(cos_theta[k], c);
}

void Fresnel::eval(std::span<const float> cos_theta, std::span<float* const> f) const {
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        if (law_->reflectances != nullptr) {
            law_->reflectances(cos_theta, channels_[c], f[c]);
            continue;
        }
        for (std::size_t k = 0; k < cos_theta.size(); ++k)
            f[c][k] = static_cast<float>(
                law_->reflectance(static_cast<double>(cos_theta[k]), channels_[c]));
    }
}

}  // namespace asperity

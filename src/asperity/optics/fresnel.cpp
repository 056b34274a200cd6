// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/fresnel_lanes.h>
#include <asperity/optics/materials.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace asperity {
namespace {

[[noreturn]] void reject(const char* setting, std::string message) {
    throw Error(ErrorCode::Usage, std::move(message), setting);
}

struct NamedList {
    const char* name;
    const std::vector<double>& values;
};

/// Settings that `kind` does not read must not be given: silence would hide a mistake.
void require_absent(const char* kind, std::initializer_list<NamedList> lists) {
    for (const NamedList& list : lists)
        if (!list.values.empty()) reject(list.name, fmt::format("has no meaning with {}", kind));
}

void require_no_material(const char* kind, const OpticsSettings& s) {
    if (!s.material.empty()) reject("material", fmt::format("has no meaning with {}", kind));
    require_absent(kind, {{"wavelengths", s.wavelengths}});
}

void require_range(const NamedList& list, double low, double high, bool low_included,
                   const char* words) {
    if (list.values.size() > static_cast<std::size_t>(kMaxChannels))
        reject(list.name, fmt::format("{} values given, at most {} channels are carried",
                                      list.values.size(), kMaxChannels));
    for (const double v : list.values)
        if (!(v <= high && (low_included ? v >= low : v > low)))
            reject(list.name, fmt::format("{} is not {}", v, words));
}

void require_f0(const OpticsSettings& s) {
    require_range({"f0", s.f0}, 0, 1, true, "within 0 .. 1");
}

/// Beyond this an index is a slip of the pen; metals in the far infrared stay below.
constexpr double kMaxIndex = 1000;

void require_ior(const OpticsSettings& s) {
    require_range({"ior", s.ior}, 0, kMaxIndex, false, "above 0 and at most 1000");
}

/// Value of channel `c`; a list of one serves all.
double value_of(const std::vector<double>& list, std::size_t c) {
    return list.size() == 1 ? list[0] : list[c];
}

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

void require_distinct(const std::vector<double>& wavelengths) {
    for (std::size_t a = 0; a < wavelengths.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (wavelengths[a] == wavelengths[b])
                reject("wavelengths", fmt::format("{} nm is given twice", wavelengths[a]));
}

}  // namespace

double fresnel_schlick(double cos_theta, double f0) {
    const double m = std::clamp(1.0 - cos_theta, 0.0, 1.0);
    const double m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}

double f0_from_indices(double n1, double n2) {
    const double r = (n1 - n2) / (n1 + n2);
    return r * r;
}

double fresnel_dielectric(double cos_theta, double eta) {
    if (eta == 1) return 0;  // no border at all, also along it
    const double c = std::clamp(cos_theta, 0.0, 1.0);
    // Snell: sin(theta_t) = sin(theta_i) / eta.
    const double sin2_t = (1 - c) * (1 + c) / (eta * eta);
    if (sin2_t >= 1) return 1;  // total internal reflection
    const double ct = std::sqrt(1 - sin2_t);
    // Fresnel's equations for both polarisations (Born and Wolf, 1.5.2).
    const double rs = (c - eta * ct) / (c + eta * ct);
    const double rp = (eta * c - ct) / (eta * c + ct);
    return 0.5 * (rs * rs + rp * rp);
}

double fresnel_conductor(double cos_theta, double n, double k) {
    if (k == 0) return fresnel_dielectric(cos_theta, n);
    const double c = std::clamp(cos_theta, 0.0, 1.0);
    const double s2 = (1 - c) * (1 + c);
    // a + i b = sqrt((n + i k)^2 - sin^2), the branch free of cancellation.
    const double re = (n - k) * (n + k) - s2, im = 2 * n * k;
    const double modulus = std::sqrt(re * re + im * im);
    double a = 0, b = 0;
    if (re >= 0) {
        a = std::sqrt(0.5 * (modulus + re));
        b = 0.5 * im / a;
    } else {
        b = std::sqrt(0.5 * (modulus - re));
        a = 0.5 * im / b;
    }
    // Reflectances of both polarisations (Born and Wolf, 14.2; p over s as a ratio).
    const double b2 = b * b;
    const double rs = ((a - c) * (a - c) + b2) / ((a + c) * (a + c) + b2);
    const double p_minus = a * c - s2, p_plus = a * c + s2, bc2 = b2 * c * c;
    const double rp = rs * (p_minus * p_minus + bc2) / (p_plus * p_plus + bc2);
    return 0.5 * (rs + rp);
}

FresnelKind implied_fresnel(const OpticsSettings& optics) {
    if (!optics.material.empty() || !optics.k.empty()) return FresnelKind::Conductor;
    if (!optics.f0.empty()) return FresnelKind::Schlick;
    if (!optics.ior.empty()) return FresnelKind::Dielectric;
    return FresnelKind::None;
}

Fresnel::Fresnel(const OpticsSettings& s) : kind_(s.fresnel) {
    switch (kind_) {
        case FresnelKind::None:
            require_absent("fresnel none", {{"f0", s.f0}, {"ior", s.ior}, {"k", s.k}});
            require_no_material("fresnel none", s);
            return;
        case FresnelKind::Schlick:
            require_absent("fresnel schlick", {{"k", s.k}});
            require_no_material("fresnel schlick", s);
            if (s.f0.empty() == s.ior.empty())
                reject("f0", s.f0.empty() ? "fresnel schlick needs f0 or ior"
                                          : "give f0 or ior, not both");
            require_f0(s);
            require_ior(s);
            channels_.clear();
            for (const double f0 : s.f0) channels_.push_back({f0, 1, 0});
            // Thesis eq. 3.5 against air, n1 = 1.
            for (const double n : s.ior) channels_.push_back({f0_from_indices(1, n), n, 0});
            break;
        case FresnelKind::Dielectric:
            require_absent("fresnel dielectric", {{"f0", s.f0}, {"k", s.k}});
            require_no_material("fresnel dielectric", s);
            if (s.ior.empty()) reject("ior", "fresnel dielectric needs ior");
            require_ior(s);
            channels_.clear();
            for (const double n : s.ior) channels_.push_back({f0_from_indices(1, n), n, 0});
            break;
        case FresnelKind::Conductor:
            set_conductor(s);
            return;
        default:
            reject("fresnel", "is not one of none, schlick, dielectric, conductor");
    }
    names_ = names_without_wavelengths(channels_.size());
}

void Fresnel::set_conductor(const OpticsSettings& s) {
    require_absent("fresnel conductor", {{"f0", s.f0}});
    std::vector<ComplexIndex> indices;
    if (!s.material.empty()) {
        require_absent("a material, which brings its own", {{"ior", s.ior}, {"k", s.k}});
        const std::vector<double> wavelengths =
            s.wavelengths.empty()
                ? std::vector<double>(kRgbWavelengths.begin(), kRgbWavelengths.end())
                : s.wavelengths;
        require_range({"wavelengths", wavelengths}, kMinWavelength, kMaxWavelength, true,
                      "within 400 .. 700 nm");
        require_distinct(wavelengths);
        for (const double w : wavelengths) indices.push_back(refractive_index(s.material, w));
        names_ = names_of_wavelengths(wavelengths);
    } else {
        require_absent("fresnel conductor unless a material is named",
                       {{"wavelengths", s.wavelengths}});
        if (s.ior.empty()) reject("ior", "fresnel conductor needs a material, or ior and k");
        if (s.k.empty()) reject("k", "fresnel conductor needs a material, or ior and k");
        require_ior(s);
        require_range({"k", s.k}, 0, kMaxIndex, true, "within 0 .. 1000");
        const std::size_t count = std::max(s.ior.size(), s.k.size());
        if ((s.ior.size() != 1 && s.ior.size() != count) ||
            (s.k.size() != 1 && s.k.size() != count))
            reject("k", fmt::format("has {} values, ior has {}", s.k.size(), s.ior.size()));
        for (std::size_t c = 0; c < count; ++c)
            indices.push_back({value_of(s.ior, c), value_of(s.k, c)});
        names_ = names_without_wavelengths(count);
    }
    channels_.clear();
    for (const ComplexIndex& index : indices)
        channels_.push_back({fresnel_conductor(1, index.n, index.k), index.n, index.k});
}

void Fresnel::eval(double cos_theta, std::span<double> f) const {
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const Channel& channel = channels_[c];
        switch (kind_) {
            case FresnelKind::None:
                f[c] = 1;
                break;
            case FresnelKind::Schlick:
                f[c] = fresnel_schlick(cos_theta, channel.f0);
                break;
            case FresnelKind::Dielectric:
                f[c] = fresnel_dielectric(cos_theta, channel.n);
                break;
            case FresnelKind::Conductor:
                f[c] = fresnel_conductor(cos_theta, channel.n, channel.k);
                break;
        }
    }
}

void Fresnel::eval(std::span<const float> cos_theta, std::span<float* const> f) const {
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const auto f0 = static_cast<float>(channels_[c].f0), n = static_cast<float>(channels_[c].n),
                   k = static_cast<float>(channels_[c].k);
        if (kind_ == FresnelKind::None)
            std::fill_n(f[c], cos_theta.size(), 1.0f);
        else if (kind_ == FresnelKind::Schlick)
            schlick_lanes(cos_theta, f0, f[c]);
        else if (k > 0)
            conductor_lanes(cos_theta, n, k, f[c]);
        else if (n == 1)
            std::fill_n(f[c], cos_theta.size(), 0.0f);  // no border at all, also along it
        else
            dielectric_lanes(cos_theta, n, f[c]);
    }
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include "texture_report.h"

#include <asperity/core/length.h>
#include <asperity/surface/autocorrelation.h>
#include <asperity/surface/spectral_density.h>
#include <fmt/format.h>

namespace asperity::cli {

namespace {

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json fit_json(const std::optional<SlopeFit>& fit) {
    if (!fit) return nullptr;
    return {{"alpha_x", fit->alpha_x}, {"alpha_y", fit->alpha_y}, {"misfit", fit->misfit}};
}

std::string fit_text(const std::optional<SlopeFit>& fit) {
    if (!fit) return "none: too many slopes are zero";
    return fmt::format("{:.4g}  {:.4g}, misfit {:.4f}", fit->alpha_x, fit->alpha_y, fit->misfit);
}

Json curves_json(const Heightfield& patch, Run& run) {
    const HeightAutocorrelation acf(patch, run);
    Json x = Json::array(), y = Json::array();
    for (int k = 0; k <= acf.most_x(); ++k) x.push_back(acf.at(k, 0));
    for (int k = 0; k <= acf.most_y(); ++k) y.push_back(acf.at(0, k));
    const SpectralDensity psd = spectral_density(patch, run);
    return {{"autocorrelation",
             {{"step_x", patch.dx}, {"along_x", x}, {"step_y", patch.dy}, {"along_y", y}}},
            {"power_spectral_density", {{"frequency", psd.frequency}, {"radial", psd.radial}}}};
}

}  // namespace

TextureReport::TextureReport(const SurfaceSettings& settings, const Heightfield& patch, Run& run)
    : patch_(patch),
      areal_(areal_parameters(patch, run)),
      beckmann_(fit_slopes(patch, SlopeFamily::Beckmann, run.threads())),
      ggx_(fit_slopes(patch, SlopeFamily::Ggx, run.threads())) {
    if (patch.unit == "m")
        optics_ = geometric_optics(patch, in_unit(settings.wavelength, "m").value_or(0), run);
}

std::string TextureReport::text() const {
    std::string text = "areal parameters, ISO 25178-2, of the surface before it is mirrored\n";
    const auto add = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<36}{}\n", name, value);
    };
    const auto length = [&](double value) {
        return patch_.unit == "m" ? length_text(value)
                                  : fmt::format("{:.6g} {}", value, patch_.unit);
    };
    const auto lengths = [&](std::initializer_list<double> values) {
        std::string line;
        for (const double value : values) line += (line.empty() ? "" : "  ") + length(value);
        return line;
    };
    const ArealParameters& p = areal_;
    add("Sa, Sq", lengths({p.sa, p.sq}));
    add("Sp, Sv, Sz", lengths({p.sp, p.sv, p.sz}));
    add("Ssk, Sku", fmt::format("{:.6g}  {:.6g}", p.ssk, p.sku));
    add("Sdq, Sdr", fmt::format("{:.6g}  {:.4g} %", p.sdq, 100 * p.sdr));
    add("Sal", p.sal ? length(*p.sal) : "none within half the width");
    add("Str", p.str ? fmt::format("{:.4g}", *p.str) : "none within half the width");
    if (p.std_deg) add("Std, of the lay from x", fmt::format("{:.4g}°", *p.std_deg));
    add("Sk, Spk, Svk", lengths({p.sk, p.spk, p.svk}));
    add("Smr1, Smr2", fmt::format("{:.4g} %  {:.4g} %", p.smr1, p.smr2));
    add("Beckmann alpha x, y of the slopes", fit_text(beckmann_));
    add("GGX alpha x, y of the slopes", fit_text(ggx_));
    if (!optics_) return text;
    text += optics_->verdict + "\n";
    add("curved within 5 wavelengths",
        fmt::format("{:.3g} % of the area", 100 * optics_->sharp_share));
    add("Sq / wavelength, coherent share",
        fmt::format("{:.4g}  {:.3g} %", optics_->rms_height, 100 * optics_->coherent_share));
    add("spacing / wavelength", fmt::format("{:.4g}", optics_->spacing));
    add("RMS gradient at twice the spacing", fmt::format("{:.4g} of it", optics_->slope_ratio));
    return text;
}

Json TextureReport::json(Run& run) const {
    const ArealParameters& p = areal_;
    Json json = {{"Sa", p.sa},
                 {"Sq", p.sq},
                 {"Sp", p.sp},
                 {"Sv", p.sv},
                 {"Sz", p.sz},
                 {"Ssk", p.ssk},
                 {"Sku", p.sku},
                 {"Sdq", p.sdq},
                 {"Sdr", p.sdr},
                 {"Sk", p.sk},
                 {"Spk", p.spk},
                 {"Svk", p.svk},
                 {"Smr1", p.smr1},
                 {"Smr2", p.smr2},
                 {"Sal", or_null(p.sal)},
                 {"Str", or_null(p.str)},
                 {"Std", or_null(p.std_deg)}};
    json["nx"] = patch_.nx;
    json["ny"] = patch_.ny;
    json["beckmann"] = fit_json(beckmann_);
    json["ggx"] = fit_json(ggx_);
    if (patch_.heights.size() <= kMostTransformed) json.update(curves_json(patch_, run));
    json["geometric_optics"] = nullptr;
    if (optics_)
        json["geometric_optics"] = {{"holds", optics_->holds},
                                    {"verdict", optics_->verdict},
                                    {"wavelength", optics_->wavelength},
                                    {"sharp_share", optics_->sharp_share},
                                    {"rms_height_over_wavelength", optics_->rms_height},
                                    {"coherent_share", optics_->coherent_share},
                                    {"spacing_over_wavelength", optics_->spacing},
                                    {"slope_ratio", optics_->slope_ratio}};
    return json;
}

}  // namespace asperity::cli

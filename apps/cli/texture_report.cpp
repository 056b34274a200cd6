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
      figures_(texture_figures(patch, in_unit(settings.wavelength, "m").value_or(0), run)) {}

std::string TextureReport::text() const {
    std::string text = "areal parameters, ISO 25178-2, of the surface before it is mirrored\n";
    for (const TextureRow& row : texture_rows(figures_, patch_))
        text +=
            row.name.empty() ? row.value + "\n" : fmt::format("  {:<36}{}\n", row.name, row.value);
    return text;
}

Json TextureReport::json(Run& run) const {
    const ArealParameters& p = figures_.areal;
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
    json["beckmann"] = fit_json(figures_.beckmann);
    json["ggx"] = fit_json(figures_.ggx);
    if (patch_.heights.size() <= kMostTransformed) json.update(curves_json(patch_, run));
    json["geometric_optics"] = nullptr;
    if (const auto& optics = figures_.optics)
        json["geometric_optics"] = {{"holds", optics->holds},
                                    {"verdict", optics->verdict},
                                    {"wavelength", optics->wavelength},
                                    {"sharp_share", optics->sharp_share},
                                    {"rms_height_over_wavelength", optics->rms_height},
                                    {"coherent_share", optics->coherent_share},
                                    {"spacing_over_wavelength", optics->spacing},
                                    {"slope_ratio", optics->slope_ratio}};
    return json;
}

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/texture_figures.h>

#include <asperity/core/length.h>
#include <fmt/format.h>

#include <initializer_list>
#include <utility>

namespace asperity {

namespace {

std::string fit_text(const std::optional<SlopeFit>& fit) {
    if (!fit) return "none: too many slopes are zero";
    return fmt::format("{:.4g}  {:.4g}, misfit {:.4f}", fit->alpha_x, fit->alpha_y, fit->misfit);
}

void add_optics(std::vector<TextureRow>& rows, const GeometricOptics& optics) {
    rows.push_back({"", optics.verdict});
    rows.push_back({"curved within 5 wavelengths",
                    fmt::format("{:.3g} % of the area", 100 * optics.sharp_share)});
    rows.push_back(
        {"Sq / wavelength, coherent share",
         fmt::format("{:.4g}  {:.3g} %", optics.rms_height, 100 * optics.coherent_share)});
    rows.push_back({"spacing / wavelength", fmt::format("{:.4g}", optics.spacing)});
    rows.push_back(
        {"RMS gradient at twice the spacing", fmt::format("{:.4g} of it", optics.slope_ratio)});
}

}  // namespace

TextureFigures texture_figures(const Heightfield& patch, double wavelength, Run& run) {
    TextureFigures figures;
    figures.areal = areal_parameters(patch, run);
    figures.beckmann = fit_slopes(patch, SlopeFamily::Beckmann, run.threads());
    figures.ggx = fit_slopes(patch, SlopeFamily::Ggx, run.threads());
    if (patch.unit == "m") figures.optics = geometric_optics(patch, wavelength, run);
    return figures;
}

std::vector<TextureRow> texture_rows(const TextureFigures& figures, const Heightfield& patch) {
    const auto length = [&](double value) {
        return patch.unit == "m" ? length_text(value) : fmt::format("{:.6g} {}", value, patch.unit);
    };
    const auto lengths = [&](std::initializer_list<double> values) {
        std::string line;
        for (const double value : values) line += (line.empty() ? "" : "  ") + length(value);
        return line;
    };
    const ArealParameters& p = figures.areal;
    std::vector<TextureRow> rows = {
        {"Sa, Sq", lengths({p.sa, p.sq})},
        {"Sp, Sv, Sz", lengths({p.sp, p.sv, p.sz})},
        {"Ssk, Sku", fmt::format("{:.6g}  {:.6g}", p.ssk, p.sku)},
        {"Sdq, Sdr", fmt::format("{:.6g}  {:.4g} %", p.sdq, 100 * p.sdr)},
        {"Sal", p.sal ? length(*p.sal) : "none within half the width"},
        {"Str", p.str ? fmt::format("{:.4g}", *p.str) : "none within half the width"},
    };
    if (p.std_deg) rows.push_back({"Std, of the lay from x", fmt::format("{:.4g}°", *p.std_deg)});
    rows.push_back({"Sk, Spk, Svk", lengths({p.sk, p.spk, p.svk})});
    rows.push_back({"Smr1, Smr2", fmt::format("{:.4g} %  {:.4g} %", p.smr1, p.smr2)});
    rows.push_back({"Beckmann alpha x, y of the slopes", fit_text(figures.beckmann)});
    rows.push_back({"GGX alpha x, y of the slopes", fit_text(figures.ggx)});
    if (figures.optics) add_optics(rows, *figures.optics);
    return rows;
}

}  // namespace asperity

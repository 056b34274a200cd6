// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/figures.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/plots/curves_of.h>
#include <asperity/plots/plot_polar.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots::detail {

namespace {

constexpr double kEnoughLobeNoise = 0.015;  ///< that needs no more averaging
constexpr double kHelpsLobe = 0.85;  ///< noise that averaging twice as wide must leave at most
constexpr double kShown = 0.05;      ///< of the largest value: darker parts ask for nothing
constexpr double kWidestStrip = 6;   ///< to either side of the plane [degrees]
constexpr double kLobeStep = 0.25;   ///< degrees

/// How much values that are seen are off, as a share: by their standard errors, or by how they
/// differ from the middle of their neighbours, whichever is more. What the facets of a small
/// surface do, no error of the rays knows.
double noise_of(const LobeSlice& slice) {
    const std::vector<LobeSample>& s = slice.samples;
    double top = 0, errors = 0, grain = 0;
    int count = 0;
    for (const LobeSample& sample : s) top = std::max(top, sample.f);
    for (std::size_t k = 1; k + 1 < s.size(); ++k) {
        if (!(s[k].f > kShown * top)) continue;
        const double off = s[k].f - 0.5 * (s[k - 1].f + s[k + 1].f);
        // Of independent values this difference is sqrt(3 / 2) times as large as their errors
        grain += off * off / (1.5 * s[k].f * s[k].f);
        if (std::isfinite(s[k].f_stderr)) errors += std::pow(s[k].f_stderr / s[k].f, 2);
        ++count;
    }
    return count == 0 ? 0 : std::sqrt(std::max(errors, grain) / count);
}

/// Half the strip, in columns, that brings the noise of all measured lobes down, as far as width
/// helps.
double columns_for(const std::vector<LitSubject>& lit, const PlotSettings& settings) {
    if (settings.average > 0) return settings.average;
    double columns = 1;
    for (const LitSubject& one : lit) {
        if (one.layer == nullptr) continue;
        const Measurement& m = *one.subject->measurement;
        const int channel = channel_of(m, settings);
        const double widest = kWidestStrip / (360.0 / m.detector.columns());
        const auto noise_at = [&](double half) {
            return noise_of(lobe_slice(m, *one.layer, channel, {radians(settings.plane), half}));
        };
        double noise = noise_at(columns);
        while (noise > kEnoughLobeNoise && 2 * columns <= widest) {
            const double wider = noise_at(2 * columns);
            if (wider > kHelpsLobe * noise) break;
            noise = wider;
            columns *= 2;
        }
    }
    return columns;
}

std::string note_of(const std::vector<LitSubject>& lit, const PlotSettings& settings,
                    double columns) {
    std::string note;
    if (settings.plane != 0)
        note = fmt::format("In the plane at {:.4g}° to that of incidence", settings.plane);
    const LitSubject* measured = first_measured(lit);
    if (measured == nullptr) return note;
    const double half = columns * 360.0 / measured->subject->measurement->detector.columns();
    note += fmt::format("{}eans over ±{:.3g}° beside the plane", note.empty() ? "M" : ". M", half);
    if (settings.average == 0 && columns > 1) note += ", widened for the noise";
    return note;
}

/// f of a model in the plane, where no instrument gives cells to average over.
PlotCurve exact_curve(const LitSubject& one, int channel, double plane) {
    const Bsdf& model = *one.subject->model;
    const Vec3 wi = from_spherical(one.light.theta_i, one.light.phi_i);
    std::array<double, kMaxBsdfChannels> f{};
    const std::span<double> channels(f.data(), static_cast<std::size_t>(model.channels()));
    std::vector<double> x, y;
    const int half = static_cast<int>(90 / kLobeStep) - 1;
    for (int k = -half; k <= half; ++k) {
        const double theta = kLobeStep * k;
        const double azimuth = one.light.phi_i + plane + (theta < 0 ? 0 : kPi);
        model.eval(wi, from_spherical(radians(std::abs(theta)), azimuth), channels);
        double sum = 0;
        for (const double value : channels) sum += value;
        x.push_back(theta);
        y.push_back(channel >= 0 ? channels[static_cast<std::size_t>(channel)]
                                 : sum / static_cast<double>(channels.size()));
    }
    return model_curve(one.name, one.name, "f [1/sr]", PlotInk::Simulated, std::move(x),
                       std::move(y));
}

/// The model as an instrument like that of the measurement would see it.
PlotCurve seen_curve(const LitSubject& one, const Measurement& as, int channel,
                     const LobeCut& cut) {
    const LobeSlice slice = lobe_slice(*one.subject->model, as, one.light, channel, cut);
    PlotCurve curve = lobe_curve(slice, one.name, one.name + ": f [1/sr]", PlotInk::Simulated);
    curve.error.clear();
    curve.look = CurveLook::Dashes;
    return curve;
}

}  // namespace

PlotPointer lobe_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    const std::vector<LitSubject> lit = lit_subjects(subjects, settings);
    const LitSubject* measured = first_measured(lit);
    const LobeCut cut{radians(settings.plane), columns_for(lit, settings)};
    CurveSet set = lobe_set(title_of(lit, settings));
    set.error_band = !settings.no_errors;
    set.note = note_of(lit, settings, cut.columns);
    std::vector<double> theta_i;
    for (const LitSubject& one : lit) {
        if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
        const int k = static_cast<int>(set.curves.size());
        if (one.layer != nullptr) {
            const Measurement& m = *one.subject->measurement;
            const LobeSlice slice = lobe_slice(m, *one.layer, channel_of(m, settings), cut);
            set.curves.push_back(
                lobe_curve(slice, one.name, one.name + ": f [1/sr]", series_ink(k)));
            if (&one == measured) set.more = cosine_columns(slice, one.name + ": ");
        } else {
            const int channel = channel_of(*one.subject->model, subjects, settings);
            set.curves.push_back(
                measured != nullptr ? seen_curve(one, *measured->subject->measurement, channel, cut)
                                    : exact_curve(one, channel, cut.azimuth));
            set.curves.back().ink = series_ink(k);
            if (measured == nullptr && k == 0) set.curves.back().look = CurveLook::Line;
        }
        const double theta = degrees(one.light.theta_i);
        if (settings.plane == 0 &&
            std::find(theta_i.begin(), theta_i.end(), theta) == theta_i.end())
            theta_i.push_back(theta);
    }
    // The columns of f cos(theta) go with the first curve of the set
    if (measured != &lit.front()) set.more.clear();
    PlotAxis values = value_axis(set, is_log(settings), settings.decades, "BRDF  f  [sr⁻¹]");
    if (settings.axes == PlotAxes::Polar)
        return std::make_shared<PolarPlot>(std::move(set), std::move(values), theta_i);
    const std::string plane =
        settings.plane == 0 ? "plane of incidence"
                            : fmt::format("plane at {:.4g}° to that of incidence", settings.plane);
    return lobe_plot(std::move(set), std::move(values), plane, theta_i);
}

}  // namespace asperity::plots::detail

// SPDX-License-Identifier: Apache-2.0
// Plots of surfaces: their facets' tilts, a line through their heights, their spectra.
#include <asperity/core/error.h>
#include <asperity/measured/normal_profile.h>
#include <asperity/plots/curves_of.h>
#include <asperity/plots/figures.h>
#include <asperity/plots/plot_frame.h>
#include <asperity/surface/spectral_density.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity::plots::detail {

namespace {

constexpr int kNormalBins = 180;  ///< half a degree each
constexpr double kMostDecades = 14;

/// A length that numbers of a plot are written in.
struct Unit {
    const char* name;      ///< on axes
    const char* in_table;  ///< without letters that a table could lose
    double per;            ///< of these to one unit of the heights
};

/// Where some surfaces are measured in metres and others in cells, they share no axis. Throws
/// Error(Usage).
bool in_metres(const Subjects& subjects) {
    const std::string& unit = subjects.front().surface->unit;
    for (const PlotSubject& subject : subjects)
        if (subject.surface->unit != unit)
            throw Error(
                ErrorCode::Usage,
                fmt::format("{} is measured in {}, {} in {}: they share no axis",
                            subjects.front().name, unit, subject.name, subject.surface->unit));
    return unit == "m";
}

/// The unit in which `length` is a number of people's size.
Unit unit_for(bool metres, double length) {
    if (!metres) return {"cells", "cell", 1};
    if (length >= 1e-3) return {"mm", "mm", 1e3};
    if (length >= 1e-6) return {"µm", "um", 1e6};
    return {"nm", "nm", 1e9};
}

const char* one(const Unit& unit) {
    return std::string_view(unit.name) == "cells" ? "cell" : unit.name;
}

struct Line {
    std::vector<double> x, z;  ///< in units of the surface
    double at = 0;
};

Line line_of(const Heightfield& surface, const PlotSettings& settings) {
    const bool along_x = settings.line == ProfileLine::X;
    const int count = along_x ? surface.nx : surface.ny, lines = along_x ? surface.ny : surface.nx;
    const int at = static_cast<int>(std::lround(settings.line_at * (lines - 1)));
    Line line;
    line.at = at * (along_x ? surface.dy : surface.dx);
    for (int k = 0; k < count; ++k) {
        line.x.push_back(k * (along_x ? surface.dx : surface.dy));
        line.z.push_back(double{along_x ? surface.at(k, at) : surface.at(at, k)});
    }
    // About their mean: heights have no other zero
    const double mean =
        std::accumulate(line.z.begin(), line.z.end(), 0.0) / static_cast<double>(line.z.size());
    for (double& z : line.z) z -= mean;
    return line;
}

CurveSet profile_set(const Unit& along, const Unit& up, const char* axis) {
    CurveSet set;
    set.x_name = axis;
    set.x_unit = fmt::format(" {}", along.name);
    set.x_column = fmt::format("{} [{}]", axis, along.in_table);
    set.y_name = "z";
    set.y_unit = up.name;
    set.height_share = 0.42;
    return set;
}

PlotCurve surface_curve(const PlotSubject& subject, int k, const std::string& quantity) {
    PlotCurve curve;
    curve.name = subject.name;
    curve.column = subject.name + ": " + quantity;
    curve.ink = series_ink(k);
    return curve;
}

/// Whole decades that hold the values above 0.
PlotAxis decades_axis(const CurveSet& set, const std::string& label) {
    double low = 0, high = 0;
    for (const PlotCurve& curve : set.curves)
        for (const double y : curve.y) {
            if (!(y > 0)) continue;
            low = low > 0 ? std::min(low, y) : y;
            high = std::max(high, y);
        }
    if (!(high > 0)) return {label, 0.1, 1, true};
    const double top = std::ceil(std::log10(high) - 1e-6);
    const double bottom =
        std::max(std::min(std::floor(std::log10(low) + 1e-6), top - 1), top - kMostDecades);
    return {label, std::pow(10, bottom), std::pow(10, top), true};
}

}  // namespace

PlotPointer normals_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    CurveSet set =
        normals_set(settings.title.empty() ? "Distribution of facet normals" : settings.title);
    for (const PlotSubject& subject : subjects) {
        const std::vector<double> density =
            normal_profile(*subject.surface, kNormalBins, run).density;
        set.curves.push_back(normals_curve(density, subject.name, subject.name + ": D [1/sr]",
                                           series_ink(static_cast<int>(set.curves.size()))));
    }
    const PlotAxis angle = normal_angles(set);
    PlotAxis values = value_axis(set, is_log(settings), settings.decades, "D  [sr⁻¹]");
    return std::make_shared<CurvePlot>(std::move(set), angle, std::move(values));
}

PlotPointer profile_figure(const Subjects& subjects, const PlotSettings& settings, Run&) {
    const bool metres = in_metres(subjects);
    const bool along_x = settings.line == ProfileLine::X;
    std::vector<Line> lines;
    double length = 0, highest = 0, lowest = 0;
    for (const PlotSubject& subject : subjects) {
        lines.push_back(line_of(*subject.surface, settings));
        length = std::max(length, lines.back().x.back());
        for (const double z : lines.back().z) {
            highest = std::max(highest, z);
            lowest = std::min(lowest, z);
        }
    }
    const Unit along = unit_for(metres, length), up = unit_for(metres, (highest - lowest) / 2);
    CurveSet set = profile_set(along, up, along_x ? "x" : "y");
    set.title = !settings.title.empty()
                    ? settings.title
                    : fmt::format("Profile along {} at {} = {} {}", along_x ? "x" : "y",
                                  along_x ? "y" : "x", value_text(lines.front().at * along.per),
                                  along.name);
    set.note = "Heights about the mean of the line";
    for (std::size_t k = 0; k < lines.size(); ++k) {
        PlotCurve curve =
            surface_curve(subjects[k], static_cast<int>(k), fmt::format("z [{}]", up.in_table));
        for (const double x : lines[k].x) curve.x.push_back(x * along.per);
        for (const double z : lines[k].z) curve.y.push_back(z * up.per);
        set.curves.push_back(std::move(curve));
    }
    PlotAxis x{fmt::format("{}  [{}]", along_x ? "x" : "y", along.name), 0, length * along.per};
    PlotAxis z = axis_between(lowest * up.per, highest * up.per);
    z.label = fmt::format("height  z  [{}]", up.name);
    return std::make_shared<CurvePlot>(std::move(set), std::move(x), std::move(z));
}

PlotPointer psd_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    const bool metres = in_metres(subjects);
    const Unit unit = unit_for(metres, 1e-6);
    CurveSet set;
    set.title = settings.title.empty() ? "Power spectral density of the heights" : settings.title;
    set.note = "Mean over all directions of the wave vector";
    set.x_name = "frequency";
    set.x_unit = fmt::format(" {}⁻¹", one(unit));
    set.x_column = fmt::format("frequency [1/{}]", unit.in_table);
    set.y_name = "PSD";
    set.y_unit = fmt::format("{}⁴", one(unit));
    double first = 0, last = 0;
    for (const PlotSubject& subject : subjects) {
        const SpectralDensity density = spectral_density(*subject.surface, run);
        PlotCurve curve = surface_curve(subject, static_cast<int>(set.curves.size()),
                                        fmt::format("PSD [{}^4]", unit.in_table));
        for (std::size_t k = 0; k < density.frequency.size(); ++k) {
            if (!(density.frequency[k] > 0)) continue;
            curve.x.push_back(density.frequency[k] / unit.per);
            curve.y.push_back(density.radial[k] * std::pow(unit.per, 4));
            first = first > 0 ? std::min(first, curve.x.back()) : curve.x.back();
            last = std::max(last, curve.x.back());
        }
        set.curves.push_back(std::move(curve));
    }
    if (!(last > first))
        throw Error(ErrorCode::InvalidInput, "a flat surface has no spectrum",
                    subjects.front().name);
    const bool log = is_log(settings);
    const std::string label = fmt::format("PSD  [{}⁴]", one(unit));
    PlotAxis x{fmt::format("spatial frequency  [{}⁻¹]", one(unit)), log ? first : 0, last, log};
    PlotAxis y = log ? decades_axis(set, label) : value_axis(set, false, settings.decades, label);
    return std::make_shared<CurvePlot>(std::move(set), std::move(x), std::move(y));
}

}  // namespace asperity::plots::detail

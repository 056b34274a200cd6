// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/make_ready.h>

#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/fill_missing.h>
#include <asperity/surface/gaussian_filter.h>
#include <asperity/surface/polynomial_form.h>
#include <asperity/surface/resample.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace asperity {

namespace {

[[noreturn]] void refuse(const char* setting, std::string why) {
    throw Error(ErrorCode::Usage, std::move(why), setting);
}

std::string length_in(const Topography& t, double length) {
    return t.unit == "m" ? length_text(length) : fmt::format("{:.6g} {}", length, t.unit);
}

std::string size_text(const Topography& t) {
    return length_in(t, t.nx * t.dx) + " x " + length_in(t, t.ny * t.dy);
}

double length_of(const Topography& t, const Length& length, const char* setting) {
    const auto value = in_unit(length, t.unit);
    if (!value)
        refuse(setting, fmt::format("'{}' has a unit and the topography, in units of a {}, has "
                                    "none: write a number alone",
                                    text_of(length), t.unit));
    return *value;
}

double percent(std::size_t part, std::size_t all) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

std::string points(std::size_t count) {
    return count == 1 ? "1 point" : fmt::format("{} points", count);
}

void find_outliers(Topography& t, double sigma, const std::string& where, const Run& run) {
    if (sigma == 0) return;
    const std::size_t found = mark_outliers(t, sigma, run);
    if (t.missing_count() == t.heights.size())
        throw Error(ErrorCode::InvalidInput, "nothing is left but outliers", where);
    t.did(
        fmt::format("{} further than {:.6g} deviations from the median around them taken "
                    "for outliers",
                    points(found), sigma));
}

// `measured`: how many points were missing before outliers were looked for.
void fill(Topography& t, Fill fill, std::size_t unmeasured, const std::string& where,
          const Run& run) {
    const std::size_t gone = t.missing_count(), all = t.heights.size();
    if (gone == 0) return;
    if (unmeasured == all) throw Error(ErrorCode::InvalidInput, "no point was measured", where);
    const std::string missing = fmt::format("{} of {} points are missing ({:.3g} %)", unmeasured,
                                            all, percent(unmeasured, all));
    if (fill == Fill::None)
        throw Error(ErrorCode::InvalidInput,
                    unmeasured > 0 ? missing + ": --fill nearest or smooth fills them"
                                   : "outliers are to be filled: --fill nearest or smooth does it",
                    where);
    // What was made before had all its points
    if (fill == Fill::Auto && t.ours)
        throw Error(ErrorCode::InvalidInput,
                    missing + ", where none should be: --fill smooth or nearest fills them", where);
    if (fill == Fill::Auto && percent(unmeasured, all) > 100 * kMostFilled)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{}, more than the {:.3g} % that are filled unasked: --fill smooth "
                                "or nearest fills all",
                                missing, 100 * kMostFilled),
                    where);
    if (fill == Fill::Nearest)
        fill_nearest(t);
    else
        fill_smooth(t, run);
    t.did(fmt::format("{} ({:.3g} %) filled {}", points(gone), percent(gone, all),
                      fill == Fill::Nearest ? "with the nearest height" : "smoothly"));
}

// By how much the surface rises over its width and height.
std::string tilt_text(const Slope& slope) {
    return fmt::format("a tilt of {:.4g} mrad", 1000 * std::atan(std::hypot(slope.x, slope.y)));
}

void subtract(Topography& t, const PolynomialForm& form, const Run& run) {
    for_blocks(t.ny, 16, run, [&](int first, int last) {
        for (int j = first; j < last; ++j)
            for (int i = 0; i < t.nx; ++i)
                t.heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(t.nx) +
                          static_cast<std::size_t>(i)] -= form.at(i, j);
    });
}

// A surface without unit keeps its tilt; who reads should hear of one that stands out.
void warn_of_tilt(Topography& t, const Run& run) {
    if (t.ours) return;
    const PolynomialForm plane(t, 1, run);
    const Slope slope = plane.slope();
    const double rise = std::hypot(slope.x * t.nx * t.dx, slope.y * t.ny * t.dy);
    double squares = 0;
    for (int j = 0; j < t.ny; ++j)
        for (int i = 0; i < t.nx; ++i) {
            const double h =
                t.heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(t.nx) +
                          static_cast<std::size_t>(i)] -
                plane.at(i, j);
            squares += h * h;
        }
    const double rms = std::sqrt(squares / static_cast<double>(t.heights.size()));
    if (rise > rms && rise > 0)
        t.did(
            fmt::format("not levelled, as the file has no unit of length: {} stays (--level "
                        "plane takes it off)",
                        tilt_text(slope)));
}

void level(Topography& t, Level wish, const Run& run) {
    const bool unasked = wish == Level::Auto;
    if (unasked) wish = is_measurement(t) ? Level::Plane : Level::None;
    if (wish == Level::None) return unasked ? warn_of_tilt(t, run) : t.did("not levelled");
    const int order = static_cast<int>(wish) - static_cast<int>(Level::Mean);
    const PolynomialForm form(t, order, run);
    subtract(t, form, run);
    const char* const by = unasked ? " (the default of --level for a measurement)" : "";
    if (order == 0)
        t.did(fmt::format("the mean of {:.6g} {} taken off", form.at(0, 0), t.unit));
    else if (order == 1)
        t.did(fmt::format("the mean plane taken off, {}{}", tilt_text(form.slope()), by));
    else
        t.did(fmt::format("a form of order {} taken off, with {} in the middle", order,
                          tilt_text(form.slope())));
}

double cutoff_of(const Topography& t, const Length& length, const char* setting) {
    const double cutoff = length_of(t, length, setting);
    if (cutoff < 2 * std::max(t.dx, t.dy))
        refuse(setting,
               fmt::format(
                   "a cut-off of {} is shorter than two samples ({}){}", length_in(t, cutoff),
                   length_in(t, 2 * std::max(t.dx, t.dy)),
                   length.unit.empty() && t.unit == "m" ? ": write its unit, as in 2.5um" : ""));
    if (cutoff > std::min(t.nx * t.dx, t.ny * t.dy))
        refuse(setting,
               fmt::format(
                   "a cut-off of {} is longer than the surface ({}){}", length_in(t, cutoff),
                   size_text(t),
                   length.unit.empty() && t.unit == "m" ? ": write its unit, as in 2.5um" : ""));
    return cutoff;
}

void filter(Topography& t, const Preparation& how, const Run& run) {
    const auto smooth = [&](std::vector<double>& heights, double cutoff) {
        gaussian_low_pass(heights, t.nx, t.ny, t.dx, t.dy, cutoff, t.boundary, run);
    };
    const double shortest = how.filter_s ? cutoff_of(t, *how.filter_s, "filter-s") : 0;
    const double longest = how.filter_l ? cutoff_of(t, *how.filter_l, "filter-l") : 0;
    if (how.filter_s && how.filter_l && longest <= shortest)
        refuse("filter-l", fmt::format("a cut-off of {} leaves nothing beside filter-s {}",
                                       length_in(t, longest), length_in(t, shortest)));
    if (how.filter_s) {
        smooth(t.heights, shortest);
        t.did("S-filter, Gaussian, cut-off " + length_in(t, shortest));
    }
    if (how.filter_l) {
        std::vector<double> waviness = t.heights;
        smooth(waviness, longest);
        for (std::size_t k = 0; k < waviness.size(); ++k) t.heights[k] -= waviness[k];
        t.did("L-filter, Gaussian, cut-off " + length_in(t, longest));
    }
}

// The samples whose middles lie between two places.
struct Span {
    int first = 0, count = 0;
};

Span span_of(double from, double length, double step, int n) {
    const double first = std::ceil(from / step - 0.5 - 1e-9);
    const double end = std::ceil((from + length) / step - 0.5 - 1e-9);
    const double low = std::clamp(first, 0.0, static_cast<double>(n));
    return {static_cast<int>(low),
            static_cast<int>(std::clamp(end, low, static_cast<double>(n)) - low)};
}

void crop_to(Topography& t, const Crop& crop_box) {
    const double x = length_of(t, crop_box.x, "crop"), y = length_of(t, crop_box.y, "crop");
    const double width = length_of(t, crop_box.width, "crop"),
                 height = length_of(t, crop_box.height, "crop");
    const double spare_x = 0.5 * t.dx, spare_y = 0.5 * t.dy;
    if (x < 0 || y < 0 || x + width > t.nx * t.dx + spare_x || y + height > t.ny * t.dy + spare_y)
        refuse("crop", fmt::format("a part of {} x {} at {}, {} does not lie in a surface of {}",
                                   length_in(t, width), length_in(t, height), length_in(t, x),
                                   length_in(t, y), size_text(t)));
    const Span columns = span_of(x, width, t.dx, t.nx), rows = span_of(y, height, t.dy, t.ny);
    if (columns.count < 2 || rows.count < 2)
        refuse("crop", fmt::format("a part of {} x {} has less than 2 x 2 samples of {} x {}",
                                   length_in(t, width), length_in(t, height), length_in(t, t.dx),
                                   length_in(t, t.dy)));
    crop(t, columns.first, rows.first, columns.count, rows.count);
    t.did(fmt::format("cropped to {} x {} samples from column {}, row {} on", columns.count,
                      rows.count, columns.first, rows.first));
}

void resample_to(Topography& t, int columns) {
    const double rows = std::max(2.0, std::round(static_cast<double>(columns) * t.ny / t.nx));
    if (rows > kMaxSurfaceSide)
        refuse("resample", fmt::format("{} columns make {:.0f} rows, {} are allowed", columns, rows,
                                       kMaxSurfaceSide));
    const int from_x = t.nx, from_y = t.ny;
    resample(t, columns, static_cast<int>(rows));
    t.did(fmt::format("resampled from {} x {} to {} x {} samples of {} x {}", from_x, from_y, t.nx,
                      t.ny, length_in(t, t.dx), length_in(t, t.dy)));
}

}  // namespace

void make_ready(Topography& topography, const Preparation& how, const std::string& where,
                const Run& run) {
    const std::size_t unmeasured = topography.missing_count();
    find_outliers(topography, how.outliers, where, run);
    fill(topography, how.fill, unmeasured, where, run);
    level(topography, how.level, run);
    filter(topography, how, run);
    if (how.crop) crop_to(topography, *how.crop);
    if (how.resample > 0) resample_to(topography, static_cast<int>(how.resample));
    topography.missing.clear();
}

}  // namespace asperity

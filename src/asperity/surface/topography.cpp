// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/topography.h>

#include <asperity/core/error.h>
#include <asperity/surface/make_ready.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asperity {
namespace {

// An offset this many times the range of the heights costs floats digits that matter.
constexpr double kFarOffset = 8;

void append(std::string& text, const std::string& what) {
    text += (text.empty() ? "" : "; ") + what;
}

bool fits_float(double value) {
    return static_cast<double>(static_cast<float>(value)) == value;
}

// The mean, when the heights lie far from zero and floats cannot hold them as they stand.
double offset_to_remove(const std::vector<double>& heights) {
    if (std::all_of(heights.begin(), heights.end(), fits_float)) return 0;
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    if (std::max(std::abs(*low), std::abs(*high)) <= kFarOffset * (*high - *low)) return 0;
    double sum = 0;
    for (const double h : heights) sum += h - *low;
    const double mean = *low + sum / static_cast<double>(heights.size());
    return std::isfinite(mean) ? mean : 0;
}

}  // namespace

std::size_t Topography::missing_count() const {
    return static_cast<std::size_t>(std::count(missing.begin(), missing.end(), 1));
}

void Topography::mark_missing(std::size_t sample) {
    if (missing.empty()) missing.resize(heights.size());
    missing[sample] = 1;
}

void Topography::note(const std::string& what) {
    append(found, what);
}

void Topography::assume(const std::string& what) {
    append(assumed, what);
}

void Topography::did(const std::string& what) {
    append(prepared, what);
}

std::string describe(const Topography& topography) {
    std::string text = topography.found;
    if (const std::size_t gone = topography.missing_count())
        append(text, fmt::format("{} of {} points missing", gone, topography.heights.size()));
    if (!topography.assumed.empty()) append(text, "assumed: " + topography.assumed);
    return text;
}

bool is_measurement(const Topography& topography) {
    return metres_per(topography.unit) > 0 && !topography.ours;
}

Heightfield prepare(Topography topography, const Preparation& how, const std::string& where,
                    const Run& run) {
    if (topography.dx == 0 || topography.dy == 0)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("the heights are in {}, but nothing in the file says how far apart "
                                "the samples are: --cell-size in {} decides",
                                topography.unit, topography.unit),
                    where);
    for (const double step : {topography.dx, topography.dy})
        if (!(step >= kLeastSpacing && step <= kMostSpacing))
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("cell size {} x {} must be {} to {}", topography.dx,
                                    topography.dy, kLeastSpacing, kMostSpacing),
                        where);
    Heightfield surface;
    surface.source = describe(topography);
    make_ready(topography, how, where, run);
    const double offset = offset_to_remove(topography.heights);
    if (offset != 0)
        topography.did(
            fmt::format("heights counted from their mean of {:.9g} {}", offset, topography.unit));

    surface.nx = topography.nx, surface.ny = topography.ny;
    surface.dx = topography.dx, surface.dy = topography.dy;
    surface.boundary = topography.boundary;
    surface.diagonal = topography.diagonal;
    surface.isotropic = topography.isotropic;
    surface.unit = topography.unit;
    surface.name = topography.name.empty() ? where : topography.name;
    surface.prepared = topography.prepared;
    surface.heights.reserve(topography.heights.size());
    for (const double h : topography.heights)
        surface.heights.push_back(static_cast<float>(h - offset));
    validate(surface, where);
    return surface;
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/topography.h>

#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    return *low + sum / static_cast<double>(heights.size());
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

std::string describe(const Topography& topography) {
    std::string text = topography.found;
    if (const std::size_t gone = topography.missing_count())
        append(text, fmt::format("{} of {} points missing", gone, topography.heights.size()));
    if (!topography.assumed.empty()) append(text, "assumed: " + topography.assumed);
    return text;
}

Heightfield prepare(Topography topography, const std::string& where) {
    if (const std::size_t gone = topography.missing_count())
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} of {} points are missing ({:.3g} %), and filling them (--fill) "
                                "is not there yet",
                                gone, topography.heights.size(),
                                100.0 * static_cast<double>(gone) /
                                    static_cast<double>(topography.heights.size())),
                    where);
    if (topography.dx == 0 || topography.dy == 0)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("the heights are in {}, but nothing in the file says how far apart "
                                "the samples are: --cell-size in {} decides",
                                topography.unit, topography.unit),
                    where);
    const double offset = offset_to_remove(topography.heights);
    if (offset != 0 && std::isfinite(offset))
        topography.note(
            fmt::format("heights counted from their mean of {:.9g} {}", offset, topography.unit));

    Heightfield surface;
    surface.nx = topography.nx, surface.ny = topography.ny;
    surface.dx = topography.dx, surface.dy = topography.dy;
    surface.boundary = topography.boundary;
    surface.diagonal = topography.diagonal;
    surface.isotropic = topography.isotropic;
    surface.unit = topography.unit;
    surface.name = topography.name.empty() ? where : topography.name;
    surface.source = describe(topography);
    surface.heights.reserve(topography.heights.size());
    for (const double h : topography.heights) {
        const double height = h - (std::isfinite(offset) ? offset : 0.0);
        surface.heights.push_back(static_cast<float>(height));
    }
    validate(surface, where);
    return surface;
}

}  // namespace asperity

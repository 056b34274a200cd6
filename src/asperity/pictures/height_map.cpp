// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/height_map.h>

#include <asperity/core/length.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::io {

namespace {

template <class Number>
void find_range(HeightMap& map, std::vector<Number> measured) {
    if (measured.empty()) return;
    const auto spare = static_cast<std::ptrdiff_t>(measured.size() / 1000);
    std::nth_element(measured.begin(), measured.begin() + spare, measured.end());
    map.low = static_cast<double>(measured[static_cast<std::size_t>(spare)]);
    std::nth_element(measured.begin(), measured.end() - 1 - spare, measured.end());
    map.high = static_cast<double>(measured[measured.size() - 1 - static_cast<std::size_t>(spare)]);
}

/// `at(sample)` gives heights; `surface` has nx, ny, dx, dy, unit.
template <class Surface, class At>
HeightMap map_of(const Surface& surface, int side, const At& at) {
    HeightMap map;
    map.nx = surface.nx;
    map.ny = surface.ny;
    map.size_x = surface.nx * surface.dx;
    map.size_y = surface.ny * surface.dy;
    map.unit = surface.unit;
    // A file may not say how far apart its samples are
    const double x = map.size_x > 0 ? map.size_x : map.nx, y = map.size_y > 0 ? map.size_y : map.ny;
    const double scale = side / std::max(x, y);
    map.width = std::max(1, static_cast<int>(std::lround(x * scale)));
    map.height = std::max(1, static_cast<int>(std::lround(y * scale)));
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const auto i = static_cast<std::size_t>((column + 0.5) * map.nx / map.width);
            const auto j = static_cast<std::size_t>((row + 0.5) * map.ny / map.height);
            map.heights.push_back(at(j * static_cast<std::size_t>(map.nx) + i));
        }
    return map;
}

}  // namespace

double HeightMap::position(float value) const {
    const double range = high - low;
    return range > 0 ? std::clamp((static_cast<double>(value) - low) / range, 0.0, 1.0) : 0.5;
}

std::string HeightMap::length(double value) const {
    return unit == "m" ? length_text(value) : fmt::format("{:.4g} {}", value, unit);
}

std::string HeightMap::caption() const {
    return fmt::format("{} × {} samples · {} × {}", nx, ny, length(size_x), length(size_y));
}

HeightMap height_map(const Topography& t, int side) {
    const auto is_missing = [&](std::size_t k) { return !t.missing.empty() && t.missing[k] == 1; };
    HeightMap map = map_of(t, side, [&](std::size_t k) {
        return is_missing(k) ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>(t.heights[k]);
    });
    std::vector<double> measured;
    measured.reserve(t.heights.size());
    for (std::size_t k = 0; k < t.heights.size(); ++k)
        if (!is_missing(k) && !std::isnan(t.heights[k])) measured.push_back(t.heights[k]);
    find_range(map, std::move(measured));
    return map;
}

HeightMap height_map(const Heightfield& surface, int side) {
    HeightMap map = map_of(surface, side, [&](std::size_t k) { return surface.heights[k]; });
    find_range(map, std::vector<float>(surface.heights.begin(), surface.heights.end()));
    return map;
}

}  // namespace asperity::io

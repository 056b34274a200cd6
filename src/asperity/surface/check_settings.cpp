// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/check_settings.h>

#include <asperity/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

[[noreturn]] void fail(const char* setting, std::string why) {
    throw Error(ErrorCode::Usage, std::move(why), setting);
}

void check_range(const char* setting, double value, double low, double high) {
    if (!(value >= low && value <= high))
        fail(setting, fmt::format("{} is not in {} .. {}", value, low, high));
}

void check_ranges(const SurfaceSettings& s) {
    if (s.size < 2 || s.size > kMaxSurfaceSide)
        fail("size", fmt::format("{} is not in 2 .. {}", s.size, kMaxSurfaceSide));
    check_range("roughness", s.roughness, 0, 1);
    for (const double alpha : {s.alpha_x, s.alpha_y}) check_range("alpha", alpha, 1e-4, 100);
    for (const double length : {s.correlation_x, s.correlation_y})
        check_range("correlation-length", length, 0.1, kMaxSurfaceSide);
    if (!(s.hurst > 0 && s.hurst <= 1))
        fail("hurst", fmt::format("{} is not above 0 and at most 1", s.hurst));
    check_range("max-slope", s.max_slope, 0.01, 1e6);
    if (!(s.tilt_deg >= 0 && s.tilt_deg < 90))
        fail("tilt", fmt::format("{} is not at least 0 and below 90 degrees", s.tilt_deg));
    if (s.period < 2 || s.period > kMaxSurfaceSide)
        fail("period", fmt::format("{} is not in 2 .. {}", s.period, kMaxSurfaceSide));
    check_range("amplitude", s.amplitude, 0, 1e6);
    for (const auto& cell : {s.cell_x, s.cell_y})
        check_range("cell-size", cell.value_or(1), 1e-15, 1e15);
    const CellSize cell = cell_size(s);
    if (cell.y > 100 * cell.x || cell.x > 100 * cell.y)
        fail("cell-size",
             fmt::format("sides of {} and {} differ by more than 100 times", cell.x, cell.y));
    if (!(std::abs(s.height_scale) >= 1e-9 && std::abs(s.height_scale) <= 1e9))
        fail("height-scale",
             fmt::format("the magnitude of {} is not in 1e-09 .. 1e+09", s.height_scale));
}

/// Random fields: the correlation lengths must fit on the tile.
void check_correlation(const SurfaceSettings& s) {
    const CellSize cell = cell_size(s);
    const double side_x = s.size, side_y = s.size * cell.y / cell.x;
    if (s.correlation_x > side_x)
        fail("correlation-length",
             fmt::format("{} cells are longer than the tile, {} cells", s.correlation_x, side_x));
    if (s.correlation_y > side_y)
        fail("correlation-length",
             fmt::format("{} cells along y are longer than the tile, {} cells", s.correlation_y,
                         side_y));
}

void check_ggx(const SurfaceSettings& s) {
    if (s.correlation_x != s.correlation_y)
        fail("correlation-length",
             "ggx takes one length; the one along y follows from the ratio of the alphas");
    if (s.max_slope <= std::max(s.alpha_x, s.alpha_y))
        fail("max-slope",
             fmt::format("{} is not above alpha, {}", s.max_slope, std::max(s.alpha_x, s.alpha_y)));
}

void check_period(const SurfaceSettings& s) {
    if (s.size % s.period != 0)
        fail("period", fmt::format("{} does not divide the size, {}", s.period, s.size));
    const bool ridge = s.kind == SurfaceKind::VGroove || s.kind == SurfaceKind::Pyramids;
    if (ridge && s.period % 2 != 0)
        fail("period",
             fmt::format("{} is odd: the ridge would fall between two samples", s.period));
    const bool wave = s.kind == SurfaceKind::Sinusoid || s.kind == SurfaceKind::Eggcrate;
    if (wave && s.period < 4)
        fail("period", fmt::format("a wave needs at least 4 cells, not {}", s.period));
}

}  // namespace

CellSize cell_size(const SurfaceSettings& s) {
    return {s.cell_x.value_or(s.cell_y.value_or(1)), s.cell_y.value_or(s.cell_x.value_or(1))};
}

void check_settings(const SurfaceSettings& s) {
    check_ranges(s);
    switch (s.kind) {
        case SurfaceKind::Gaussian:
            check_correlation(s);
            break;
        case SurfaceKind::Ggx:
            check_ggx(s);
            check_correlation(s);
            break;
        case SurfaceKind::VGroove:
        case SurfaceKind::Sawtooth:
        case SurfaceKind::Pyramids:
        case SurfaceKind::Sinusoid:
        case SurfaceKind::Eggcrate:
            check_period(s);
            break;
        case SurfaceKind::Thesis:
        case SurfaceKind::Flat:
        case SurfaceKind::Tilted:
            break;
        case SurfaceKind::File:
            fail("surface", "a surface file is read, not made");
    }
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/launch.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t kRowsOfBand = 8;

std::uint64_t to_fixed(double fraction) {
    return static_cast<std::uint64_t>(std::ldexp(fraction, 64));
}

/// Cell of a coordinate of the tile, and the position inside it, exactly.
std::int32_t split(std::uint64_t coordinate, std::uint32_t cells, double& inside) {
    const Wide scaled = Wide{coordinate} * cells;
    inside = to_unit(static_cast<std::uint64_t>(scaled));
    return static_cast<std::int32_t>(scaled >> 64);
}

}  // namespace

double to_unit(std::uint64_t fixed) {
    return static_cast<double>(fixed >> 11) * 0x1p-53;
}

LaunchBatch::LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                         const BatchRequest& request)
    : incidence_(incidence),
      pattern_(request.pattern),
      random_(request),
      rays_(request.rays),
      shift_{random_.shift()[0], random_.shift()[1]},
      cells_x_(static_cast<std::uint32_t>(surface.cells_x())),
      cells_y_(static_cast<std::uint32_t>(surface.cells_y())),
      height_(height),
      sin_theta_(std::sin(incidence.theta)),
      cos_theta_(std::cos(incidence.theta)),
      sin_phi_(std::sin(incidence.phi)),
      cos_phi_(std::cos(incidence.phi)) {
    if (pattern_ == LaunchPattern::LowDiscrepancy) {
        rows_ = (rays_ + cells_x_ - 1) / cells_x_;
        first_cell_ = static_cast<std::uint32_t>((Wide{random_.first_cell()[0]} * cells_x_) >> 64);
    } else {
        // So that the spacing of the strata is alike in x and y
        const double n = static_cast<double>(rays_);
        const double width = cells_x_ * surface.dx, depth = cells_y_ * surface.dy;
        const double rows = std::clamp(std::round(std::sqrt(n * depth / width)), 1.0, n);
        rows_ = static_cast<std::uint64_t>(rows);
    }
}

LaunchRow LaunchBatch::row(std::uint64_t r) const {
    LaunchRow row;
    row.count = row_begin(r + 1) - row_begin(r);
    // Rows are as far apart as each other, or in bands that are
    std::uint64_t y = static_cast<std::uint64_t>((Wide{r} << 64) / rows_);
    if (rows_ * kMostCellsPerRay < cells_y_) {
        const std::uint64_t bands = (rows_ + kRowsOfBand - 1) / kRowsOfBand;
        y = static_cast<std::uint64_t>((Wide{r / kRowsOfBand} << 64) / bands) +
            static_cast<std::uint64_t>((Wide{r % kRowsOfBand * kMostCellsPerRay} << 64) / cells_y_);
    }
    row.j = split(y + shift_.y, cells_y_, row.v);
    // The golden ratio of a cell from row to row; a row shorter than the tile begins elsewhere, too
    row.u = to_unit(shift_.x + r * kGoldenRatio);
    const std::uint64_t golden_cell =
        static_cast<std::uint64_t>((Wide{r * kGoldenRatio} * cells_x_) >> 64);
    row.i = static_cast<std::int32_t>((first_cell_ + golden_cell) % cells_x_);
    return row;
}

TorusPoint LaunchBatch::stratified_point(std::uint64_t k) const {
    // Row `row` holds the points [begin, end) and that share of the tile's depth: strata are equal.
    const std::uint64_t row = k * rows_ / rays_;
    const std::uint64_t begin = row_begin(row), count = row_begin(row + 1) - begin;
    const auto xi = random_.position(k);
    const double x = (static_cast<double>(k - begin) + xi[0]) / static_cast<double>(count);
    const double y = (static_cast<double>(begin) + xi[1] * static_cast<double>(count)) /
                     static_cast<double>(rays_);
    const double below_one = std::nextafter(1.0, 0.0);
    return {to_fixed(std::min(x, below_one)), to_fixed(std::min(y, below_one))};
}

TorusPoint LaunchBatch::random_point(std::uint64_t k) const {
    const auto bits = random_.bits(k);
    return {bits[0], bits[1]};
}

Launch LaunchBatch::launch(std::uint64_t k) const {
    Launch l;
    if (pattern_ == LaunchPattern::LowDiscrepancy) {
        const std::uint64_t r = k * rows_ / rays_;
        const LaunchRow start = row(r);
        l.ray.i = static_cast<std::int32_t>(
            (static_cast<std::uint64_t>(start.i) + k - row_begin(r)) % cells_x_);
        l.ray.j = start.j;
        l.ray.u = start.u;
        l.ray.v = start.v;
    } else {
        const TorusPoint p =
            pattern_ == LaunchPattern::Stratified ? stratified_point(k) : random_point(k);
        l.ray.i = split(p.x, cells_x_, l.ray.u);
        l.ray.j = split(p.y, cells_y_, l.ray.v);
    }
    l.ray.z = height_;
    l.phi_i = incidence_.phi;
    l.sin_phi_i = sin_phi_;
    l.cos_phi_i = cos_phi_;
    if (incidence_.isotropic) {
        l.phi_i = 2 * kPi * random_.azimuth(k);
        l.sin_phi_i = std::sin(l.phi_i);
        l.cos_phi_i = std::cos(l.phi_i);
    }
    // As from_spherical, but for what is the same for all rays
    l.ray.direction = -Vec3{sin_theta_ * l.cos_phi_i, sin_theta_ * l.sin_phi_i, cos_theta_};
    return l;
}

}  // namespace asperity

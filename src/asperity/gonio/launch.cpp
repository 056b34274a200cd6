// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/launch.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

__extension__ using Wide = unsigned __int128;

/// What a random number is for: the fourth word of the counter.
enum Dimension : std::uint32_t { kPosition, kAzimuth, kShift };

/// Batches are told apart in the upper bits of the counter's index; a batch has fewer rays.
constexpr int kBatchShift = 40;

std::uint64_t to_fixed(double fraction) {
    return static_cast<std::uint64_t>(std::ldexp(fraction, 64));
}

double to_unit(std::uint64_t fixed) {
    return static_cast<double>(fixed >> 11) * 0x1p-53;
}

/// Cell of a coordinate of the tile, and the position inside it, exactly.
std::int32_t split(std::uint64_t coordinate, std::uint32_t cells, double& inside) {
    const Wide scaled = Wide{coordinate} * cells;
    inside = to_unit(static_cast<std::uint64_t>(scaled));
    return static_cast<std::int32_t>(scaled >> 64);
}

}  // namespace

std::vector<Incidence> incidences(const IlluminationSettings& s) {
    std::vector<Incidence> list;
    const auto add = [&](int number, double theta_deg, double phi_deg) {
        list.push_back(
            {number, radians(theta_deg), s.isotropic ? 0.0 : radians(phi_deg), s.isotropic});
    };
    if (s.theta_deg.empty()) {
        // Thesis layers by elevation: the last one, normal incidence, is filled first
        for (int k = s.layers; k >= 1; --k)
            for (const double phi : s.phi_deg) add(k, 90.0 * (s.layers - k) / s.layers, phi);
    } else {
        int number = 1;
        for (const double theta : s.theta_deg)
            for (const double phi : s.phi_deg) add(number++, theta, phi);
    }
    return list;
}

LaunchBatch::LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                         LaunchPattern pattern, std::uint64_t rays, std::uint64_t seed,
                         std::uint32_t stream, std::uint32_t index)
    : incidence_(incidence),
      pattern_(pattern),
      random_(seed, stream),
      rays_(rays),
      first_(std::uint64_t{index} << kBatchShift),
      cells_x_(static_cast<std::uint32_t>(surface.cells_x())),
      cells_y_(static_cast<std::uint32_t>(surface.cells_y())),
      height_(height) {
    const double n = static_cast<double>(rays);
    const double width = cells_x_ * surface.dx, depth = cells_y_ * surface.dy;
    const double rows = std::clamp(std::round(std::sqrt(n * depth / width)), 1.0, n);
    rows_ = static_cast<std::uint64_t>(rows);
    // Lattice: point k stands at x = k / (columns + golden ratio), y = k / n. Each sweep over x is
    // one row of points, shifted against the row before by the golden ratio of their spacing.
    const double columns = std::floor(n / rows);
    step_ = {to_fixed(1.0 / (columns + std::numbers::phi - 1)),
             static_cast<std::uint64_t>((Wide{1} << 64) / rays - (rays == 1 ? 1 : 0))};
    const auto shift = random_.bits64(first_, kShift);
    shift_ = {shift[0], shift[1]};
}

LaunchBatch::Point LaunchBatch::lattice_point(std::uint64_t k) const {
    return {k * step_.x + shift_.x, k * step_.y + shift_.y};  // modulo 1, by wrap-around
}

LaunchBatch::Point LaunchBatch::stratified_point(std::uint64_t k) const {
    // Row `row` holds the points [begin, end) and that share of the tile's depth: strata are equal.
    const auto row_begin = [&](std::uint64_t row) { return (row * rays_ + rows_ - 1) / rows_; };
    const std::uint64_t row = k * rows_ / rays_;
    const std::uint64_t begin = row_begin(row), count = row_begin(row + 1) - begin;
    const auto xi = random_.uniform2(first_ + k, kPosition);
    const double x = (static_cast<double>(k - begin) + xi[0]) / static_cast<double>(count);
    const double y = (static_cast<double>(begin) + xi[1] * static_cast<double>(count)) /
                     static_cast<double>(rays_);
    const double below_one = std::nextafter(1.0, 0.0);
    return {to_fixed(std::min(x, below_one)), to_fixed(std::min(y, below_one))};
}

LaunchBatch::Point LaunchBatch::random_point(std::uint64_t k) const {
    const auto bits = random_.bits64(first_ + k, kPosition);
    return {bits[0], bits[1]};
}

Launch LaunchBatch::launch(std::uint64_t k) const {
    const Point p = pattern_ == LaunchPattern::LowDiscrepancy ? lattice_point(k)
                    : pattern_ == LaunchPattern::Stratified   ? stratified_point(k)
                                                              : random_point(k);
    Launch l;
    l.ray.i = split(p.x, cells_x_, l.ray.u);
    l.ray.j = split(p.y, cells_y_, l.ray.v);
    l.ray.z = height_;
    l.phi_i =
        incidence_.isotropic ? 2 * kPi * random_.uniform2(first_ + k, kAzimuth)[0] : incidence_.phi;
    l.ray.direction = -from_spherical(incidence_.theta, l.phi_i);
    return l;
}

}  // namespace asperity

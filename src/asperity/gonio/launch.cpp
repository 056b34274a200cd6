// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/launch.h>

#include <asperity/core/directions.h>
#include <asperity/tracing/scale.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {

namespace {

__extension__ using Wide = unsigned __int128;

/// What a random number is for: the fourth word of the counter.
enum Dimension : std::uint32_t { kPosition, kAzimuth, kShift, kFirstCell };

/// Batches are told apart in the upper bits of the counter's index; a batch has fewer rays.
constexpr int kBatchShift = 40;

/// Where a batch has fewer rays than one for so many cells, it leaves parts of the tile out: what
/// rays see of the surface is then still in the cache when the next ones come.
constexpr std::uint64_t kMostCellsPerRay = 4;
constexpr std::uint64_t kRowsOfBand = 8;

/// Cells a pass over the tile has for a ray, at most so many passes: lines of one pass lie a whole
/// cell beside each other, so many rays are better put on more lines.
constexpr std::uint64_t kCellsPerRayOfPass = 2, kMostPasses = 8;

/// Whether lines come again and again through the same places of the cells, as along an axis or a
/// diagonal: `slope` cells aside for each of `cells` along.
bool keeps_place(double slope, double cells) {
    for (double period = 1; period <= 4; ++period) {
        const double aside = slope * period;
        if (std::abs(aside - std::round(aside)) * cells < period) return true;
    }
    return false;
}

/// (sqrt(5) - 1) / 2 in units of 2^-64.
constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15u;

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
        const double theta = radians(theta_deg);
        list.push_back({number, theta < kStraightDown ? 0.0 : theta,
                        s.isotropic ? 0.0 : radians(phi_deg), s.isotropic});
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
      height_(height),
      sin_theta_(std::sin(incidence.theta)),
      cos_theta_(std::cos(incidence.theta)),
      sin_phi_(std::sin(incidence.phi)),
      cos_phi_(std::cos(incidence.phi)) {
    const auto shift = random_.bits64(first_, kShift);
    shift_ = {shift[0], shift[1]};
    if (pattern == LaunchPattern::LowDiscrepancy) {
        rows_ = (rays + cells_x_ - 1) / cells_x_;
        first_cell_ = static_cast<std::uint32_t>(
            (Wide{random_.bits64(first_, kFirstCell)[0]} * cells_x_) >> 64);
        if (surface.boundary == Boundary::Periodic && !incidence.isotropic) {
            const Vec3 d = from_spherical(incidence.theta, incidence.phi);
            order_ = d.x == 0 && d.y == 0 ? Order::Rows : Order::Lines;
            if (order_ == Order::Lines) lay_out_lines(surface);
        }
    } else {
        // So that the spacing of the strata is alike in x and y
        const double n = static_cast<double>(rays);
        const double width = cells_x_ * surface.dx, depth = cells_y_ * surface.dy;
        const double rows = std::clamp(std::round(std::sqrt(n * depth / width)), 1.0, n);
        rows_ = static_cast<std::uint64_t>(rows);
    }
}

void LaunchBatch::lay_out_lines(const Heightfield& surface) {
    const Vec3 d = from_spherical(incidence_.theta, incidence_.phi);
    const double per_x = std::abs(d.x) / surface.dx, per_y = std::abs(d.y) / surface.dy;
    const bool along_x = LaunchLine::along_x(d, surface.dx, surface.dy);
    cells_across_ = along_x ? cells_y_ : cells_x_;
    const std::uint64_t cells_along = along_x ? cells_x_ : cells_y_;
    fall_ = static_cast<double>(cells_along) * d.z / std::max(per_x, per_y);

    // All lines, or groups of them
    const std::uint64_t all = (cells_across_ + kLaunchGroup - 1) / kLaunchGroup;
    const std::uint64_t cells_of_stripe = kLaunchGroup * cells_along;
    stripes_of_pass_ =
        std::min((rays_ * kMostCellsPerRay + cells_of_stripe - 1) / cells_of_stripe, all);
    lines_of_pass_ = stripes_of_pass_ == all ? cells_across_ : stripes_of_pass_ * kLaunchGroup;
    const double slope = std::min(per_x, per_y) / std::max(per_x, per_y);
    const bool stays = keeps_place(slope, static_cast<double>(cells_along));
    passes_ = std::clamp<std::uint64_t>(kCellsPerRayOfPass * rays_ / (lines_of_pass_ * cells_along),
                                        stays ? 2 : 1, kMostPasses);
    const auto first = random_.bits64(first_, kFirstCell);
    first_cell_ = static_cast<std::uint32_t>((Wide{first[0]} * cells_across_) >> 64);
    first_share_ = first[1];
}

std::uint64_t LaunchBatch::line_begin(std::uint64_t line) const {
    const Wide share = ((Wide{line} * rays_) << 64) / (passes_ * lines_of_pass_);
    return static_cast<std::uint64_t>((share + first_share_) >> 64);
}

double LaunchBatch::offset(std::uint64_t s) const {
    const std::uint64_t pass = s / stripes_of_pass_;
    return to_unit(shift_.x + static_cast<std::uint64_t>((Wide{pass} << 64) / passes_));
}

LaunchStripe LaunchBatch::stripe(std::uint64_t s) const {
    LaunchStripe stripe;
    const std::uint64_t pass = s / stripes_of_pass_, of_pass = s % stripes_of_pass_;
    const std::uint64_t first_of_pass = pass * lines_of_pass_;
    const std::uint64_t begin = of_pass * kLaunchGroup,
                        end = std::min(begin + kLaunchGroup, lines_of_pass_);
    const std::uint64_t left_out = of_pass * (cells_across_ - lines_of_pass_) / stripes_of_pass_;
    stripe.first = static_cast<int>((first_cell_ + begin + left_out) % cells_across_);
    stripe.lines = static_cast<int>(end - begin);
    for (std::size_t k = 0; k < end - begin; ++k) {
        const std::uint64_t line = first_of_pass + begin + k;
        const std::uint64_t rays = line_begin(line + 1) - line_begin(line);
        stripe.rays[k] = static_cast<std::int32_t>(rays);
        // From line to line as they lie beside each other, those of other passes between them
        stripe.phase[k] = to_unit(shift_.y + ((begin + k) * passes_ + pass) * kGoldenRatio);
        stripe.spacing[k] = fall_ / static_cast<double>(std::max<std::uint64_t>(rays, 1));
    }
    for (std::size_t k = 0; k < kLaunchGroup; ++k) stripe.per_spacing[k] = stripe.rays[k] / fall_;
    for (float& shade : stripe.shade) shade = -std::numeric_limits<float>::infinity();
    return stripe;
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

LaunchBatch::Point LaunchBatch::stratified_point(std::uint64_t k) const {
    // Row `row` holds the points [begin, end) and that share of the tile's depth: strata are equal.
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
        const Point p =
            pattern_ == LaunchPattern::Stratified ? stratified_point(k) : random_point(k);
        l.ray.i = split(p.x, cells_x_, l.ray.u);
        l.ray.j = split(p.y, cells_y_, l.ray.v);
    }
    l.ray.z = height_;
    l.phi_i = incidence_.phi;
    l.sin_phi_i = sin_phi_;
    l.cos_phi_i = cos_phi_;
    if (incidence_.isotropic) {
        l.phi_i = 2 * kPi * random_.uniform2(first_ + k, kAzimuth)[0];
        l.sin_phi_i = std::sin(l.phi_i);
        l.cos_phi_i = std::cos(l.phi_i);
    }
    // As from_spherical, but for what is the same for all rays
    l.ray.direction = -Vec3{sin_theta_ * l.cos_phi_i, sin_theta_ * l.sin_phi_i, cos_theta_};
    return l;
}

}  // namespace asperity

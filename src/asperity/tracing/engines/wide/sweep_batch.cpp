// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/sweep_batch.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {

namespace {

__extension__ using Wide = unsigned __int128;

/// Whether lines come again and again through the same places of the cells, as along an axis or a
/// diagonal: `slope` cells aside for each of `cells` along.
bool keeps_place(double slope, double cells) {
    for (double period = 1; period <= 4; ++period) {
        const double aside = slope * period;
        if (std::abs(aside - std::round(aside)) * cells < period) return true;
    }
    return false;
}

/// Cells a pass over the tile has for a ray, at most so many passes: lines of one pass lie a whole
/// cell beside each other, so many rays are better put on more lines.
constexpr std::uint64_t kCellsPerRayOfPass = 2, kMostPasses = 8;

}  // namespace

bool SweepBatch::possible(const Heightfield& surface, const Incidence& incidence,
                          LaunchPattern pattern) {
    const Vec3 d = from_spherical(incidence.theta, incidence.phi);
    return pattern == LaunchPattern::LowDiscrepancy && surface.boundary == Boundary::Periodic &&
           !incidence.isotropic && (d.x != 0 || d.y != 0);
}

SweepBatch::SweepBatch(const Heightfield& surface, const Incidence& incidence,
                       const BatchRequest& request, std::uint64_t sweep)
    : rays_(request.rays) {
    const Vec3 d = from_spherical(incidence.theta, incidence.phi);
    const double per_x = std::abs(d.x) / surface.dx, per_y = std::abs(d.y) / surface.dy;
    const bool along_x = LaunchLine::along_x(d, surface.dx, surface.dy);
    const auto cells_x = static_cast<std::uint32_t>(surface.cells_x()),
               cells_y = static_cast<std::uint32_t>(surface.cells_y());
    cells_across_ = along_x ? cells_y : cells_x;
    const std::uint64_t cells_along = along_x ? cells_x : cells_y;
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
    const BatchRandom random(request);
    const auto shift = random.shift(sweep), first = random.first_cell(sweep);
    shift_ = {shift[0], shift[1]};
    first_cell_ = static_cast<std::uint32_t>((Wide{first[0]} * cells_across_) >> 64);
    first_share_ = first[1];
}

std::uint64_t SweepBatch::line_begin(std::uint64_t line) const {
    const Wide share = ((Wide{line} * rays_) << 64) / (passes_ * lines_of_pass_);
    return static_cast<std::uint64_t>((share + first_share_) >> 64);
}

double SweepBatch::offset(std::uint64_t s) const {
    const std::uint64_t pass = s / stripes_of_pass_;
    return to_unit(shift_.x + static_cast<std::uint64_t>((Wide{pass} << 64) / passes_));
}

LaunchStripe SweepBatch::stripe(std::uint64_t s) const {
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

}  // namespace asperity

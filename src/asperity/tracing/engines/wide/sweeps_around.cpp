// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/sweeps_around.h>

#include <asperity/core/directions.h>

#include <algorithm>

namespace asperity {

namespace {

/// Rays of a sweep for each cell along its lines, about: to work the way of the lines out costs as
/// much as some rays for each of its cells, and few azimuths are a coarse average (measured).
constexpr std::uint64_t kRaysPerCellAlong = 16;

}  // namespace

bool SweepsAround::possible(const Heightfield& surface, const Incidence& incidence,
                            LaunchPattern pattern) {
    return incidence.isotropic &&
           SweepBatch::possible(surface, {incidence.number, incidence.theta, 0, false}, pattern);
}

SweepsAround::SweepsAround(const Heightfield& surface, const Incidence& incidence,
                           const BatchRequest& request)
    : surface_(surface),
      incidence_(incidence),
      request_(request),
      turn_(BatchRandom(request).azimuth(0)) {
    const auto longest = static_cast<std::uint64_t>(std::max(surface.cells_x(), surface.cells_y()));
    sweeps_ = std::max<std::uint64_t>(1, request.rays / (kRaysPerCellAlong * longest));
}

Incidence SweepsAround::light(std::uint64_t k) const {
    const double turns = (static_cast<double>(k) + turn_) / static_cast<double>(sweeps_);
    return {incidence_.number, incidence_.theta, 2 * kPi * turns, false};
}

SweepBatch SweepsAround::sweep(std::uint64_t k) const {
    BatchRequest part = request_;
    part.rays = (k + 1) * request_.rays / sweeps_ - k * request_.rays / sweeps_;
    return {surface_, light(k), part, k};
}

}  // namespace asperity

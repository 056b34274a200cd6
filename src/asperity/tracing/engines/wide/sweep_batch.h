// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engines/wide/wide_launch.h>
#include <asperity/tracing/launch.h>

#include <cstdint>

namespace asperity {

/// Launch points of one batch of parallel light that comes in at an angle onto a periodic surface:
/// a lattice, like those of LaunchBatch, of lines along the light, a cell beside each other. Rays
/// of a line share their way (launch_line.h). Lines are shifted against each other by the golden
/// ratio of the distance of their points.
class SweepBatch {
  public:
    /// Whether light of a batch can come so.
    static bool possible(const Heightfield& surface, const Incidence& incidence,
                         LaunchPattern pattern);
    /// `sweep` tells several of one batch apart.
    SweepBatch(const Heightfield& surface, const Incidence& incidence, const BatchRequest& request,
               std::uint64_t sweep = 0);

    /// The s-th stripe of lines, s < stripes(), in the frame of a WideTracer, whether that is
    /// mirrored or not. They go over the tile in passes. Few rays leave parts of it out, elsewhere
    /// in each batch.
    LaunchStripe stripe(std::uint64_t s) const;
    std::uint64_t stripes() const { return passes_ * stripes_of_pass_; }
    /// Where the lines of a stripe start in their cells, as WideTracer::start wants it: the same
    /// place in all stripes of a pass.
    double offset(std::uint64_t s) const;
    /// Whether stripe s is the first one of a pass.
    bool begins_pass(std::uint64_t s) const { return s % stripes_of_pass_ == 0; }

  private:
    /// Rays of the lines before this one.
    std::uint64_t line_begin(std::uint64_t line) const;

    std::uint64_t rays_;
    TorusPoint shift_;  ///< of the lattice
    std::uint32_t first_cell_;
    std::uint64_t passes_, stripes_of_pass_, lines_of_pass_;
    /// Of a ray, in units of 2^-64, that the lines before the first one have left over.
    std::uint64_t first_share_;
    std::uint32_t cells_across_;
    double fall_;  ///< height by which light sinks along a line
};

}  // namespace asperity

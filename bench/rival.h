// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tally.h"
#include "workload.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace asperity::bench {

/// One way of tracing, made ready for one surface.
class Rival {
  public:
    virtual ~Rival() = default;

    virtual std::string name() const = 0;
    /// Traces the workload, on the calling thread.
    virtual Tally run(const Workload& workload) const = 0;
    /// Bytes kept for tracing, beside the heights.
    virtual std::size_t memory_bytes() const = 0;
    /// Wall-clock time it took to make ready, with all threads of the machine.
    virtual double build_seconds() const { return 0; }
    /// True if the paths start at Workload::points.
    virtual bool follows_points() const { return true; }
};

/// Asperity's product: launches, traces, sorts and sums as measure() does.
std::unique_ptr<Rival> make_own_rival(const Heightfield& surface, int threads);

/// Asperity's plain tracer, the readable twin of the fast one, from the given points.
std::unique_ptr<Rival> make_plain_rival(const Heightfield& surface, int threads);

/// The marching of the thesis, as printed or tuned. The surface must have Diagonal::Anti and cells
/// of side 1.
std::unique_ptr<Rival> make_thesis_rival(const Heightfield& surface, bool tuned);

/// Which ways to launch rays at Embree take part.
enum class EmbreeModes {
    None,
    Grid,   ///< the fastest of those that need little memory
    Usual,  ///< those that have been seen to win
    All,
};

/// Embree 3: the surface as triangles or as a grid geometry; single rays, packets and streams.
std::vector<std::unique_ptr<Rival>> make_embree_rivals(const Heightfield& surface,
                                                       EmbreeModes modes);

/// Paths a competitor has in flight at a time: enough to sort survivors into full packets, few
/// enough to stay in the cache. The same for all.
inline constexpr std::size_t kBatch = 4096;

}  // namespace asperity::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

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
    /// Follows every path to its end, on the calling thread.
    virtual Tally follow(const Workload& workload) const = 0;
    /// Bytes kept for tracing, beside the heights.
    virtual std::size_t memory_bytes() const = 0;
    /// Wall-clock time it took to make ready, with all threads of the machine.
    virtual double build_seconds() const = 0;
};

/// Asperity's own tracer.
std::unique_ptr<Rival> make_own_rival(const Heightfield& surface, int threads);

/// Embree 3: the surface as triangles, traced by single rays and by packets of 8 (and 16 where the
/// machine has registers as wide), and as a grid geometry, traced by packets of 8.
std::vector<std::unique_ptr<Rival>> make_embree_rivals(const Heightfield& surface);

/// Paths a rival has in flight at a time: enough to sort survivors into full packets, few enough to
/// stay in the cache. The same for all.
inline constexpr std::size_t kBatch = 4096;

}  // namespace asperity::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/tracing/engines/wide/follow.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace asperity {

/// Facets that lie in the light of a layer as a whole and mirror it out, wherever on them it falls.
///
/// Parallel light leaves such a facet in one direction, and the share of it that the facet takes is
/// known exactly. So a ray that meets one first is only counted, and what all of these rays carry
/// is spread over the directions by the facets' shares, not by where the rays happened to fall: no
/// bias, and no noise but that of their number. docs/theory.md, "Known facets".
class KnownFacets {
  public:
    /// Knows none.
    KnownFacets() = default;
    /// Looks at all facets, on so many threads, until the run is stopped: what was not looked at is
    /// not known. Knows none when a look here and there finds too few. Cost: less than a ray a
    /// cell; a byte a cell. Depends on neither the number of threads nor the instruction set.
    KnownFacets(const Scene& scene, const Run& run, int threads = 1);

    /// Whether `rays` of a layer are worth the look: one a cell, on a tile that fits the memory.
    static bool pay(const WideTracer& tracer, std::uint64_t rays);

    CountedFacets counted() const { return {cells_.empty() ? nullptr : cells_.data(), pitch_}; }
    /// Where the rays onto them go; null when none is known.
    const std::shared_ptr<const SpreadLight>& light() const { return light_; }

  private:
    /// Looks at parallel light on the facets, a row at a time.
    class Look;
    bool worthwhile(const Look& look, const Run& run) const;
    void look_at_all(const Look& look, const Run& run, int threads);
    void mark(std::size_t j, const std::vector<std::uint8_t>& known, std::size_t width);

    std::vector<std::uint8_t> cells_;  ///< as in CountedFacets
    std::int32_t pitch_ = 0;
    bool swapped_ = false;  ///< x and y have changed places
    std::shared_ptr<const SpreadLight> light_;
};

}  // namespace asperity

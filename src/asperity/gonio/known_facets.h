// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/follow.h>

#include <cstdint>
#include <vector>

namespace asperity {

/// Facets that mirror the light of a layer out for certain, wherever on them it falls. Parallel
/// light leaves such a facet in one direction, so cell and reflectance are worked out once a facet,
/// and a ray that meets it first needs no more than to be counted. Changes no bit of a result.
class KnownFacets {
  public:
    /// Knows nothing.
    KnownFacets() = default;
    /// Looks at all facets, on run.threads() threads, until it is stopped: what was not looked at
    /// is not known. Cost: about as much as two rays a cell; 8 bytes a cell, and 8 more for each
    /// channel unless the facets are perfect mirrors.
    KnownFacets(const Scene& scene, const Incidence& incidence, const Run& run);

    /// Whether `rays` of a layer are worth the look: some a cell, on a tile that fits the memory.
    static bool pay(const WideTracer& tracer, std::uint64_t rays);

    /// Cell of the detector by facet, -1: not known; null when nothing is known.
    FacetAnswers cells() const { return cells_.empty() ? nullptr : cells_.data(); }
    /// By facet; where its cell is known.
    float reflectance(std::size_t channel, std::size_t facet) const {
        return reflectance_[channel][facet];
    }

  private:
    struct Work;
    void look(const Scene& scene, const Incidence& incidence, int row, Work& work);

    std::vector<std::int32_t> cells_;
    std::vector<std::vector<float>> reflectance_;  ///< [channel]; none for perfect mirrors
};

}  // namespace asperity

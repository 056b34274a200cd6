// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/experiment.h>
#include <asperity/tracing/engines/plain/tracer.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

/// One facet of a surface: a triangle of the cell (i, j) of its tile.
struct FacetId {
    int i = 0, j = 0;
    Triangle triangle = Triangle::Lower;
    bool operator==(const FacetId&) const = default;
};

/// What became of a path, as measure() books it.
enum class PathEnd : std::uint8_t {
    Escaped,    ///< left the surface for good
    Truncated,  ///< met a facet after its last reflection
    Edge,       ///< left through the side of a finite patch
    Stuck,      ///< RayEnd::Stuck; measure() counts its energy as truncated
};

/// One path of light, with all that a picture of it needs. Places are in the surface's units and
/// frame, x = 0, y = 0 at its first sample; a path that goes over the border of a periodic tile
/// goes on outside of it, so its legs are straight.
struct LightPath {
    Vec3 wi;                      ///< towards the light
    Vec3 launched;                ///< where it starts: at the height of the highest point
    std::vector<Vec3> points;     ///< where it met facets, in order
    std::vector<FacetId> facets;  ///< those facets
    Vec3 wo;        ///< travels so from the last point on; 0 if truncated, for it ends there
    int cell = -1;  ///< of the detector; -1 unless escaped
    PathEnd end = PathEnd::Escaped;
};

/// The first `count` paths of the light of a layer: independent launch points, uniform over the
/// tile, parallel light, at most experiment.run.bounces reflections; a truncated path has one point
/// more. Path k depends on the surface, the light, the seed and k only, so it is the same for any
/// number of threads, and more paths begin with the same ones. They are rays as measure() launches
/// them with LaunchPattern::Random; optics do not matter.
///
/// With illumination.isotropic every path has an azimuth of its own, as `wi` says; `points` and
/// `wo` stay in the surface's frame, and `cell` is, as measure() sorts, of the azimuth relative to
/// the light's: that of `wo` turned by minus the azimuth of `wi`.
///
/// `layer` is a Layer::number, and the first azimuth if there are several. Throws Error(Usage,
/// "layer") if there is none, and validate()'s errors. Stage "following light", in paths; a stopped
/// run gives the first ones, within 100 ms. Cost: some microseconds a path and thread.
std::vector<LightPath> sample_light_paths(const Tracer& tracer, const Experiment& experiment,
                                          int layer, std::size_t count, Run& run);

/// Paths that end where they were wanted.
struct LightPathsFound {
    std::vector<LightPath> paths;
    /// Paths of the sequence up to the last one looked at: all, or up to the last one wanted.
    std::uint64_t tried = 0;
};

/// The first `wanted` of the same paths that end in one of these cells of the detector, among the
/// first `most_tried`. Throws Error(Usage, "cell") for a cell the detector does not have.
LightPathsFound paths_into_cells(const Tracer& tracer, const Experiment& experiment, int layer,
                                 std::span<const int> cells, std::size_t wanted,
                                 std::uint64_t most_tried, Run& run);

}  // namespace asperity

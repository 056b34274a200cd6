// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/render/camera.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/engines/plain/tracer.h>

#include <cstdint>
#include <functional>
#include <span>

namespace asperity {

/// What of a patch a ray sees.
enum class PatchPart : std::uint8_t {
    None,       ///< passes by
    Facet,      ///< the surface, from above
    Side,       ///< the cut through the matter below the surface, along the edges of the patch
    Underside,  ///< the level bottom of the matter, at the height of the lowest point
};

/// Where a ray meets a patch first.
struct PatchHit {
    PatchPart part = PatchPart::None;
    Triangle triangle = Triangle::Lower;  ///< of the cell, for facets
    std::int32_t i = 0, j = 0;            ///< the cell, for facets
    double distance = 0;                  ///< along the ray, in the unit of the surface
    Vec3 normal;                          ///< unit vector out of the matter
};

/// A surface as a thing to look at: one tile of it, not repeated, on a block of matter that reaches
/// down to its lowest point. Coordinates are the surface's own: x = i dx, y = j dy, z the height.
///
/// A ray that enters over the top of the block, or through a side above the surface there, goes on
/// to the facets by Tracer; below the surface it sees the cut. An eye inside the matter sees Side
/// everywhere.
class HeightfieldView {
  public:
    /// Copies the heights, with the first row and column again at the end of a periodic surface, so
    /// that all its cells are there. Cost: two passes over the heights.
    explicit HeightfieldView(const Heightfield& surface, int threads = 1);
    HeightfieldView(const HeightfieldView&) = delete;
    HeightfieldView& operator=(const HeightfieldView&) = delete;

    const Heightfield& patch() const { return patch_; }
    double lowest() const { return lowest_; }
    double highest() const { return static_cast<double>(tracer_.max_height()); }

    /// What each ray sees first; hits.size() == rays.size(). Safe from several threads.
    void look(std::span<const WorldRay> rays, std::span<PatchHit> hits) const;
    PatchHit look(const WorldRay& ray) const;

  private:
    /// Puts a ray into the grid where it enters the block; None when it misses, Facet when there is
    /// something to trace.
    PatchHit enter(const WorldRay& ray, Ray& start) const;

    Heightfield patch_;
    double lowest_ = 0;
    Tracer tracer_;
};

/// Takes a row of a picture: its number from the top, the rays through it and what they see.
using RowOfHits = std::function<void(int, std::span<const WorldRay>, std::span<const PatchHit>)>;

/// Looks through every pixel of a picture, at (x + offset_x, y + offset_y) with offsets in [0, 1);
/// the camera stands in the coordinates of the surface. Calls `take` once a row, from run.threads()
/// threads at a time. False when the run was stopped, which is heard once a row.
bool look_at_heightfield(const HeightfieldView& view, const Camera& camera, int width, int height,
                         double offset_x, double offset_y, Run& run, const RowOfHits& take);

}  // namespace asperity

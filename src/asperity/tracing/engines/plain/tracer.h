// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>
#include <asperity/tracing/engines/plain/height_bounds.h>
#include <asperity/tracing/ray.h>

#include <cstddef>
#include <span>

namespace asperity {

/// Finds where rays meet a heightfield: exact about shared edges and watertight, without epsilon.
///
/// Inside one triangle the clearance (ray height minus surface height) is linear along the ray. The
/// ray walks over the lines of the triangle grid, x lines, y lines and diagonals; at each crossing
/// the clearance is evaluated once, and a negative value means the triangle just passed was hit.
/// A triangle just left by a reflection is not tested again. Tiles whose highest point lies below
/// the ray are jumped. See docs/theory.md, "Tracing".
class Tracer {
  public:
    static constexpr int kMaxCrossings = 1 << 20;

    /// Builds the height bounds in one pass over the heights. Keeps a reference to `surface`.
    explicit Tracer(const Heightfield& surface, int threads = 1);

    const Heightfield& surface() const { return surface_; }
    float max_height() const { return bounds_.max_height(); }
    /// Bytes kept beside the heights themselves.
    std::size_t memory_bytes() const { return bounds_.memory_bytes(); }

    /// Advances each ray to its next facet, or out; ends[k] tells which. A free ray must stand at
    /// or above the surface, one on a facet must leave it upwards. ends.size() == rays.size(). The
    /// rays of a batch do not depend on each other; calls from several threads neither.
    void trace(std::span<Ray> rays, std::span<RayEnd> ends) const;

    /// Unit normal of the facet a ray stands on.
    Vec3 normal(const Ray& ray) const {
        return normal_of(facet_slope(surface_, ray.i, ray.j, static_cast<Triangle>(ray.facet)));
    }

  private:
    const Heightfield& surface_;
    HeightBounds bounds_;
};

}  // namespace asperity

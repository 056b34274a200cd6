// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"
#include "surface_frame.h"

#include <asperity/pictures/heightfield_view.h>

#include <array>
#include <memory>
#include <optional>

namespace asperity::studio {

/// A surface made ready to be looked at: where it lies in the world, and the colours of its facets.
class SurfaceBody {
  public:
    using Pixel = std::array<float, 3>;  ///< as on the screen, 0 .. 255

    explicit SurfaceBody(const Heightfield& surface);

    const HeightfieldView& view() const { return *view_; }
    const SurfaceFrame& frame() const { return frame_; }

    /// Of what a ray on the surface sees; hit.part is not None. A relief is of clay, or of metal
    /// whose reflectance along the normal is `metal`, linear sRGB.
    Pixel colour(const WorldRay& ray, const PatchHit& hit, SurfaceShading shading,
                 const std::optional<Vec3>& metal = std::nullopt) const;

    /// Whether matter lies between an eye and a point, both in the world. A point on a facet that
    /// the eye sees is not hidden.
    bool hides(Vec3 eye, Vec3 point) const;

  private:
    Pixel clay(const WorldRay& ray, const PatchHit& hit) const;
    Pixel polished(const WorldRay& ray, const PatchHit& hit, Vec3 metal) const;

    std::unique_ptr<HeightfieldView> view_;
    SurfaceFrame frame_;
    double mean_ = 0, spread_ = 0;  ///< of the heights: their mean and standard deviation
    double relief_ = 1;             ///< factor on slopes that the eye reads well
};

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dome.h"
#include "lazy.h"
#include "lobe.h"
#include "painting.h"
#include "surface_body.h"

#include <asperity/gonio/light_paths.h>
#include <asperity/render/camera.h>

#include <memory>
#include <unordered_set>
#include <vector>

namespace asperity::studio {

/// A set of facets of one surface.
class FacetSet {
  public:
    FacetSet() = default;
    /// All that these paths touched.
    explicit FacetSet(const std::vector<LightPath>& paths);

    bool empty() const { return keys_.empty(); }
    bool contains(const FacetId& facet) const { return keys_.contains(key(facet)); }

  private:
    static std::uint64_t key(const FacetId& facet) {
        return (static_cast<std::uint64_t>(facet.j) << 32) |
               (static_cast<std::uint64_t>(facet.i) << 1) |
               static_cast<std::uint64_t>(facet.triangle);
    }
    std::unordered_set<std::uint64_t> keys_;
};

/// All that a picture of the surface scene shows but its lines. Parts may be missing.
struct SurfacePicture {
    std::shared_ptr<const Lazy<SurfaceBody>> body;
    std::shared_ptr<const Lazy<DomePicture>> dome;
    SurfaceShading shading = SurfaceShading::Normals;
    std::shared_ptr<const FacetSet> selected;  ///< facets that stand out
    std::optional<Vec3> metal = {};            ///< of the relief, see SurfaceBody::colour
    std::vector<std::shared_ptr<const Lazy<Lobe>>> lobes = {};  ///< at the same place
};

/// A painting of it for a camera of the world: the first pass has one sample in the middle of each
/// pixel, kSurfaceSamples passes in all; the colours of a pixel are averaged as the screen shows
/// them.
BeginPainting paint_surface(SurfacePicture picture, const Camera& camera);
inline constexpr int kSurfaceSamples = 16;

}  // namespace asperity::studio

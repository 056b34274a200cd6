// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/render/camera.h>
#include <asperity/render/mesh.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace asperity {

/// Where a ray first meets a model.
struct Hit {
    float distance = std::numeric_limits<float>::infinity();  ///< infinite: nowhere
    float u = 0, v = 0;  ///< barycentric: p = (1 - u - v) p0 + u p1 + v p2
    std::uint32_t instance = 0, triangle = 0;

    bool found() const { return distance < std::numeric_limits<float>::infinity(); }
};

/// The surface at a Hit, in the world.
struct SurfacePoint {
    Vec3 position;          ///< from the triangle, not from the ray: accurate at any distance
    Vec3 geometric_normal;  ///< unit, of the triangle, on the side the ray came from
    Vec3 shading_normal;    ///< unit, of the mesh's normals, on the same side as geometric_normal
    Role role = Role::Subject;
    /// How far a new ray must start off the surface, along geometric_normal, not to meet it again.
    double offset = 0;
};

/// A Model made ready for rays (Embree 3.13, robust mode). Holds all it needs; the Model may go.
/// Immutable: share one between pictures, materials and threads.
///
/// Surfaces have two sides that look the same. The same rays meet the same triangles for any number
/// of threads, alone or in company.
class TracedModel {
  public:
    /// The stage is "building the scene". Throws check(model)'s errors, Error(OutOfMemory) with
    /// what Embree says, Error(Stopped).
    TracedModel(const Model& model, Run& run);
    ~TracedModel();
    TracedModel(TracedModel&&) noexcept;
    TracedModel& operator=(TracedModel&&) noexcept;

    Hit intersect(const WorldRay& ray) const;
    /// The same for many rays that run together, such as those of a tile of pixels; hits.size() ==
    /// rays.size().
    void intersect(std::span<const WorldRay> rays, std::span<Hit> hits) const;
    /// True when anything lies on the ray before `distance` (which may be infinite).
    bool occluded(const WorldRay& ray, double distance) const;
    /// The same for many rays that run together, such as those of a tile to one point: hidden[k] is
    /// 1 or 0. All three have one size.
    void occluded(std::span<const WorldRay> rays, std::span<const double> distances,
                  std::span<std::uint8_t> hidden) const;

    /// `hit` must have been found by `ray`.
    SurfacePoint surface(const WorldRay& ray, const Hit& hit) const;

    Bounds bounds() const;
    ModelStatistics statistics() const;

  private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

}  // namespace asperity

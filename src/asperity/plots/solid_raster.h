// SPDX-License-Identifier: Apache-2.0
// Solids over the hemisphere as pixels: nearest surfaces win, nearer ones may let others through.
#pragma once

#include <asperity/core/vec.h>
#include <asperity/plots/canvas.h>

#include <array>
#include <vector>

namespace asperity::plots {

/// Looks at the origin from far away, so that parallels stay parallel; z points up.
class SolidCamera {
  public:
    /// Seen from this azimuth, `elevation` above the surface [rad]. The unit hemisphere fills `box`
    /// but for a margin of the caller's.
    SolidCamera(double azimuth, double elevation, const Box& box);

    Place place(Vec3 p) const;
    /// Larger is nearer.
    double nearness(Vec3 p) const { return dot(p, towards_); }
    Vec3 towards() const { return towards_; }
    Vec3 right() const { return right_; }
    Vec3 up() const { return up_; }
    double scale() const { return scale_; }  ///< units of the canvas to one of space

    /// Width and height of what is seen of the unit hemisphere and its ground, scale 1.
    static Place extent(double elevation);

  private:
    Vec3 right_, up_, towards_;
    Place centre_;
    double scale_ = 1;
};

struct SolidVertex {
    Vec3 place, normal;
    Colour colour;
};

/// A surface of triangles, three indices each.
struct SolidMesh {
    std::vector<SolidVertex> vertices;
    std::vector<int> triangles;
};

/// The nearest surfaces below each pixel.
class SolidRaster {
  public:
    /// Over `box`, `pixels` of them to a unit.
    SolidRaster(const Box& box, double pixels);

    /// Draws with light from the upper left of the camera. `opacity`: of this mesh where it lies
    /// before others.
    void add(const SolidMesh& mesh, const SolidCamera& camera, double opacity);
    /// What all meshes look like together.
    Raster picture() const;
    /// What lies before a point.
    enum class Before { Nothing, Others, Own };
    /// `own`: the mesh, in the order of add(), that the point belongs to; -1: to none.
    Before before(Place place, double nearness, int own = -1) const;
    bool hides(Place place, double nearness) const {
        return before(place, nearness) != Before::Nothing;
    }

  private:
    struct Layer {
        std::vector<float> nearness;
        std::vector<Colour> colour;
        double opacity = 1;
    };
    void fill(Layer& layer, const std::array<Place, 3>& corners,
              const std::array<double, 3>& nearness, const std::array<Colour, 3>& colours) const;
    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    Box box_;
    double pixels_;
    int width_, height_;  ///< twice as fine as the picture
    std::vector<Layer> layers_;
};

}  // namespace asperity::plots

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/directions.h>
#include <asperity/core/vec.h>

namespace asperity {

/// A ray through a scene; a Ray (tracing/) runs over a microsurface.
struct WorldRay {
    Vec3 origin;
    Vec3 direction;  ///< unit vector
};

/// A pinhole camera in the world (y up, see mesh.h), or one that sees all round.
struct Camera {
    Vec3 position{0, 0, 3.5};
    Vec3 forward{0, 0, -1};  ///< unit vector along the view
    Vec3 up{0, 1, 0};        ///< unit vector, orthogonal to forward: up in the picture
    double fov_deg = 40;     ///< from the lower to the upper edge of the picture, 1 .. 170
    /// All directions from `position`, on the latitude-longitude map of environment_map.h: the
    /// picture lights another scene as it lit this place. What the fields between say has no
    /// effect.
    bool panorama = false;

    Vec3 right() const { return cross(forward, up); }
};

/// At `position`, looking at `target`; `up` is turned to be orthogonal. Where the view runs along
/// `up`, the picture's up is -z (or z, looking up). Throws Error(Usage, "camera-target") when both
/// are one point, Error(Usage, "camera-fov") outside 1 .. 170.
Camera look_at(Vec3 position, Vec3 target, double fov_deg, Vec3 up = {0, 1, 0});

/// The rays of a picture of width x height square pixels.
class PixelRays {
  public:
    PixelRays(const Camera& camera, int width, int height)
        : origin_(camera.position), right_(camera.right()), up_(camera.up) {
        if (camera.panorama) {
            pixel_ = 1.0 / height;
            columns_ = width;
            return;
        }
        pixel_ = 2 * std::tan(0.5 * radians(camera.fov_deg)) / height;
        corner_ = camera.forward + (-0.5 * pixel_ * width) * right_ + (0.5 * pixel_ * height) * up_;
    }

    /// Through the place (x, y) of the picture [pixels]: x to the right from the left edge, y down
    /// from the upper one; the middle of pixel (i, j) is (i + 0.5, j + 0.5).
    WorldRay at(double x, double y) const {
        if (columns_ > 0) return {origin_, around(x, y)};
        return {origin_, normalize(corner_ + (x * pixel_) * right_ - (y * pixel_) * up_)};
    }

  private:
    Vec3 around(double x, double y) const;

    Vec3 origin_, right_, up_, corner_;
    double pixel_ = 0;  ///< side of a pixel at distance 1; of a panorama as a share of its height
    int columns_ = 0;   ///< of a panorama
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/detector/detector.h>
#include <asperity/gonio/measurement.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/render/camera.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace asperity::studio {

/// Radius of the dome in the world of the surface scene, about the origin.
inline constexpr double kDomeRadius = 3.5;

/// Where a ray of the world meets the far side of the sphere that the dome is half of: the
/// direction from the middle, y up. The near side is open: an eye outside looks in. None when the
/// ray passes by.
std::optional<Vec3> dome_direction(const WorldRay& ray);

/// The layer shown on the dome, painted.
class DomePicture {
  public:
    using Pixel = std::array<float, 3>;  ///< as on the screen, 0 .. 255

    /// Colours of io::colour_of_value, on the scale of this layer; cells never lit are black.
    DomePicture(const Measurement& measurement, const Layer& layer,
                const io::SkyMapSettings& settings);

    const Detector& detector() const { return detector_; }
    const io::ValueScale& scale() const { return scale_; }

    /// `direction` on the surface, unit length, z >= 0.
    const Pixel& colour(Vec3 direction) const {
        return colours_[static_cast<std::size_t>(detector_.cell_of(direction))];
    }

  private:
    Detector detector_;
    io::ValueScale scale_;
    std::vector<Pixel> colours_;  ///< of each cell
};

}  // namespace asperity::studio

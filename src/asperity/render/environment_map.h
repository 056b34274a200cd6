// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/render/image.h>
#include <asperity/render/light.h>

#include <memory>
#include <string>

namespace asperity {

/// A place on a latitude-longitude map, both in [0, 1): u to the right, v down.
struct MapPoint {
    double u = 0, v = 0;
};

// Thesis eq. 4.5, the mapping of environment maps everywhere: the middle of the map is -z, +x lies
// to the right of it, +y is the upper edge.
//     u = atan2(x, -z) / (2 pi) + 1/2,  v = acos(y) / pi
MapPoint map_point(Vec3 direction);
Vec3 map_direction(MapPoint p);

struct EnvironmentMapSettings {
    double rotation_deg = 0;  ///< turns the map about +y, counter-clockwise seen from above
    double scale = 1;         ///< multiplies the radiance, > 0
    std::string name;         ///< for Light::name(): the file
};

/// Light from a latitude-longitude picture of radiance.
///
/// The light of a texel is the same all over it, and a texel is drawn in proportion to its
/// luminance times its exact solid angle, (2 pi / width) (cos theta_top - cos theta_bottom); within
/// it directions are uniform in solid angle. So L / pdf has the same luminance for every sample,
/// and radiance() and pdf() look up the very texels that sample() draws. background() is bilinear.
///
/// Keeps its own copy; about 20 bytes a texel. Throws Error(InvalidInput, settings.name) for a
/// picture without texels, with a value that is negative or not finite, or black all over;
/// Error(Usage, "light-scale" | "light-rotation").
std::unique_ptr<Light> make_environment_light(const Image& map,
                                              const EnvironmentMapSettings& settings);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include "dome.h"

#include <cmath>

namespace asperity::studio {

std::optional<Vec3> dome_direction(const WorldRay& ray) {
    const double middle = -dot(ray.origin, ray.direction);
    const double discriminant =
        middle * middle - dot(ray.origin, ray.origin) + kDomeRadius * kDomeRadius;
    if (discriminant < 0) return std::nullopt;
    const double far = middle + std::sqrt(discriminant);
    if (!(far > 0)) return std::nullopt;
    return normalize(ray.origin + far * ray.direction);
}

DomePicture::DomePicture(const Measurement& measurement, const Layer& layer,
                         const io::SkyMapSettings& settings)
    : detector_(measurement.detector), scale_(io::value_scale(measurement, {&layer}, settings)) {
    const std::vector<double> values = io::values_of(measurement, layer, settings.channel);
    colours_.reserve(values.size());
    for (const double value : values) {
        const io::Colour c = io::colour_of_value(value, scale_, settings.colour_map);
        colours_.push_back({static_cast<float>(255 * c.r), static_cast<float>(255 * c.g),
                            static_cast<float>(255 * c.b)});
    }
}

}  // namespace asperity::studio

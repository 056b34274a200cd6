// SPDX-License-Identifier: Apache-2.0
#include "soft_sky.h"

#include <asperity/core/directions.h>
#include <asperity/core/vec.h>
#include <asperity/render/environment_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity::studio {

namespace {

/// A round lamp with a soft rim.
struct Lamp {
    Vec3 to;            ///< unit vector
    double width_deg;   ///< where it has fallen to a third
    double brightness;  ///< in its middle
    double warmth;      ///< 0: white; 1: as evening sun
};

double lamp_at(const Lamp& lamp, Vec3 direction) {
    const double cosine = std::clamp(dot(lamp.to, direction), -1.0, 1.0);
    const double off = std::acos(cosine) / radians(lamp.width_deg);
    return lamp.brightness * std::exp(-off * off * off * off);
}

Rgb sky_at(Vec3 direction) {
    static const Lamp kLamps[] = {{normalize({-0.75, 0.75, 0.62}), 24, 9.0, 0.25},
                                  {normalize({1.0, 0.35, 0.25}), 17, 2.2, -0.25}};
    const double up = std::max(0.0, direction.y);
    const double sky = 0.46 + 0.34 * std::sqrt(up);
    Rgb light{sky, sky, 1.02 * sky};
    for (const Lamp& lamp : kLamps) {
        const double more = lamp_at(lamp, direction);
        light = light + Rgb{more * (1 + 0.10 * lamp.warmth), more, more * (1 - 0.35 * lamp.warmth)};
    }
    return light;
}

Image make_map() {
    constexpr int kHeight = 128, kWidth = 2 * kHeight;
    Image map{kWidth, kHeight, {}};
    double irradiance = 0;  // of a level plane, as luminance
    const double step = kPi / kHeight;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Vec3 d = map_direction({(x + 0.5) / kWidth, (y + 0.5) / kHeight});
            const Rgb c = sky_at(d);
            if (d.y > 0) irradiance += luminance(c) * d.y * step * step * std::sqrt(1 - d.y * d.y);
            for (const double part : {c.r, c.g, c.b}) map.rgb.push_back(static_cast<float>(part));
        }
    const double scale = kPi / irradiance;
    for (std::size_t k = 0; k < map.rgb.size(); ++k) {
        const bool below = k >= map.rgb.size() / 2;
        map.rgb[k] = below ? 0.5F : static_cast<float>(scale * static_cast<double>(map.rgb[k]));
    }
    return map;
}

}  // namespace

std::shared_ptr<const Light> make_soft_sky() {
    return make_environment_light(make_map(), {.name = "soft sky"});
}

}  // namespace asperity::studio

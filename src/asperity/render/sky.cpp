// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/perez_sky.h>
#include <asperity/render/sky.h>
#include <asperity/render/sun.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace asperity {

namespace {

constexpr int kMapHeight = 512;

void expect_within(const char* setting, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw Error(ErrorCode::Usage, fmt::format("{} is outside {} .. {}", value, least, most),
                setting);
}

void check(const SkySettings& settings) {
    expect_within("sun-elevation", settings.sun_elevation_deg, 0, 90);
    if (!std::isfinite(settings.sun_azimuth_deg))
        throw Error(ErrorCode::Usage, "an angle is a finite number", "sun-azimuth");
    expect_within("turbidity", settings.turbidity, 2, 10);
    if (!std::isfinite(settings.scale) || !(settings.scale > 0))
        throw Error(ErrorCode::Usage, "a scale is a finite number above 0", "light-scale");
    expect_within("sun-diameter", settings.sun_diameter_deg, 0.1, 20);
    expect_within("ground-albedo", settings.ground_albedo, 0, 1);
}

Vec3 sun_direction(const SkySettings& settings) {
    const double elevation = radians(settings.sun_elevation_deg);
    const double azimuth = radians(settings.sun_azimuth_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

/// Sky, ground and sun in the same unit.
struct Daylight {
    Image map;           ///< of sky and ground, without the sun
    Rgb sun_irradiance;  ///< on a plane that faces the sun
};

void set(Image& map, int x, int y, Rgb value) {
    const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                               static_cast<std::size_t>(x));
    map.rgb[k] = static_cast<float>(value.r);
    map.rgb[k + 1] = static_cast<float>(value.g);
    map.rgb[k + 2] = static_cast<float>(value.b);
}

/// Paints the rows above the horizon. Returns the irradiance they give a level plane.
Rgb paint_sky(Image& map, int rows, const SkySettings& settings) {
    const PerezSky sky(0.5 * kPi - radians(settings.sun_elevation_deg), settings.turbidity);
    const Vec3 sun = sun_direction(settings);
    Rgb irradiance;
    for (int y = 0; y < rows; ++y) {
        // Integral of the cosine over one texel, as far as it lies above the horizon
        const double upper = std::cos(kPi * y / map.height);
        const double lower = std::max(0.0, std::cos(kPi * (y + 1) / map.height));
        const double share = kPi / map.width * (upper * upper - lower * lower);
        for (int x = 0; x < map.width; ++x) {
            const Vec3 w = map_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
            const Rgb seen = sky.radiance(w.y, dot(w, sun));
            set(map, x, y, seen);
            irradiance = irradiance + share * seen;
        }
    }
    return irradiance;
}

Daylight make_daylight(const SkySettings& settings, int height) {
    check(settings);
    if (height < 2) throw Error(ErrorCode::Usage, "a sky map has two rows at least", "height");
    const auto texels = 2 * static_cast<std::size_t>(height) * static_cast<std::size_t>(height);
    Daylight day{{2 * height, height, std::vector<float>(3 * texels)}, {}};
    const double elevation = radians(settings.sun_elevation_deg);

    // Sky and sun in klx, as the models give them; rows whose middle is above the horizon
    const int sky_rows = (height + 1) / 2;
    const Rgb from_sky = paint_sky(day.map, sky_rows, settings);
    day.sun_irradiance = sun_irradiance(elevation, settings.turbidity);

    // The ground is matt and lit by both
    const Rgb level = from_sky + std::sin(elevation) * day.sun_irradiance;
    const Rgb ground = (settings.ground_albedo / kPi) * level;
    for (int y = sky_rows; y < height; ++y)
        for (int x = 0; x < day.map.width; ++x) set(day.map, x, y, ground);

    // A white, matt, level plane shall have the luminance `scale`
    const double unit = kPi * settings.scale / luminance(level);
    for (float& value : day.map.rgb) value = static_cast<float>(unit * static_cast<double>(value));
    day.sun_irradiance = unit * day.sun_irradiance;
    return day;
}

std::string describe(const char* what, const SkySettings& settings) {
    return fmt::format("{}, sun at elevation {} and azimuth {} degrees, turbidity {}", what,
                       settings.sun_elevation_deg, settings.sun_azimuth_deg, settings.turbidity);
}

}  // namespace

Image make_sky_map(const SkySettings& settings, int height) {
    return make_daylight(settings, height).map;
}

std::vector<std::unique_ptr<Light>> make_sky(const SkySettings& settings) {
    check(settings);
    SkySettings unscaled = settings;
    unscaled.scale = 1;
    const Daylight day = make_daylight(unscaled, kMapHeight);
    std::vector<std::unique_ptr<Light>> lights;
    lights.push_back(
        make_environment_light(day.map, {0, settings.scale, describe("of a clear sky", settings)}));
    if (settings.sun)
        lights.push_back(make_disc_light(
            sun_direction(settings), radians(settings.sun_diameter_deg),
            settings.scale * day.sun_irradiance,
            fmt::format("{}, diameter {} degrees, scale {}", describe("disc", settings),
                        settings.sun_diameter_deg, settings.scale)));
    return lights;
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/render/colour.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/light_testing.h>
#include <asperity/render/perez_sky.h>
#include <asperity/render/render_testing.h>
#include <asperity/render/sky.h>
#include <asperity/render/sun.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace asperity {
namespace {

/// Irradiance of a map of radiance on a level plane: each texel times the integral of cos over it.
Rgb level_irradiance(const Image& map) {
    Rgb sum;
    for (int y = 0; y < map.height / 2; ++y) {
        const double upper = kPi * y / map.height, lower = kPi * (y + 1) / map.height;
        const double share =
            kPi / map.width * (std::pow(std::sin(lower), 2) - std::pow(std::sin(upper), 2));
        for (int x = 0; x < map.width; ++x) sum = sum + share * map.at(x, y);
    }
    return sum;
}

// Turbidity 2, sun 60 degrees from the zenith, by hand from the coefficients of appendix A2:
//   chi = (4/9 - 2/120) (pi - 2 pi/3) = 0.447968
//   Y_zenith = (4.0453 * 2 - 4.9710) tan(chi) - 0.2155 * 2 + 2.4192 = 3.48733 kcd/m^2
//   A = -1.1056, B = -0.2833, C = 5.2797, D = -2.3359, E = 0.2363
// At the zenith the gradient 1 + A e^B = 0.167158; the glow 60 degrees from the sun
//   1 + C e^(D pi/3) + E / 4 = 1.516437.
// On the horizon under the sun: gradient 1, glow 1 + C e^(D pi/6) + 3/4 E = 2.731167.
// At the sun: gradient 1 + A e^(2 B) = 0.372626, glow 1 + C + E = 6.516.
TEST(PerezSky, LuminanceByHand) {
    const PerezSky sky(kPi / 3, 2);
    EXPECT_NEAR(sky.zenith().luminance, 3.48733, 1e-5);
    EXPECT_NEAR(sky.colour(1, 0.5).luminance, 3.48733, 1e-5);
    EXPECT_NEAR(sky.colour(0, std::cos(kPi / 6)).luminance,
                3.48733 * 2.731167 / (0.167158 * 1.516437), 1e-3);
    EXPECT_NEAR(sky.colour(0.5, 1).luminance, 3.48733 * 0.372626 * 6.516 / (0.167158 * 1.516437),
                1e-3);
}

// The zenith's chromaticity at the same sun: with t = pi/3, t^2 = 1.096623, t^3 = 1.148381
//   x = 4 (0.00166 t^3 - 0.00375 t^2 + 0.00209 t) + 2 (-0.02903 t^3 + 0.06377 t^2 - 0.03202 t
//       + 0.00394) + 0.11693 t^3 - 0.21196 t^2 + 0.06052 t + 0.25886 = 0.238013
// and y = 0.241988 alike: a deep blue.
TEST(PerezSky, ZenithIsBlue) {
    const PerezSky sky(kPi / 3, 2);
    EXPECT_NEAR(sky.zenith().x, 0.238013, 1e-6);
    EXPECT_NEAR(sky.zenith().y, 0.241988, 1e-6);
    const Rgb c = sky.radiance(1, 0.5);
    EXPECT_NEAR(luminance(c), sky.zenith().luminance, 1e-3 * sky.zenith().luminance);
    EXPECT_GT(c.b, 1.5 * c.g);
    EXPECT_GT(c.g, c.r);
}

TEST(RgbOfXyz, WhiteIsWhiteAndNothingIsNegative) {
    const Rgb white = rgb_of_xyz(0.95047, 1, 1.08883);  // D65
    EXPECT_NEAR(white.r, 1, 1e-4);
    EXPECT_NEAR(white.g, 1, 1e-4);
    EXPECT_NEAR(white.b, 1, 1e-4);
    // Light of 520 nm, x = 0.0743, y = 0.8338: far outside sRGB
    const Rgb green = rgb_of_xyz(0.0743 / 0.8338, 1, 0.0919 / 0.8338);
    EXPECT_EQ(green.r, 0);
    EXPECT_GE(green.b, 0);
    EXPECT_NEAR(luminance(green), 1, 5e-4);  // the matrix has more digits than luminance()
}

// A clear day's sun gives a plane that faces it about 100 klx; through more air it is weaker and
// redder, and a haze takes more of it.
TEST(Sun, PalesAndReddensTowardsTheHorizon) {
    EXPECT_NEAR(luminance(sun_irradiance(kPi / 2, 2)), 105, 10);
    for (const double turbidity : {2.0, 4.0, 10.0}) {
        Rgb before = sun_irradiance(kPi / 2, turbidity);
        for (const double elevation_deg : {60.0, 30.0, 10.0, 3.0, 0.0}) {
            const Rgb sun = sun_irradiance(radians(elevation_deg), turbidity);
            EXPECT_LT(luminance(sun), luminance(before));
            EXPECT_LE(sun.b * before.r, before.b * sun.r);
            EXPECT_GE(std::min({sun.r, sun.g, sun.b}), 0);
            before = sun;
        }
    }
    EXPECT_GT(luminance(sun_irradiance(1, 2)), luminance(sun_irradiance(1, 3)));
}

TEST(DiscLight, IsEvenOverItsSolidAngle) {
    const Vec3 middle = normalize({0.3, 0.5, -0.8});
    for (const double diameter : {radians(0.533), radians(20)}) {
        const auto light = make_disc_light(middle, diameter, {3, 2, 1}, "sun");
        // Solid angle of a cone: 2 pi (1 - cos(radius))
        const double solid_angle = 4 * kPi * std::pow(std::sin(diameter / 4), 2);
        std::vector<double> observed(100, 0.0);
        const Vec3 x = normalize(cross({0, 1, 0}, middle)), y = cross(middle, x);
        for (std::uint64_t i = 0; i < 100000; ++i) {
            const auto u = CounterRandom(1, 0).uniform2(i);
            const auto s = light->sample({}, u[0], u[1]);
            ASSERT_TRUE(s);
            ASSERT_NEAR(s->pdf * solid_angle, 1, 1e-12);
            ASSERT_EQ(light->pdf(s->direction), s->pdf);
            ASSERT_EQ(light->radiance(s->direction), s->radiance);
            // Ten rings of equal solid angle, ten sectors
            const Vec3 chord = s->direction - middle;
            const double ring = 10 * kPi * dot(chord, chord) / solid_angle;
            const double phi = azimuth({dot(s->direction, x), dot(s->direction, y), 0});
            observed[10 * static_cast<std::size_t>(std::min(ring, 9.0)) +
                     static_cast<std::size_t>(phi / (2 * kPi) * 10)] += 1;
        }
        EXPECT_GT(test::chi_square_p_value(observed, std::vector<double>(100, 1000.0)), 0.01);
        // On a plane that faces it: L pi sin^2(radius)
        const double projected = kPi * std::pow(std::sin(diameter / 2), 2);
        EXPECT_NEAR(light->radiance(middle).r * projected, 3, 1e-12);
        EXPECT_NEAR(light->weight(), 0.25 * luminance(light->radiance(middle)) * solid_angle,
                    1e-12);
        const Vec3 beside = std::cos(0.51 * diameter) * middle + std::sin(0.51 * diameter) * x;
        EXPECT_EQ(light->pdf(beside), 0);
        EXPECT_EQ(light->radiance(beside), Rgb{});
    }
}

// The white, matt plane reflects E / pi; the sun's share of E is that of a plane that faces it
// times the sine of its elevation.
TEST(Sky, LevelWhitePlaneHasTheLuminanceOfTheScale) {
    for (const double elevation : {0.0, 3.0, 45.0, 90.0}) {
        for (const double turbidity : {2.0, 10.0}) {
            SkySettings settings;
            settings.sun_elevation_deg = elevation;
            settings.turbidity = turbidity;
            settings.scale = 2.5;
            const auto lights = make_sky(settings);
            ASSERT_EQ(lights.size(), 2u);
            const double e = radians(elevation), a = radians(settings.sun_azimuth_deg);
            const Vec3 sun{std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
            const double facing =
                kPi * std::pow(std::sin(radians(settings.sun_diameter_deg / 2)), 2);
            const Rgb level = level_irradiance(make_sky_map(settings)) +
                              (std::sin(e) * facing) * lights[1]->radiance(sun);
            EXPECT_NEAR(luminance(level) / kPi, 2.5, 1e-5) << elevation << ' ' << turbidity;
            // The ground is that plane in grey
            const Rgb ground = lights[0]->radiance({0, -1, 0});
            EXPECT_NEAR(luminance(ground), settings.ground_albedo * 2.5, 1e-6);
        }
    }
}

TEST(Sky, SunChangesNothingButItself) {
    SkySettings settings;
    settings.sun = false;
    const auto without = make_sky(settings);
    ASSERT_EQ(without.size(), 1u);
    EXPECT_EQ(make_sky_map(settings, 64).rgb, make_sky_map({}, 64).rgb);
    // A sun ten times as wide shines as much
    settings.sun = true;
    settings.sun_diameter_deg = 5.33;
    const auto wide = make_sky(settings), small = make_sky({});
    EXPECT_NEAR(wide[1]->weight() / small[1]->weight(), 1, 1e-3);
}

TEST(Sky, IsBrightestAboutItsSun) {
    SkySettings settings;
    settings.sun_elevation_deg = 30;
    settings.sun_azimuth_deg = 90;  // +x: three quarters to the right
    const Image map = make_sky_map(settings, 64);
    double most = 0;
    int column = 0;
    for (int x = 0; x < map.width; ++x) {
        const double light = luminance(map.at(x, 21));  // 60 degrees from the zenith
        if (light > most) column = x;
        most = std::max(most, light);
    }
    EXPECT_NEAR(column, 95.5, 0.5);
    const auto lights = make_sky(settings);
    const auto s = lights[1]->sample({}, 0, 0);
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->direction.x, std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(s->direction.y, 0.5, 1e-12);
}

TEST(Sky, HasNoNegativeNorInfiniteLight) {
    SkySettings settings;
    for (int elevation = 0; elevation <= 90; elevation += 5) {
        for (int turbidity = 2; turbidity <= 10; ++turbidity) {
            settings.sun_elevation_deg = elevation;
            settings.turbidity = turbidity;
            for (const float value : make_sky_map(settings, 33).rgb) {
                ASSERT_TRUE(std::isfinite(value) && value >= 0)
                    << value << ' ' << elevation << ' ' << turbidity;
            }
        }
    }
}

TEST(Sky, RefusesWhatIsNoSky) {
    const auto complaint = [](auto change, int height = 8) {
        SkySettings settings;
        change(settings);
        try {
            make_sky_map(settings, height);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            return error.where();
        }
        return std::string();
    };
    using test::kNaN;
    EXPECT_EQ(complaint([](auto&) {}), "");
    EXPECT_EQ(complaint([](auto&) {}, 1), "height");
    EXPECT_EQ(complaint([](auto& s) { s.sun_elevation_deg = -1; }), "sun-elevation");
    EXPECT_EQ(complaint([](auto& s) { s.sun_elevation_deg = 91; }), "sun-elevation");
    EXPECT_EQ(complaint([](auto& s) { s.sun_azimuth_deg = kNaN; }), "sun-azimuth");
    EXPECT_EQ(complaint([](auto& s) { s.turbidity = 1.9; }), "turbidity");
    EXPECT_EQ(complaint([](auto& s) { s.turbidity = 10.1; }), "turbidity");
    EXPECT_EQ(complaint([](auto& s) { s.scale = 0; }), "light-scale");
    EXPECT_EQ(complaint([](auto& s) { s.sun_diameter_deg = 0; }), "sun-diameter");
    EXPECT_EQ(complaint([](auto& s) { s.ground_albedo = kNaN; }), "ground-albedo");
}

}  // namespace
}  // namespace asperity

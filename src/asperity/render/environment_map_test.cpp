// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/light_testing.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

Image constant_map(int width, int height, float value) {
    return {width, height, std::vector<float>(3 * static_cast<std::size_t>(width * height), value)};
}

void set(Image& map, int x, int y, Rgb c) {
    const auto k = 3 * static_cast<std::size_t>(y * map.width + x);
    map.rgb[k] = static_cast<float>(c.r);
    map.rgb[k + 1] = static_cast<float>(c.g);
    map.rgb[k + 2] = static_cast<float>(c.b);
}

/// 16 x 8 texels at random, one in three of them black, row 3 all black, light at both poles, and
/// one texel a million times as bright as the others.
Image rough_map() {
    Image map = constant_map(16, 8, 0);
    const CounterRandom random(7, 0);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const auto u = random.uniform2(static_cast<std::uint64_t>(y * map.width + x));
            if (y == 3 || (u[0] < 1 / 3.0 && y > 0 && y < 7)) continue;
            set(map, x, y, {u[0], u[1], 1 - u[0]});
        }
    }
    return map;
}

Image hot_map() {
    Image map = rough_map();
    set(map, 11, 2, {1e6, 2e6, 1e6});
    return map;
}

std::unique_ptr<Light> light_of(const Image& map, double rotation_deg = 0, double scale = 1) {
    return make_environment_light(map, {rotation_deg, scale, "sky.exr"});
}

// Thesis eq. 4.5 by hand: u = atan2(x, -z) / 2 pi + 1/2, v = acos(y) / pi.
TEST(MapPoint, AxesAreWhereTheThesisHasThem) {
    const auto expect_at = [](Vec3 d, double u, double v) {
        EXPECT_NEAR(map_point(d).u, u, 1e-15) << d.x << ' ' << d.y << ' ' << d.z;
        EXPECT_NEAR(map_point(d).v, v, 1e-15) << d.x << ' ' << d.y << ' ' << d.z;
    };
    expect_at({0, 0, -1}, 0.5, 0.5);
    expect_at({1, 0, 0}, 0.75, 0.5);
    expect_at({-1, 0, 0}, 0.25, 0.5);
    expect_at({0, 0, 1}, 0, 0.5);     // atan2(0, -1) = pi: the seam, taken to be its left
    expect_at({-0.0, 0, 1}, 0, 0.5);  // atan2(-0, -1) = -pi
    expect_at({0, 1, 0}, 0.5, 0);
    expect_at({0, 0.6, 0.8}, 0, std::acos(0.6) / kPi);
    expect_at({0.48, -0.6, 0.64}, std::atan2(0.48, -0.64) / (2 * kPi) + 0.5, std::acos(-0.6) / kPi);
    expect_at({-0.64, 0.6, 0.48}, std::atan2(-0.64, -0.48) / (2 * kPi) + 0.5, std::acos(0.6) / kPi);
    expect_at({0, std::sqrt(0.5), -std::sqrt(0.5)}, 0.5, 0.25);
    EXPECT_LT(map_point({0, -1, 0}).v, 1);
    EXPECT_NEAR(map_point({0, -1, 0}).v, 1, 1e-15);
}

TEST(MapPoint, ThereAndBack) {
    const CounterRandom random(3, 0);
    for (std::uint64_t i = 0; i < 10000; ++i) {
        const auto u = random.uniform2(i);
        const Vec3 d = map_direction({u[0], u[1]});
        EXPECT_NEAR(length(d), 1, 1e-15);
        EXPECT_NEAR(map_point(d).u, u[0], 1e-14);
        EXPECT_NEAR(map_point(d).v, u[1], 1e-14);
    }
    // As exact next to the poles, where acos(y) would have lost half its digits
    EXPECT_NEAR(map_point(map_direction({0.3, 1e-9})).v, 1e-9, 1e-23);
}

TEST(EnvironmentLight, SeamJoinsTheFirstAndTheLastColumn) {
    Image map = constant_map(4, 2, 0);
    set(map, 0, 0, {1, 0, 0});
    set(map, 3, 0, {0, 1, 0});
    const auto light = light_of(map);
    const double s = std::sqrt(0.5);
    EXPECT_EQ(light->radiance(normalize({-1e-9, s, s})), (Rgb{1, 0, 0}));
    EXPECT_EQ(light->radiance(normalize({1e-9, s, s})), (Rgb{0, 1, 0}));
    const Rgb between = light->background(normalize({0, 1, 1}));
    EXPECT_NEAR(between.r, 0.5, 1e-12);
    EXPECT_NEAR(between.g, 0.5, 1e-12);
}

TEST(EnvironmentLight, EverySampleHasTheSameLuminanceOverItsDensity) {
    for (const Image& map : {rough_map(), hot_map()}) {
        for (const double rotation : {0.0, 37.0}) {
            const auto light = light_of(map, rotation, 2.5);
            const CounterRandom random(5, 0);
            const double whole = 4 * light->weight();
            int found = 0;
            for (std::uint64_t i = 0; i < 20000; ++i) {
                const auto u = random.uniform2(i);
                const auto s = light->sample({}, u[0], u[1]);
                if (!s) continue;
                ++found;
                EXPECT_NEAR(luminance(s->radiance) / s->pdf, whole, 1e-13 * whole);
                EXPECT_EQ(light->pdf(s->direction), s->pdf);
                EXPECT_EQ(light->radiance(s->direction), s->radiance);
            }
            EXPECT_GE(found, 19999);  // rounding may lead off a texel's edge, hardly ever
        }
    }
}

TEST(EnvironmentLight, SamplesFollowTheDensity) {
    for (const Image& map : {rough_map(), hot_map(), constant_map(1, 1, 0.25F)}) {
        const test::LightReport report = test::test_light(*light_of(map), {});
        EXPECT_GT(report.p_value, 0.01);
        EXPECT_NEAR(report.integral, 1, 1e-12);
        EXPECT_EQ(report.impossible, 0);
    }
    // Turned by two columns of 16, texels and cells still fall together.
    const test::LightReport turned = test::test_light(*light_of(rough_map(), 45), {});
    EXPECT_GT(turned.p_value, 0.01);
    EXPECT_NEAR(turned.integral, 1, 1e-12);
}

// The lower half red of radiance 2, the upper one blue of radiance 3: 2 pi each.
TEST(EnvironmentLight, MeanOfSamplesIsTheIntegral) {
    Image map = constant_map(6, 4, 0);
    for (int x = 0; x < 6; ++x) {
        for (const int y : {0, 1}) set(map, x, y, {0, 0, 3});
        for (const int y : {2, 3}) set(map, x, y, {2, 0, 0});
    }
    const auto light = light_of(map);
    const test::LightReport report = test::test_light(*light, {});
    const double whole = 2 * kPi * (2 * 0.2126 + 3 * 0.0722);
    EXPECT_NEAR(luminance(report.mean), whole, 1e-9);
    EXPECT_NEAR(light->weight(), whole / 4, 1e-12);
    // Blue is found with the share of its luminance p: standard error of p sqrt(p (1 - p) / n)
    const double p = 3 * 0.0722 / (2 * 0.2126 + 3 * 0.0722);
    const double error = std::sqrt(p * (1 - p) / 200000);
    EXPECT_NEAR(report.mean.b / (6 * kPi), 1, 4 * error / p);
    EXPECT_NEAR(report.mean.r / (4 * kPi), 1, 4 * error / (1 - p));
    EXPECT_EQ(report.mean.g, 0);
}

// Near the poles of a high map texels have a hundred-millionth of a steradian.
TEST(EnvironmentLight, PolesOfAHighMapAreDrawnRightly) {
    Image map = constant_map(2, 8192, 0);
    set(map, 1, 0, {1, 1, 1});
    set(map, 0, 8191, {1, 1, 1});
    const auto light = light_of(map);
    const double drop = 2 * std::pow(std::sin(0.5 * kPi / 8192), 2);  // 1 - cos of a row
    int upper = 0;
    for (std::uint64_t i = 0; i < 10000; ++i) {
        const auto u = CounterRandom(9, 0).uniform2(i);
        const auto s = light->sample({}, u[0], u[1]);
        if (!s) continue;
        EXPECT_NEAR(s->pdf * 2 * kPi * drop, 1, 1e-6);
        upper += s->direction.y > 0 ? 1 : 0;
    }
    EXPECT_NEAR(upper, 5000, 4 * 50);
}

// Light in the middle of the map, -z; a quarter turn counter-clockwise seen from above, with -z
// ahead and x to the right, brings what is ahead to the left.
TEST(EnvironmentLight, TurnsCounterClockwiseSeenFromAbove) {
    Image map = constant_map(32, 16, 0.001F);
    for (const int x : {15, 16})
        for (const int y : {7, 8}) set(map, x, y, {1, 1, 1});
    EXPECT_EQ(light_of(map)->radiance({0, 0, -1}).r, 1);
    EXPECT_EQ(light_of(map, 90)->radiance({-1, 0, 0}).r, 1);
    EXPECT_EQ(light_of(map, -90)->radiance({1, 0, 0}).r, 1);
    EXPECT_EQ(light_of(map, 180)->radiance({0, 0, 1}).r, 1);
    const auto s = light_of(map, 90)->sample({}, 0.5, 0.5);
    ASSERT_TRUE(s);
    EXPECT_LT(s->direction.x, -0.9);
}

TEST(EnvironmentLight, BackgroundIsLinearBetweenTexels) {
    Image map = constant_map(4, 4, 0);
    set(map, 1, 1, {4, 0, 0});
    set(map, 2, 1, {8, 0, 0});
    const auto light = light_of(map, 0, 0.5);
    const auto at = [&](double x, double y) {  // in texels
        return light->background(map_direction({x / 4, y / 4})).r;
    };
    EXPECT_NEAR(at(1.5, 1.5), 2, 1e-12);
    EXPECT_NEAR(at(2.5, 1.5), 4, 1e-12);
    EXPECT_NEAR(at(1.75, 1.5), 2.5, 1e-12);
    EXPECT_NEAR(at(1.5, 2.25), 0.5, 1e-12);
    // Above the first row's middles nothing changes towards the pole
    set(map, 1, 0, {1, 0, 0});
    EXPECT_NEAR(light_of(map)->background(map_direction({1.5 / 4, 0.1 / 4})).r, 1, 1e-12);
    // A texel of its own all round
    EXPECT_EQ(light_of(constant_map(1, 1, 3))->background({0, -1, 0}), (Rgb{3, 3, 3}));
}

TEST(EnvironmentLight, RefusesWhatIsNoLight) {
    const auto complaint = [](const Image& map, double rotation, double scale) {
        try {
            make_environment_light(map, {rotation, scale, "sky.exr"});
        } catch (const Error& error) {
            return std::pair(error.code(), error.where());
        }
        return std::pair(ErrorCode::Stopped, std::string());
    };
    const std::pair file(ErrorCode::InvalidInput, std::string("sky.exr"));
    EXPECT_EQ(complaint({}, 0, 1), file);
    EXPECT_EQ(complaint(constant_map(4, 2, 0), 0, 1), file);
    EXPECT_EQ(complaint(constant_map(4, 2, -1), 0, 1), file);
    EXPECT_EQ(complaint(constant_map(4, 2, std::numeric_limits<float>::quiet_NaN()), 0, 1), file);
    EXPECT_EQ(complaint(constant_map(4, 2, std::numeric_limits<float>::infinity()), 0, 1), file);
    const auto usage = [](const char* where) {
        return std::pair(ErrorCode::Usage, std::string(where));
    };
    const Image good = constant_map(4, 2, 1);
    EXPECT_EQ(complaint(good, 0, 0), usage("light-scale"));
    EXPECT_EQ(complaint(good, 0, -1), usage("light-scale"));
    EXPECT_EQ(complaint(good, 0, std::numeric_limits<double>::max()), usage("light-scale"));
    EXPECT_EQ(complaint(good, std::numeric_limits<double>::quiet_NaN(), 1),
              usage("light-rotation"));
}

}  // namespace
}  // namespace asperity

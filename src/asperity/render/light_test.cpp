// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/render/light.h>
#include <asperity/render/light_testing.h>
#include <asperity/render/render_testing.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

using test::kInfinity;
using test::kNaN;

/// The setting make_light complains of; empty when all is well.
template <typename Settings>
std::string complaint(const Settings& settings) {
    try {
        EXPECT_TRUE(make_light(settings));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.where();
    }
    return {};
}

// Intensity 300 at (1, 1, 1), seen from (1, 1, -1): distance 2, so L = 300 / 4.
TEST(PointLight, FallsOffWithTheSquareOfDistance) {
    const auto light = make_light(PointLightSettings{});
    const auto s = light->sample({1, 1, -1}, 0.3, 0.7);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(s->distance, 2);
    EXPECT_EQ(s->radiance, (Rgb{75, 75, 75}));
    EXPECT_EQ(s->pdf, 1);
    EXPECT_TRUE(light->is_delta());
    EXPECT_EQ(light->radiance({0, 0, 1}), Rgb{});
    EXPECT_EQ(light->pdf({0, 0, 1}), 0);
    EXPECT_NEAR(light->weight(), 100, 1e-12);  // 300 / |(1, 1, 1)|^2
    EXPECT_EQ(light->name(), "point light at (1, 1, 1), intensity 300, colour 1/1/1");
}

TEST(PointLight, IsNotSeenFromWithinItselfNorWhenDark) {
    EXPECT_FALSE(make_light(PointLightSettings{})->sample({1, 1, 1}, 0, 0));
    EXPECT_FALSE(make_light(PointLightSettings{{1, 1, 1}, 0, {1, 1, 1}})->sample({}, 0, 0));
    EXPECT_FALSE(make_light(PointLightSettings{{1, 1, 1}, 1, {0, 0, 0}})->sample({}, 0, 0));
    const auto inside = make_light(PointLightSettings{{0, 0, 0}, 1, {1, 1, 1}});
    EXPECT_TRUE(std::isfinite(inside->weight()));
}

TEST(PointLight, ColourMultiplies) {
    const auto light = make_light(PointLightSettings{{0, 2, 0}, 8, {1, 0.5, 0}});
    const auto s = light->sample({}, 0, 0);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->radiance, (Rgb{2, 1, 0}));
}

TEST(PointLight, RefusesWhatIsNoLight) {
    EXPECT_EQ(complaint(PointLightSettings{}), "");
    EXPECT_EQ(complaint(PointLightSettings{{0, kNaN, 0}, 1, {1, 1, 1}}), "light-position");
    EXPECT_EQ(complaint(PointLightSettings{{0, 0, kInfinity}, 1, {1, 1, 1}}), "light-position");
    EXPECT_EQ(complaint(PointLightSettings{{0, 0, 0}, -1, {1, 1, 1}}), "light-intensity");
    EXPECT_EQ(complaint(PointLightSettings{{0, 0, 0}, kInfinity, {1, 1, 1}}), "light-intensity");
    EXPECT_EQ(complaint(PointLightSettings{{0, 0, 0}, 1, {1, -0.1, 1}}), "light-colour");
    EXPECT_EQ(complaint(PointLightSettings{{0, 0, 0}, 1, {1, 1, kNaN}}), "light-colour");
}

TEST(DirectionalLight, ShinesAlikeEverywhere) {
    const auto light = make_light(DirectionalLightSettings{{0, 0, 5}, 3, {1, 1, 0.5}});
    for (const Vec3 point : {Vec3{}, Vec3{7, -3, 100}}) {
        const auto s = light->sample(point, 0.1, 0.9);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->direction, (Vec3{0, 0, 1}));
        EXPECT_EQ(s->distance, kInfinity);
        EXPECT_EQ(s->radiance, (Rgb{3, 3, 1.5}));
        EXPECT_EQ(s->pdf, 1);
    }
    EXPECT_TRUE(light->is_delta());
    EXPECT_EQ(light->radiance({0, 0, 1}), Rgb{});
    EXPECT_EQ(light->pdf({0, 0, 1}), 0);
    EXPECT_NEAR(light->weight(), 3 * (1 - 0.0722 / 2), 1e-12);
    EXPECT_EQ(light->name(), "directional light from (0, 0, 5), irradiance 3, colour 1/1/0.5");
}

TEST(DirectionalLight, RefusesWhatIsNoLight) {
    EXPECT_EQ(complaint(DirectionalLightSettings{}), "");
    EXPECT_EQ(complaint(DirectionalLightSettings{{0, 0, 0}, 3, {1, 1, 1}}), "light-direction");
    EXPECT_EQ(complaint(DirectionalLightSettings{{0, kNaN, 0}, 3, {1, 1, 1}}), "light-direction");
    EXPECT_EQ(complaint(DirectionalLightSettings{{0, 1, 0}, -3, {1, 1, 1}}), "light-intensity");
    EXPECT_EQ(complaint(DirectionalLightSettings{{0, 1, 0}, 3, {-1, 1, 1}}), "light-colour");
}

TEST(ConstantLight, IsUniformOverTheSphere) {
    const auto light = make_light(ConstantLightSettings{{2, 1, 0.5}});
    const test::LightReport report = test::test_light(*light, {});
    EXPECT_GT(report.p_value, 0.01);
    EXPECT_NEAR(report.integral, 1, 1e-12);
    EXPECT_EQ(report.impossible, 0);
    // The integral of L over 4 pi; each sample has it.
    EXPECT_NEAR(report.mean.r, 8 * kPi, 1e-9);
    EXPECT_NEAR(report.mean.g, 4 * kPi, 1e-9);
    EXPECT_NEAR(report.mean.b, 2 * kPi, 1e-9);
    EXPECT_FALSE(light->is_delta());
    EXPECT_EQ(light->background({0, 1, 0}), (Rgb{2, 1, 0.5}));
    EXPECT_NEAR(light->weight(), kPi * luminance({2, 1, 0.5}), 1e-12);
}

TEST(ConstantLight, MayBeDarkButNotNegative) {
    const auto dark = make_light(ConstantLightSettings{{0, 0, 0}});
    EXPECT_FALSE(dark->sample({}, 0.5, 0.5));
    EXPECT_EQ(dark->pdf({0, 1, 0}), 0);
    EXPECT_EQ(dark->weight(), 0);
    EXPECT_EQ(complaint(ConstantLightSettings{{1, -1, 1}}), "light-colour");
}

}  // namespace
}  // namespace asperity

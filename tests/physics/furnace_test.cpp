// SPDX-License-Identifier: Apache-2.0
//
// The white furnace: a sphere in light that is 1 from everywhere shows the directional albedo of
// its BRDF, ring by ring of the angle under which it is seen. A BRDF that loses nothing cannot be
// seen at all.
#include "sphere_picture.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/tabulated.h>
#include <asperity/surface/make_surface.h>

#include <array>
#include <string>

namespace asperity {
namespace {

constexpr double kTolerance = 0.002;
constexpr std::uint32_t kSamples = 64;
/// Rings of 10 degrees; the last ends at 85.
constexpr int kRings = 9;
constexpr double kLastAngleDeg = 85;

/// Means over the pixels of each ring: of the picture, and of the albedo at the pixels' own angles.
struct Rings {
    std::array<double, kRings> seen{}, albedo{};
    std::array<double, kRings> error{};  ///< of `seen`, from how much pixels differ
    std::array<int, kRings> pixels{};
    double off = 0;  ///< share of the pixels that miss their albedo by more than kTolerance
};

Rings furnace(const Material& material, DirectLight direct, std::uint32_t spp) {
    RenderSettings settings = test::plain_picture(64, spp);
    settings.direct = direct;
    const Film film = test::picture(
        test::sphere_scene(material, {make_light(ConstantLightSettings{})}), settings);
    // The albedo of every other degree: finding it takes a while
    std::array<double, 45> albedo{};
    for (std::size_t k = 0; k <= 44; ++k)
        albedo[k] =
            luminance(material.albedo(from_spherical(radians(2 * static_cast<double>(k)), 0)));

    Rings rings;
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const auto point = test::sphere_point(settings, x, y);
            if (!point) continue;
            const double angle_deg = degrees(std::acos(dot(point->normal, point->view)));
            if (angle_deg > kLastAngleDeg) continue;
            const auto ring = static_cast<std::size_t>(angle_deg / 10);
            const auto k = static_cast<std::size_t>(angle_deg / 2);
            const double w = angle_deg / 2 - static_cast<double>(k);
            const double expected = (1 - w) * albedo[k] + w * albedo[k + 1];
            const double seen = luminance(film.at(x, y).mean);
            rings.seen[ring] += seen;
            rings.albedo[ring] += expected;
            rings.error[ring] += std::pow(seen - expected, 2);
            ++rings.pixels[ring];
            if (std::abs(seen - expected) > kTolerance) rings.off += 1;
        }
    int all = 0;
    for (std::size_t k = 0; k < kRings; ++k) {
        rings.seen[k] /= rings.pixels[k];
        rings.albedo[k] /= rings.pixels[k];
        rings.error[k] = std::sqrt(rings.error[k]) / rings.pixels[k];
        all += rings.pixels[k];
    }
    rings.off /= all;
    return rings;
}

void expect_albedo(const Rings& rings) {
    for (std::size_t k = 0; k < kRings; ++k) {
        EXPECT_GT(rings.pixels[k], 30);
        EXPECT_LT(rings.error[k], 0.5 * kTolerance) << "too noisy to tell";
        EXPECT_NEAR(rings.seen[k], rings.albedo[k], kTolerance) << "ring " << k;
    }
}

TEST(Furnace, WhiteLambertCannotBeSeen) {
    const Material white(parse_brdf_spec("lambert:albedo=1"));
    // Every direction the BRDF draws weighs 1: what is left is the mesh, which hides a direction
    // at the horizon now and then
    const Rings exact = furnace(white, DirectLight::BrdfOnly, 16);
    EXPECT_LT(exact.off, 0.005);
    for (const double ring : exact.seen) EXPECT_NEAR(ring, 1, 0.1 * kTolerance);
    const Rings mis = furnace(white, DirectLight::Mis, kSamples);
    for (const double ring : mis.seen) EXPECT_NEAR(ring, 1, kTolerance);
}

class AnalyticFurnace : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Models, AnalyticFurnace,
                         testing::Values("lambert:albedo=0.5", "ggx:alpha=0.2", "ggx:alpha=0.7",
                                         "beckmann:alpha=0.4,masking=separable",
                                         "cook-torrance:roughness=0.3",
                                         "cook-torrance:roughness=0.8,metallic=0"));

TEST_P(AnalyticFurnace, ShowsTheDirectionalAlbedo) {
    const Material material(parse_brdf_spec(GetParam()));
    for (const DirectLight direct : {DirectLight::Mis, DirectLight::BrdfOnly})
        expect_albedo(furnace(material, direct, kSamples));
}

TEST(Furnace, DiffuseTermIsAdded) {
    const Material material(parse_brdf_spec("ggx:alpha=0.3"),
                            {.normalize_factor = 0.5, .albedo = {0.4, 0.4, 0.4}});
    expect_albedo(furnace(material, DirectLight::Mis, kSamples));
}

TEST(Furnace, SimulatedMirrorSurfaceCannotBeSeen) {
    // F = 1 and all reflections counted: the surface loses nothing, whatever its shape
    SurfaceSettings surface;
    surface.kind = "gaussian";
    surface.size = 512;
    surface.correlation_x = surface.correlation_y = 6;
    surface.alpha_x = surface.alpha_y = 0.4;
    asperity::Run run(0);
    Experiment e;
    e.illumination.isotropic = true;
    e.illumination.theta_deg = {0, 15, 30, 45, 60, 70, 80, 87};
    e.detector.resolution = 72;
    e.run.rays = 400000;
    e.run.bounces = 64;
    const Measurement m = measure(make_surface(surface, run), e, run);
    for (const Layer& layer : m.layers)
        EXPECT_NEAR(m.albedo(layer, 0), 1, 1e-3) << "the table itself";
    const auto table = make_tabulated_brdf(m);
    const Rings rings = furnace(Material(bake_brdf(*table, run)), DirectLight::Mis, 4 * kSamples);
    expect_albedo(rings);
    for (const double ring : rings.seen) EXPECT_NEAR(ring, 1, kTolerance);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
//
// A sphere under the thesis' point light, pixel by pixel against the formulas, which are written
// out here once more. Lamps are as strong as makes the brightest pixel about 1, where a picture
// would be exposed. Left out is where a mesh of a million triangles is no sphere yet: the last
// degree before the terminator, and the last four before the silhouette, where a ray that meets a
// triangle 5e-6 below the sphere meets it 7e-5 and more beside the point that is computed.
#include "sphere_picture.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>

#include <algorithm>
#include <string>
#include <utility>

namespace asperity {
namespace {

/// Code 3.1 to 3.4 and 4.1 of the thesis, for one colour of a metal: D G F / (4 (n.v) (n.l) +
/// 0.0001).
double cook_torrance(double roughness, double albedo, Vec3 n, Vec3 v, Vec3 l) {
    const Vec3 h = normalize(v + l);
    const double a2 = std::pow(roughness, 4);
    const double d = a2 / (kPi * std::pow(std::pow(dot(n, h), 2) * (a2 - 1) + 1, 2));
    const double k = (roughness + 1) * (roughness + 1) / 8;
    const auto schlick = [&](Vec3 w) { return dot(n, w) / (dot(n, w) * (1 - k) + k); };
    const double f = albedo + (1 - albedo) * std::pow(1 - dot(h, v), 5);
    return d * schlick(v) * schlick(l) * f / (4 * dot(n, v) * dot(n, l) + 0.0001);
}

const double kLeastView = std::sin(radians(4)), kLeastLight = std::sin(radians(1));

/// Compares a picture with I / d^2 f cos in every pixel, to 1e-4.
template <typename Formula>
void expect_formula(const Material& material, double intensity, Formula f) {
    const PointLightSettings light{{1.5, 2, 3}, intensity, {1, 1, 1}};
    const RenderSettings settings = test::plain_picture(256, 1);
    const Film film = test::picture(test::sphere_scene(material, {make_light(light)}), settings);
    double worst = 0, most = 0;
    int lit = 0, dark = 0;
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const auto p = test::sphere_point(settings, x, y);
            if (!p || dot(p->normal, p->view) < kLeastView) continue;
            const Vec3 to_light = light.position - p->normal;
            const double distance = length(to_light);
            const Vec3 l = (1 / distance) * to_light;
            const double cosine = dot(p->normal, l);
            if (std::abs(cosine) < kLeastLight) continue;
            const Rgb seen = film.at(x, y).mean;
            if (cosine < 0) {
                EXPECT_EQ(seen, Rgb{});
                ++dark;
                continue;
            }
            ++lit;
            const Rgb brdf = f(p->normal, p->view, l);
            const Rgb expected = (light.intensity / (distance * distance) * cosine) * brdf;
            most = std::max(most, expected.r);
            worst = std::max({worst, std::abs(seen.r - expected.r), std::abs(seen.g - expected.g),
                              std::abs(seen.b - expected.b)});
        }
    EXPECT_GT(lit, 20000);
    EXPECT_GT(dark, 1000);
    EXPECT_GT(most, 0.7);
    EXPECT_LT(most, 1.1);
    EXPECT_LT(worst, 1e-4);
}

TEST(ClosedForm, LambertUnderAPointLight) {
    expect_formula(Material(parse_brdf_spec("lambert:albedo=0.8/0.5/0.3")), 32,
                   [](Vec3, Vec3, Vec3) {
                       return (1 / kPi) * Rgb{0.8, 0.5, 0.3};
                   });
}

TEST(ClosedForm, CookTorranceUnderAPointLight) {
    for (const auto& [roughness, intensity] : {std::pair{0.4, 2.5}, {0.7, 20.0}, {1.0, 60.0}}) {
        const Material material(parse_brdf_spec(
            "cook-torrance:metallic=1,albedo=1/0.8/0.3,roughness=" + std::to_string(roughness)));
        expect_formula(material, intensity, [r = roughness](Vec3 n, Vec3 v, Vec3 l) {
            return Rgb{cook_torrance(r, 1, n, v, l), cook_torrance(r, 0.8, n, v, l),
                       cook_torrance(r, 0.3, n, v, l)};
        });
    }
}

TEST(ClosedForm, ThesisSumUnderAPointLight) {
    // Eq. 4.1 and the shader of the simulated model: albedo / pi + factor * specular
    const Material material(parse_brdf_spec("cook-torrance:roughness=0.6,metallic=1,albedo=1/1/1"),
                            {.normalize_factor = 0.25, .albedo = {0.6, 0.3, 0.1}});
    expect_formula(material, 22, [](Vec3 n, Vec3 v, Vec3 l) {
        const double s = 0.25 * cook_torrance(0.6, 1, n, v, l);
        return (1 / kPi) * Rgb{0.6, 0.3, 0.1} + Rgb{s, s, s};
    });
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
//
// Three ways to find direct light, one mean: directions from the lights, from the BRDF, and both
// weighted by the balance heuristic. `render_bench --variance` prints their variances.
#include "sphere_picture.h"

#include <asperity/bsdf/spec.h>
#include <asperity/render/sky.h>

#include <fmt/format.h>

#include <string>

namespace asperity {
namespace {

struct Answer {
    double mean = 0, error = 0;  ///< of the luminance of all pixels, and its standard error
    double variance = 0;         ///< of one sample, mean over the pixels
};

Answer answer(const ModelScene& scene, DirectLight direct) {
    RenderSettings settings = test::plain_picture(32, 128);
    settings.direct = direct;
    settings.show_lights = false;
    const Film film = test::picture(scene, settings);
    Answer a;
    const auto n = static_cast<double>(film.pixels().size());
    for (const Pixel& pixel : film.pixels()) {
        a.mean += luminance(pixel.mean) / n;
        a.variance += pixel.variance() / n;
    }
    a.error = std::sqrt(a.variance / settings.spp / n);
    return a;
}

/// A sky with a sun of 10 degrees: small enough to be hard for the BRDF, and still found by it.
std::vector<std::shared_ptr<const Light>> sky() {
    SkySettings settings;
    settings.sun_diameter_deg = 10;
    std::vector<std::shared_ptr<const Light>> lights;
    for (auto& light : make_sky(settings)) lights.push_back(std::move(light));
    return lights;
}

class SameMean : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Models, SameMean,
                         testing::Values("lambert:albedo=0.8", "ggx:alpha=0.1", "ggx:alpha=0.3",
                                         "ggx:alpha=0.8", "cook-torrance:roughness=0.3"));

TEST_P(SameMean, WhicheverWayLightIsFound) {
    const ModelScene scene = test::sphere_scene(Material(parse_brdf_spec(GetParam())), sky());
    const Answer mis = answer(scene, DirectLight::Mis),
                 light = answer(scene, DirectLight::LightOnly),
                 brdf = answer(scene, DirectLight::BrdfOnly);
    EXPECT_NEAR(light.mean, mis.mean, 4 * std::hypot(light.error, mis.error));
    EXPECT_NEAR(brdf.mean, mis.mean, 4 * std::hypot(brdf.error, mis.error));
    EXPECT_LT(mis.error, 0.01 * mis.mean) << "too noisy to tell";
    // Veach's promise for the balance heuristic: never much worse than the better one, which a
    // sample from each costs at most
    EXPECT_LT(mis.variance, 1.5 * std::min(light.variance, brdf.variance));
    RecordProperty("variances", fmt::format("{:.4g} {:.4g} {:.4g}", mis.variance, light.variance,
                                            brdf.variance));
}

TEST(Mis, PointLightsAreFoundInEveryWay) {
    const ModelScene scene = test::sphere_scene(Material(parse_brdf_spec("ggx:alpha=0.4")),
                                                {make_light(PointLightSettings{{1, 1, 4}, 10})});
    const double mis = answer(scene, DirectLight::Mis).mean;
    EXPECT_GT(mis, 0.01);
    EXPECT_NEAR(answer(scene, DirectLight::LightOnly).mean, mis, 1e-12);
    EXPECT_NEAR(answer(scene, DirectLight::BrdfOnly).mean, mis, 1e-12);
}

TEST(Mis, ThesisStrataHaveTheSameMean) {
    const ModelScene scene = test::sphere_scene(Material(parse_brdf_spec("ggx:alpha=0.6")), sky());
    RenderSettings settings = test::plain_picture(32, 256);
    settings.show_lights = false;
    settings.integrator = Integrator::Stratified;
    settings.strata = 16;
    const Film film = test::picture(scene, settings);
    double mean = 0, squares = 0;
    const auto n = static_cast<double>(film.pixels().size());
    for (const Pixel& pixel : film.pixels()) {
        mean += luminance(pixel.mean) / n;
        squares += std::pow(pixel.standard_error(), 2);
    }
    const Answer mis = answer(scene, DirectLight::Mis);
    EXPECT_NEAR(mean, mis.mean, 4 * std::hypot(std::sqrt(squares) / n, mis.error));
}

}  // namespace
}  // namespace asperity

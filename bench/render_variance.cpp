// SPDX-License-Identifier: Apache-2.0
// What multiple importance sampling is worth: the same light found in three ways.
#include "render_scenes.h"
#include "render_tasks.h"

#include <asperity/bsdf/spec.h>
#include <asperity/render/sky.h>

#include <fmt/format.h>

#include <array>
#include <memory>
#include <utility>

namespace asperity::bench {

namespace {

struct RenderVarianceOptions {
    int size = 96;
    std::uint32_t samples = 256;
    double sun_diameter_deg = 5;
};

struct Outcome {
    double mean = 0, variance = 0;  ///< of the luminance; variance of a sample
    double error = 0;               ///< of the mean
};

Outcome outcome(const ModelScene& scene, const Camera& camera, const RenderVarianceOptions& options,
                DirectLight direct) {
    RenderSettings settings;
    settings.width = settings.height = options.size;
    settings.spp = options.samples;
    settings.depth = 1;
    settings.direct = direct;
    settings.filter = PixelFilter::Centre;
    settings.show_lights = false;
    Renderer renderer(scene, camera, settings);
    Run run;
    render(renderer, run);
    Outcome o;
    const auto pixels = static_cast<double>(renderer.film().pixels().size());
    for (const Pixel& pixel : renderer.film().pixels()) {
        o.mean += luminance(pixel.mean) / pixels;
        o.variance += pixel.variance() / pixels;
    }
    o.error = std::sqrt(o.variance / (options.samples * pixels));
    return o;
}

Report run_render_variance(const RenderVarianceOptions& options) {
    Report report;
    report.table = fmt::format(
        "Variance of a sample over the squared mean: sphere under a sky, sun {} degrees wide\n"
        "{:<28}{:>10}{:>10}{:>10}   means and standard errors\n",
        options.sun_diameter_deg, "BRDF", "MIS", "lights", "BRDF");
    SkySettings sky;
    sky.sun_diameter_deg = options.sun_diameter_deg;
    const RenderBench bench("sphere");
    const auto simulated = simulated_brdf(*measured_brdf());
    const std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> all = {
        {"ggx 0.02", parse_brdf_spec("ggx:alpha=0.02")},
        {"ggx 0.1", parse_brdf_spec("ggx:alpha=0.1")},
        {"ggx 0.3", parse_brdf_spec("ggx:alpha=0.3")},
        {"ggx 0.8", parse_brdf_spec("ggx:alpha=0.8")},
        {"cook-torrance 0.3", parse_brdf_spec("cook-torrance:roughness=0.3,metallic=1")},
        {"simulated 0.42", simulated},
        {"lambert", parse_brdf_spec("lambert:albedo=0.8")}};
    for (const auto& [name, brdf] : all) {
        say_next(name);
        ModelScene scene = bench.scene(Material(brdf), false);
        scene.lights.clear();
        for (auto& light : make_sky(sky)) scene.lights.push_back(std::move(light));
        constexpr std::array kWays = {DirectLight::Mis, DirectLight::LightOnly,
                                      DirectLight::BrdfOnly};
        std::array<Outcome, 3> o;
        for (std::size_t k = 0; k < kWays.size(); ++k)
            o[k] = outcome(scene, bench.camera, options, kWays[k]);
        const double scale = 1 / (o[0].mean * o[0].mean);
        report.table += fmt::format(
            "{:<28}{:>10.3g}{:>10.3g}{:>10.3g}   {:.4f} ± {:.4f}, {:.4f} ± {:.4f}, "
            "{:.4f} ± {:.4f}\n",
            name, scale * o[0].variance, scale * o[1].variance, scale * o[2].variance, o[0].mean,
            o[0].error, o[1].mean, o[1].error, o[2].mean, o[2].error);
        report.figures.push_back({{"brdf", name},
                                  {"mis", scale * o[0].variance},
                                  {"lights", scale * o[1].variance},
                                  {"brdf_only", scale * o[2].variance}});
    }
    return report;
}

}  // namespace

Task add_variance(CLI::App& program) {
    const auto options = std::make_shared<RenderVarianceOptions>();
    CLI::App* app = program.add_subcommand("variance", "MIS beside lights and BRDF alone");
    app->add_option("--size", options->size, "of the picture [pixels]")->capture_default_str();
    app->add_option("--samples", options->samples, "a pixel")->capture_default_str();
    app->add_option("--sun-diameter", options->sun_diameter_deg, "[degrees]")
        ->capture_default_str();
    return {app, [options] { return run_render_variance(*options); }};
}

}  // namespace asperity::bench

// SPDX-License-Identifier: Apache-2.0
// The thesis finds no difference between frames with the simulated BRDF and with Cook-Torrance.
#include "averages.h"
#include "render_scenes.h"
#include "render_tasks.h"
#include "task_options.h"

#include <asperity/bsdf/spec.h>

#include <fmt/format.h>

#include <memory>

namespace asperity::bench {

namespace {

struct RenderFrameOptions {
    int size = 256;
    int repetitions = 9;
};

struct View {
    const char* name;
    const char* model;
    bool sky;
    int depth;
    std::uint32_t passes;
};
constexpr View kViews[] = {{"knot, point light, direct", "knot", false, 1, 8},
                           {"knot, sky, direct", "knot", true, 1, 4},
                           {"bowl, sky, 4 reflections", "bowl", true, 4, 2}};

double total(const RayCounts& rays) {
    return static_cast<double>(rays.primary + rays.shadow + rays.bounce);
}

Report run_render_frame(const RenderFrameOptions& options) {
    Report report;
    report.table = fmt::format(
        "Frames of {0} x {0}: the simulated BRDF over Cook-Torrance\n"
        "{1:<28}{2:>16}{3:>16}{4:>8}{5:>14}\n",
        options.size, "view", "C-T ns/sample", "simulated", "ratio", "ratio of rays");
    const Material analytic(parse_brdf_spec("cook-torrance:roughness=0.65,metallic=1"));
    const Material simulated(simulated_brdf(*measured_brdf()));
    for (const View& view : kViews) {
        say_next(view.name);
        const RenderBench bench(view.model);
        RenderSettings settings;
        settings.width = settings.height = options.size;
        settings.depth = view.depth;
        const ModelScene ours = bench.scene(simulated, view.sky),
                         theirs = bench.scene(analytic, view.sky);
        // In turns, and the median of the ratios: what else the machine does falls on both
        std::vector<double> a, b, ratios;
        RayCounts their_rays, our_rays;
        for (int k = 0; k < options.repetitions; ++k) {
            a.push_back(frame_seconds(theirs, bench.camera, settings, view.passes, &their_rays));
            b.push_back(frame_seconds(ours, bench.camera, settings, view.passes, &our_rays));
            ratios.push_back(b.back() / a.back());
        }
        const double to_ns = 1e9 / (1.0 * options.size * options.size * view.passes);
        // A BRDF that loses no light draws no direction in vain: its paths go farther
        const double rays = total(our_rays) / total(their_rays);
        report.table += fmt::format("{:<28}{:>16.0f}{:>16.0f}{:>8.2f}{:>14.2f}\n", view.name,
                                    median(a) * to_ns, median(b) * to_ns, median(ratios), rays);
        report.figures.push_back({{"view", view.name},
                                  {"cook_torrance_ns", median(a) * to_ns},
                                  {"simulated_ns", median(b) * to_ns},
                                  {"ratio", median(ratios)},
                                  {"ratio_of_rays", rays}});
    }
    return report;
}

}  // namespace

Task add_frame(CLI::App& program) {
    const auto options = std::make_shared<RenderFrameOptions>();
    CLI::App* app = program.add_subcommand("frame", "simulated BRDF over Cook-Torrance");
    app->add_option("--size", options->size, "of the picture [pixels]")->capture_default_str();
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_render_frame(*options); }};
}

}  // namespace asperity::bench

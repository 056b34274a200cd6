// SPDX-License-Identifier: Apache-2.0
// asperity render: a model in light, wearing measured and analytic BRDFs.
#include "console.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "progress.h"
#include "render_lights.h"
#include "render_materials.h"
#include "render_options.h"
#include "render_report.h"
#include "stop.h"
#include "verbs.h"

#include <asperity/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace asperity::cli {

namespace {

constexpr const char* kRenderClosing =
    "The picture gets better sample by sample: --spp says how often, --until how clean it shall\n"
    "be. Ctrl-C writes what is there. An EXR holds linear light and, per pixel, its standard "
    "error;\n"
    "both formats hold the options that made them. --integrator stratified and --direct light or\n"
    "brdf are there to show what they cost.\n"
    "\n"
    "Examples\n"
    "  asperity render --model knot --brdf metal.asperity -o knot.png\n"
    "  asperity render --model bunny.obj --brdf metal.asperity --brdf "
    "cook-torrance:roughness=0.55 \\\n"
    "      --light env:hall.exr --until 2% -o bunny.png -o bunny.exr\n"
    "  asperity render --model sphere --brdf ggx:alpha=0.3,material=Au --light point \\\n"
    "      --depth 1 --tonemap thesis -o thesis.png\n"
    "  asperity render --model bowl --floor --camera-elevation 25 --sun-elevation 30 -o bowl.png\n";

class RenderVerb {
  public:
    explicit RenderVerb(CLI::App& app) {
        options_.add_to(app);
        threads_.add_to(app);
        output_ =
            add_text(app, "-o,--output", "X.png | X.exr",
                     "the picture: for screens, or linear; may be given more than once; - writes "
                     "a PNG to standard output",
                     kOutput)
                ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        app.add_flag("--json", json_, "print one JSON object")->group(kOutput);
        app.add_flag("--quiet", quiet_, "no progress, no report")->group(kOutput);
        set_help(app, "render --model NAME|FILE --brdf SPEC|FILE [options] -o X.png",
                 kRenderClosing);
    }

    int run() {
        options_.read();
        const RenderSettings settings = render_settings(options_);
        const ToneMapping tone = tone_mapping(options_);
        const Camera view = camera(options_);
        check_materials(options_);
        check_lights(options_);
        check_outputs();

        Run run(threads_.threads());
        const Talk say(quiet_, json_ || piped());
        const StopOnSignal stop(run);
        ProgressBar progress(run, quiet_);

        const LoadedModel loaded = load_model(options_);
        say(model_lines(loaded));
        auto lights = load_lights(options_);
        Materials materials = load_materials(options_, run);
        progress.clear();
        const ModelScene scene{std::make_shared<TracedModel>(loaded.model, run), materials.left,
                               materials.split, materials.stage, std::move(lights)};
        progress.clear();
        say(scene_lines(scene));

        Renderer renderer(scene, view, settings);
        Picture picture{loaded, scene, view, renderer, render(renderer, run), {}};
        progress.clear();
        if (renderer.rays().primary == 0) {
            throw Error(ErrorCode::Stopped,
                        "stopped before anything was to be seen, nothing is "
                        "written");
        }
        write(picture, tone, materials.origin);
        tell(say, picture);
        return picture.outcome.stopped ? static_cast<int>(ErrorCode::Stopped) : 0;
    }

  private:
    void check_outputs() const {
        if (output_->count() == 0)
            throw Error(ErrorCode::Usage, "render needs -o with a name ending in .png or .exr");
        const std::vector<std::string> paths = output_->results();
        for (const std::string& path : paths) {
            if (path == kStandardOutput) continue;
            if (ending(path) != "png" && ending(path) != "exr")
                throw Error(ErrorCode::Usage, "the name must end in .png or .exr", path);
            check_output_file(path);
        }
        const bool screens = std::any_of(paths.begin(), paths.end(), [](const std::string& path) {
            return path == kStandardOutput || ending(path) == "png";
        });
        for (const char* option : {"tonemap", "exposure", "transfer"})
            if (!screens && options_.given(option))
                throw Error(ErrorCode::Usage, "it is for a PNG: an EXR holds the light as it is",
                            option);
        if (piped() && json_)
            throw Error(ErrorCode::Usage,
                        "standard output takes the picture: -o FILE leaves it free", "json");
    }

    /// Whether the picture, a PNG, goes to standard output.
    bool piped() const {
        const auto paths = output_->results();
        return std::find(paths.begin(), paths.end(), kStandardOutput) != paths.end();
    }

    void write(Picture& picture, const ToneMapping& tone, const io::Provenance& origin) const {
        io::Provenance provenance = options_.provenance();
        for (const auto& more : {outcome_provenance(picture), origin})
            provenance.insert(provenance.end(), more.begin(), more.end());
        for (const std::string& path : output_->results()) {
            if (path == kStandardOutput) {
                const StandardOutputFile file("png");
                io::write_render_png(picture.renderer.film(), tone, provenance, file.path());
                file.send();
                continue;
            }
            if (ending(path) == "exr") {
                io::write_render_exr(picture.renderer.film(), provenance, path);
            } else {
                io::write_render_png(picture.renderer.film(), tone, provenance, path);
            }
            picture.files.push_back(path);
        }
    }

    void tell(const Talk& say, const Picture& picture) const {
        if (json_) write_json(to_json(picture));
        say(outcome_line(picture));
        for (const std::string& path : picture.files)
            say(fmt::format("wrote {}{}\n", path, picture.outcome.stopped ? " (partial)" : ""));
        say("checksum " + checksum(picture.renderer.film()) + "\n");
    }

    RenderOptions options_;
    ThreadsOption threads_;
    CLI::Option* output_ = nullptr;
    bool json_ = false, quiet_ = false;
};

}  // namespace

Verb add_render(CLI::App& program) {
    CLI::App* app = program.add_subcommand("render", "show a model with BRDFs assigned to it");
    const auto verb = std::make_shared<RenderVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

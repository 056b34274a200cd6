// SPDX-License-Identifier: Apache-2.0
// asperity simulate: the main job. Surface and light in, layers of a BRDF out.
#include "console.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "progress.h"
#include "report.h"
#include "report_json.h"
#include "stop.h"
#include "verbs.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/compare.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kClosing =
    "Each layer is one incident direction. The table shows, per layer, the albedo (the share of\n"
    "the light that leaves again) with its standard error, how that light divides over the number\n"
    "of reflections, what was absorbed, what was still travelling after --bounces reflections, "
    "and\n"
    "the L1 distance of the lobe to a reference model (0 equal, 2 apart). Ctrl-C stops and keeps\n"
    "what is complete.\n"
    "\n"
    "Examples\n"
    "  asperity simulate --surface thesis --roughness 0.2 -o thesis.asperity\n"
    "  asperity simulate --surface gaussian --alpha 0.3 --isotropic --until 1% -o rough.asperity\n"
    "  asperity simulate --surface heights.gsf --fresnel conductor --material Au --theta 0,30,60 "
    "\\\n"
    "      --rays 1000000 -o gold.asperity\n"
    "  asperity simulate --config run.txt --seed 2 -o second.asperity\n";

/// The thesis' model with F = 1 and roughness^2 = alpha, at most 1. A surface smoother than this
/// has no lobe to compare with.
constexpr double kLeastAlpha = 1e-3;

std::string default_reference(const SurfaceSettings& settings, const SurfaceStatistics& figures) {
    // GGX slopes have no finite mean square: the asked width is the surface's alpha.
    const double alpha = surface_uses(settings.kind, "max-slope")
                             ? std::sqrt(settings.alpha_x * settings.alpha_y)
                             : figures.rms_gradient;
    if (alpha < kLeastAlpha) return "none";
    return fmt::format("cook-torrance:roughness={:.4g},metallic=1,albedo=1",
                       std::min(1.0, std::sqrt(alpha)));
}

class SimulateVerb {
  public:
    explicit SimulateVerb(CLI::App& app) {
        experiment_.add_to(app, {kSurface, kLight, kFacets, kDetector, kRun}, true);
        threads_.add_to(app);
        output_ = add_text(app, "-o,--output", "FILE", "save the result: counts, errors, settings",
                           kOutput)
                      ->default_str("only the table is shown");
        reference_ = add_text(app, "--reference", "SPEC|none",
                              "model for the L1 column, as compare takes it", kOutput)
                         ->default_str("Cook-Torrance with roughness^2 = alpha");
        app.add_flag("--json", json_, "print one JSON object, as info --json does")->group(kOutput);
        app.add_flag("--quiet", quiet_, "no progress, no table")->group(kOutput);
        set_help(app, "simulate --surface SPEC|FILE [options] -o FILE", kClosing);
    }

    int run() {
        Experiment experiment = experiment_.read();
        check(experiment);
        Run run(threads_.threads());
        const Talk say(quiet_, json_);
        const StopOnSignal stop(run);
        ProgressBar progress(run, quiet_);

        const Heightfield surface = io::load_surface(experiment.surface, run);
        if (!experiment_.rays_given()) experiment.run.jitter = default_jitter(surface.cell_count());
        MeasureListener listener;
        listener.begun = [&](const Measurement& head) {
            progress.clear();
            describe(say, head, surface);
        };
        // A run that refines until it is accurate gives each layer the rays it needs.
        if (experiment.run.until == 0) {
            progress.count_layers(incidences(experiment.illumination).size());
        }
        const Measurement m = measure(surface, experiment, run, listener);
        progress.clear();

        if (m.stopped && m.layers.empty()) {
            throw Error(ErrorCode::Stopped,
                        "stopped before anything was complete, nothing is "
                        "written");
        }
        const std::string checksum =
            output_->count() > 0 ? io::save_measurement(m, text_of(output_)) : io::checksum(m);
        tell(say, m, checksum, run);
        return m.stopped ? static_cast<int>(ErrorCode::Stopped) : 0;
    }

  private:
    /// Refuses what would fail only after the work is done.
    void check(const Experiment& experiment) const {
        validate(experiment);
        const Fresnel checked(experiment.optics);
        const std::string reference = text_of(reference_, "none");
        if (reference != "none") parse_brdf_spec(reference);
        if (output_->count() > 0) check_output_file(text_of(output_));
    }

    void describe(const Talk& say, const Measurement& head, const Heightfield& surface) const {
        if (quiet_) return;
        const SurfaceSettings& settings = head.experiment.surface;
        say("surface: " + surface_line(settings, head.surface, surface.nx, surface.ny) + "\n");
        const std::string tiling = tiling_line(settings, surface);
        if (!tiling.empty()) say("surface: " + tiling + "\n");
    }

    void tell(const Talk& say, const Measurement& m, const std::string& checksum,
              const Run& run) const {
        const bool written = output_->count() > 0;
        if (json_) {
            Json json = to_json(m, checksum);
            json["file"] = nullptr;
            if (written) json["file"] = text_of(output_);
            write_json(json);
        }
        if (quiet_) return;
        std::string reference = text_of(reference_);
        if (reference.empty()) reference = default_reference(m.experiment.surface, m.surface);
        std::optional<Comparison> comparison;
        if (reference != "none") {
            comparison = compare(m, *parse_brdf_spec(reference), run.threads());
        }
        say(layer_table(m, comparison));
        if (comparison) {
            say("L1: distance to " + reference +
                "; noise: what it would be from the errors alone\n");
        }
        say(closing_lines(m));
        if (written) {
            say(fmt::format("wrote {}{}\n", text_of(output_), m.stopped ? " (partial)" : ""));
        }
        say("checksum " + checksum + "\n");
    }

    ExperimentOptions experiment_;
    ThreadsOption threads_;
    CLI::Option *output_ = nullptr, *reference_ = nullptr;
    bool json_ = false, quiet_ = false;
};

}  // namespace

Verb add_simulate(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("simulate", "shoot light at a surface and measure its BRDF");
    const auto verb = std::make_shared<SimulateVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

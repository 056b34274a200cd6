// SPDX-License-Identifier: Apache-2.0
// asperity simulate: the main job. Surface and light in, layers of a BRDF out.
#include "file_kind.h"
#include "help.h"
#include "measuring.h"
#include "options.h"
#include "verbs.h"

#include <asperity/core/error.h>

#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kSimulateClosing =
    "Each layer is one incident direction. The table shows, per layer, the albedo (the share of\n"
    "the light that leaves again) with the standard error of its last digits; of the incoming\n"
    "light, what leaves after one, two and more reflections, what is absorbed and what still\n"
    "travels after --bounces reflections; and the L1 distance of the lobe to a reference model\n"
    "(0 equal, 2 apart). A run of more than a minute says first what will take the time. Ctrl-C\n"
    "stops and keeps what is complete. -o - writes the result to standard output.\n"
    "\n"
    "Examples\n"
    "  asperity simulate --surface thesis --roughness 0.2 -o thesis.asperity\n"
    "  asperity simulate --surface gaussian --alpha 0.3 --isotropic --until 1% -o rough.asperity\n"
    "  asperity simulate --surface heights.gsf --fresnel conductor --material Au --theta 0,30,60 "
    "\\\n"
    "      --rays 1000000 -o gold.asperity\n"
    "  asperity simulate --config run.txt --seed 2 -o second.asperity\n"
    "  asperity simulate --config run.txt -o long.asperity --resume      (after a crash)\n"
    "  asperity simulate --config run.txt -o part3.asperity --part 3/8   (then asperity merge)\n";

class SimulateVerb {
  public:
    explicit SimulateVerb(CLI::App& app) {
        experiment_.add_to(app, {kSurface, kLight, kFacets, kDetector, kRun}, true);
        measuring_.add_run(app);
        part_ =
            add_text(app, "--part", "K/N",
                     "do share K of N of the work; asperity merge puts the shares together", kRun)
                ->default_str("all of it");
        measuring_.add_output(app, "only the table is shown");
        set_help(app, "simulate --surface SPEC|FILE [options] -o FILE", kSimulateClosing);
    }

    int run() {
        Measuring::Task task;
        task.experiment = experiment_.read();
        if (task.experiment.surface.kind == kSurfaceFile)
            require_kind(task.experiment.surface.file, FileKind::Heights);
        read_part(task);
        const std::string path = measuring_.has_output() ? measuring_.output() : "";
        measuring_.check(task.experiment, path);
        return measuring_.measure(std::move(task), path);
    }

  private:
    void read_part(Measuring::Task& task) const {
        if (part_->count() == 0) return;
        constexpr int kMostParts = 1000000;
        const std::string text = text_of(part_);
        const std::size_t slash = text.find('/');
        if (slash == std::string::npos)
            throw Error(ErrorCode::Usage, "'" + text + "' is not K/N, such as 3/8", "part");
        task.parts = parse_count("part", text.substr(slash + 1), 1, kMostParts);
        task.part = parse_count("part", text.substr(0, slash), 1, task.parts);
        if (task.experiment.run.until > 0)
            throw Error(ErrorCode::Usage,
                        "no part can know when all of them are accurate: leave --until out, and "
                        "refine what is merged",
                        "part");
        if (!measuring_.has_output()) throw Error(ErrorCode::Usage, "needs -o FILE", "part");
    }

    ExperimentOptions experiment_;
    Measuring measuring_;
    CLI::Option* part_ = nullptr;
};

}  // namespace

Verb add_simulate(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("simulate", "shoot light at a surface and measure its BRDF");
    const auto verb = std::make_shared<SimulateVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

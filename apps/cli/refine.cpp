// SPDX-License-Identifier: Apache-2.0
// asperity refine: more rays for a result that is there, until it is as accurate as asked.
#include "file_kind.h"
#include "help.h"
#include "measuring.h"
#include "options.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>

#include <fmt/format.h>

#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kRefineClosing =
    "The result comes out as if it had been asked for at once: nothing is measured twice. The\n"
    "surface is made or read again, and must be the same.\n"
    "\n"
    "Examples\n"
    "  asperity refine rough.asperity --until 0.5%\n"
    "  asperity refine rough.asperity --until 0.5%,5% -o fine.asperity\n"
    "  asperity refine rough.asperity --until 0.1% --max-rays 1e9 --resume   (after a crash)\n";

class RefineVerb {
  public:
    explicit RefineVerb(CLI::App& app) {
        file_ = add_text(app, "file", "FILE", "a result of asperity simulate", "");
        until_ = add_text(app, "--until", "P[,Q]",
                          "go on until the relative standard error of the albedo is below P, and "
                          "that of the cells with 90 % of the energy below Q (P if not given): 1% "
                          "or 0.01",
                          kRun);
        max_rays_ = add_text(app, "--max-rays", "N", "no more rays per layer than this", kRun)
                        ->default_str("256 x the first estimate");
        measuring_.add_run(app);
        measuring_.add_output(app, "FILE itself");
        set_help(app, "refine FILE --until P[,Q] [options]", kRefineClosing);
    }

    int run() {
        if (file_->count() == 0) throw Error(ErrorCode::Usage, "refine needs a result file");
        if (until_->count() == 0)
            throw Error(ErrorCode::Usage, "refine needs --until, the error to reach");
        const std::string file = text_of(file_);
        const std::string path = measuring_.has_output() ? measuring_.output() : file;
        Measuring::Task task;
        task.so_far = load_result(file);
        if (task.so_far->parts > 1)
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("it is part {}/{} of a measurement: merge the parts first",
                                    task.so_far->part, task.so_far->parts),
                        file);
        task.experiment = task.so_far->experiment;
        apply_setting(task.experiment, "until", text_of(until_));
        if (max_rays_->count() > 0) apply_setting(task.experiment, "max-rays", text_of(max_rays_));
        refuse_looser(task.so_far->experiment.run, task.experiment.run);
        measuring_.check(task.experiment, path);
        return measuring_.measure(std::move(task), path);
    }

  private:
    /// A looser error would have been reached with fewer rays than there are.
    static void refuse_looser(const RunSettings& was, const RunSettings& asked) {
        const auto cells = [](const RunSettings& run) {
            return run.until_cells > 0 ? run.until_cells : run.until;
        };
        if (asked.until == 0)
            throw Error(ErrorCode::Usage, "an error of 0 is never reached", "until");
        if (was.until > 0 && (asked.until > was.until || cells(asked) > cells(was)))
            throw Error(ErrorCode::Usage,
                        fmt::format("it was measured until {:g}%,{:g}% already: ask for less",
                                    100 * was.until, 100 * cells(was)),
                        "until");
    }

    Measuring measuring_;
    CLI::Option *file_ = nullptr, *until_ = nullptr, *max_rays_ = nullptr;
};

}  // namespace

Verb add_refine(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("refine", "add rays to a result until it is more accurate");
    const auto verb = std::make_shared<RefineVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

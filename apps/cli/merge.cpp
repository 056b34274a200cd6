// SPDX-License-Identifier: Apache-2.0
// asperity merge: the parts of a measurement, made on many machines, become one result.
#include "file_kind.h"
#include "help.h"
#include "measuring.h"
#include "options.h"
#include "output_path.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/core/run.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/merge.h>

#include <memory>
#include <string>
#include <vector>

namespace asperity::cli {

namespace {

constexpr const char* kMergeClosing =
    "All parts must be there, of one experiment, each batch once; their order does not matter. "
    "The\n"
    "result is that of a run which did everything by itself, to the bit.\n"
    "\n"
    "Examples\n"
    "  asperity simulate --config run.txt --part 1/2 -o part1.asperity\n"
    "  asperity simulate --config run.txt --part 2/2 -o part2.asperity\n"
    "  asperity merge part1.asperity part2.asperity -o whole.asperity\n"
    "  asperity merge part*.asperity -o whole.asperity --json\n"
    "  asperity merge gold.asperity.*-of-100 -o gold.asperity     (of a job array)\n";

class MergeVerb {
  public:
    explicit MergeVerb(CLI::App& app) {
        app.add_option("files", files_, "results of asperity simulate --part K/N")
            ->type_name("FILE...");
        measuring_.add_output(app, "none: it must be given");
        set_help(app, "merge FILE... -o FILE", kMergeClosing);
    }

    int run() {
        if (files_.empty()) throw Error(ErrorCode::Usage, "merge needs the files of the parts");
        if (!measuring_.has_output()) throw Error(ErrorCode::Usage, "merge needs -o FILE");
        measuring_.check_output();
        Merge merge;
        for (const std::string& file : files_) merge.add(load_result(file), file);
        measuring_.finish(merge.finish(), measuring_.output(), Run().threads());
        return 0;
    }

  private:
    Measuring measuring_;
    std::vector<std::string> files_;
};

}  // namespace

Verb add_merge(CLI::App& program) {
    CLI::App* app = program.add_subcommand("merge", "put the parts of a measurement together");
    const auto verb = std::make_shared<MergeVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
// asperity selftest: the thesis' "Run Test". Does this build of the program do what it should?
#include "console.h"
#include "help.h"
#include "options.h"
#include "verbs.h"

#include <asperity/core/run.h>
#include <checks/checks.h>

#include <fmt/format.h>

#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kSelftestClosing =
    "Prints a line per check and the totals; the exit code is 1 when one failed. The thesis' Run\n"
    "Test comes first, with a total of its own: 75 texture checks (15 layers at 5 resolutions, on\n"
    "real textures) and 4 of loading a small and a large model. Then physics: surfaces and lobes "
    "known\n"
    "by hand, metals, reciprocity, error bars, tables between their layers. Some seconds in all.\n"
    "\n"
    "Examples\n"
    "  asperity selftest\n"
    "  asperity selftest --quiet && echo all is well\n"
    "  asperity selftest --threads 1\n";

class SelftestVerb {
  public:
    explicit SelftestVerb(CLI::App& app) {
        threads_.add_to(app);
        app.add_flag("--quiet", quiet_, "print only what failed, and the total")->group(kOutput);
        set_help(app, "selftest [options]", kSelftestClosing);
    }

    int run() const {
        Run run(threads_.threads());
        int done = 0, passed = 0;
        const checks::CheckReport report = [&](const std::string& name,
                                               const std::string& failure) {
            ++done;
            if (failure.empty()) ++passed;
            if (quiet_ && failure.empty()) return;
            write_out(failure.empty() ? fmt::format("{} ... PASSED\n", name)
                                      : fmt::format("{} ... FAILED: {}\n", name, failure));
        };
        checks::check_thesis(run, report);
        write_out(fmt::format("{} of {} passed: the thesis' Run Test\n", passed, done));
        checks::check_surfaces(run, report);
        checks::check_light(run, report);
        checks::check_reflection(run, report);
        checks::check_statistics(run, report);
        write_out(fmt::format("{} of {} passed\n", passed, done));
        return passed == done ? 0 : 1;
    }

  private:
    ThreadsOption threads_;
    bool quiet_ = false;
};

}  // namespace

Verb add_selftest(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("selftest", "check that this program works as it should");
    const auto verb = std::make_shared<SelftestVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

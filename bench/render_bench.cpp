// SPDX-License-Identifier: Apache-2.0
// How fast the model scene is drawn, and how much noise is left. docs/performance.md says what is
// measured.
#include "json_file.h"
#include "render_tasks.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace {

using namespace asperity::bench;

int main_of(int argc, char** argv) {
    CLI::App program("Speed of the renderer, as ratios; without a subcommand, all of them");
    std::string json_file;
    program.add_option("--json", json_file, "file to add all figures to");
    const std::vector<Task> tasks = {add_frame(program), add_rays(program), add_shade(program),
                                     add_variance(program)};
    CLI11_PARSE(program, argc, argv);

    const bool all = program.get_subcommands().empty();
    for (const Task& task : tasks) {
        if (!all && !task.app->parsed()) continue;
        fmt::print(stderr, "{} ...\n", task.app->get_name());
        const Report report = task.run();
        fmt::print("{}\n", report.table);
        std::fflush(stdout);
        if (!json_file.empty())
            add_to_json(json_file, "render_" + task.app->get_name(), report.figures);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return main_of(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "render_bench: error: {}\n", e.what());
        return 1;
    }
}

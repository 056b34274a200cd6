// SPDX-License-Identifier: Apache-2.0
// How the product's speed depends on the size of the surface, on threads and on the reflectance,
// and where the time of a whole run goes. docs/performance.md says what is measured.
#include "json_file.h"
#include "product_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace {

using namespace asperity::bench;

int main_of(int argc, char** argv) {
    CLI::App program("Speed of whole measurements; without a subcommand, all of them");
    std::string json_file;
    program.add_option("--json", json_file, "file to add all figures to");
    const std::vector<Task> tasks = {add_growth(program), add_threads(program),
                                     add_fresnel(program), add_stages(program)};
    CLI11_PARSE(program, argc, argv);

    const bool all = program.get_subcommands().empty();
    for (const Task& task : tasks) {
        if (!all && !task.app->parsed()) continue;
        fmt::print(stderr, "{} ...\n", task.app->get_name());
        const Report report = task.run();
        fmt::print("{}\n", report.table);
        std::fflush(stdout);
        if (!json_file.empty()) add_to_json(json_file, task.app->get_name(), report.figures);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return main_of(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "product_bench: error: {}\n", e.what());
        return 1;
    }
}

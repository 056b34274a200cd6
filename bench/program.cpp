// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include "json_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

namespace asperity::bench {

void say_next(const std::string& what) {
    fmt::print(stderr, "  {} ...\n", what);
}

int guarded_main(const std::string& name, const std::function<int()>& body) {
    try {
        return body();
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}: error: {}\n", name, e.what());
        return 1;
    }
}

int run_tasks(const std::string& about, std::initializer_list<AddTask> tasks,
              const std::string& section, int argc, char** argv) {
    CLI::App program(about + "; without a subcommand, all of them");
    std::string json_file;
    program.add_option("--json", json_file, "file to add all figures to");
    std::vector<Task> added;
    for (const AddTask add : tasks) added.push_back(add(program));
    CLI11_PARSE(program, argc, argv);

    const bool all = program.get_subcommands().empty();
    for (const Task& task : added) {
        if (!all && !task.app->parsed()) continue;
        const std::string name = task.app->get_name();
        fmt::print(stderr, "{} ...\n", name);
        const Report report = task.run();
        fmt::print("{}\n", report.table);
        std::fflush(stdout);
        if (!json_file.empty()) add_to_json(json_file, section + name, report.figures);
    }
    return 0;
}

}  // namespace asperity::bench

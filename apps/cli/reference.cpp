// SPDX-License-Identifier: Apache-2.0
// asperity reference: the page of all settings and kinds of surface, docs/reference.md.
#include "console.h"
#include "help.h"
#include "options.h"
#include "verbs.h"

#include <asperity/gonio/experiment_params.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

namespace asperity::cli {

namespace {

constexpr const char* kClosing =
    "Examples\n"
    "  asperity reference > reference.md\n"
    "  asperity reference | grep alpha\n"
    "  asperity reference | less\n";

constexpr const char* kOpening =
    "# Reference: settings and kinds of surface\n"
    "\n"
    "Printed by `asperity reference` from the tables that the program itself reads; a test "
    "compares\n"
    "this page with them. A name is the option of the command line (`--alpha 0.3`), the key of\n"
    "`--config` files and sessions (`alpha = 0.3`), of a surface's text (`gaussian:alpha=0.3`) and "
    "of\n"
    "`--json`.\n";

/// Text for a cell of a table.
std::string cell(const std::string& text) {
    std::string cell;
    for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
    return cell;
}

std::string values(const ParamInfo& info) {
    std::string text = info.type == ParamType::Flag ? "true, false" : info.range.text();
    if (info.type == ParamType::Choice) text = fmt::format("{}", fmt::join(info.choices, ", "));
    if (text.empty() && info.type == ParamType::Natural) text = "0 .. 2^64 - 1";
    if (info.type == ParamType::List) text = "list" + (text.empty() ? "" : ": " + text);
    if (info.type == ParamType::Pair) text = "one or two: " + text;
    if (!info.absent.empty()) text += (text.empty() ? "" : ", or ") + info.absent;
    return text;
}

std::string settings_page() {
    std::string text, group;
    for (const Param<Experiment>& param : experiment_params()) {
        const ParamInfo& info = param.info;
        if (group != info.group) {
            group = info.group;
            text += fmt::format(
                "\n## {}\n\n| setting | values | unit | default | what it does |\n"
                "|---|---|---|---|---|\n",
                group);
        }
        const std::string otherwise =
            info.otherwise.empty() ? param.default_text() : info.otherwise;
        const std::string users = info.users.empty() ? "" : info.users + ": ";
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", info.name, cell(values(info)),
                            info.unit, cell(otherwise), cell(users + info.doc));
    }
    return text;
}

std::string kinds_page() {
    std::string text =
        "\n## Kinds of surface\n\n| kind | what it is | its settings |\n|---|---|---|\n";
    for (const SurfaceKind& kind : surface_kinds()) {
        std::vector<std::string> names = kind.params;
        for (const auto& param : kind.own) names.push_back(param.info.name);
        text +=
            fmt::format("| `{}` | {} | {} |\n", kind.name, cell(kind.doc), fmt::join(names, ", "));
    }
    return text + "\nAll of them use size, boundary, cell-size, height-scale and diagonal; files " +
           "of heights use\nthe last four and the settings that name files as their users.\n";
}

}  // namespace

Verb add_reference(CLI::App& program) {
    CLI::App* app =
        program.add_subcommand("reference", "print the page of all settings and kinds of surface");
    set_help(*app, "reference", kClosing);
    return {app, [] {
                write_out(kOpening + kinds_page() + settings_page());
                return 0;
            }};
}

}  // namespace asperity::cli

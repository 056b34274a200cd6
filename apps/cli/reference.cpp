// SPDX-License-Identifier: Apache-2.0
// asperity reference: the page of all settings and kinds of surface, docs/reference.md.
#include "completion.h"
#include "console.h"
#include "help.h"
#include "manual_page.h"
#include "options.h"
#include "output_path.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/plots/files/plot_file_params.h>
#include <asperity/plots/plot_settings.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kReferenceClosing =
    "man writes the page of a verb of the manual, or with -o those of all; bash and zsh what "
    "these\n"
    "shells read to complete a command.\n"
    "\n"
    "Examples\n"
    "  asperity reference > reference.md\n"
    "  asperity reference --format man simulate | man -l -\n"
    "  asperity reference --format bash > ~/.local/share/bash-completion/completions/asperity\n"
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

/// The settings of a table, under the headings of their groups.
template <typename Settings>
std::string settings_page(const ParamTable<Settings>& table) {
    std::string text, group;
    for (const Param<Settings>& param : table) {
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

constexpr const char* kFormats[] = {"markdown", "man", "bash", "zsh"};

class ReferenceVerb {
  public:
    ReferenceVerb(const CLI::App& program, CLI::App& app) : program_(&program) {
        verb_ = add_text(app, "verb", "VERB", "whose page of the manual, with --format man", "");
        format_ = add_text(app, "--format", "NAME",
                           "markdown (docs/reference.md), man, bash or zsh (completion)", kOutput)
                      ->default_str("markdown");
        folder_ = add_text(app, "-o,--output", "FOLDER/",
                           "with --format man: the pages of the program and of all verbs", kOutput);
        set_help(app, "reference [--format NAME] [VERB]", kReferenceClosing);
    }

    int run() const {
        const std::string format = text_of(format_, "markdown");
        if (std::find(std::begin(kFormats), std::end(kFormats), format) == std::end(kFormats))
            throw Error(ErrorCode::Usage,
                        fmt::format("'{}' is none of {}", format, fmt::join(kFormats, ", ")),
                        "format");
        for (const CLI::Option* option : {verb_, folder_})
            if (option->count() > 0 && format != "man")
                throw Error(ErrorCode::Usage, "it is for --format man",
                            option == verb_ ? text_of(verb_) : "output");
        if (folder_->count() > 0) return write_all(text_of(folder_));
        if (format == "markdown")
            write_out(kOpening + kinds_page() + settings_page(experiment_params()) +
                      settings_page(plots::plot_params()) +
                      settings_page(plots::plot_file_params()));
        if (format == "bash") write_out(bash_completion(*program_));
        if (format == "zsh") write_out(zsh_completion(*program_));
        if (format == "man")
            write_out(verb_->count() == 0 ? program_manual(*program_)
                                          : verb_manual(find_verb(*program_, text_of(verb_))));
        return 0;
    }

  private:
    int write_all(const std::string& folder) const {
        check_output_folder(folder);
        std::filesystem::create_directories(folder);
        const auto write = [&](const std::string& name, const std::string& page) {
            io::AtomicFile file((std::filesystem::path(folder) / (name + ".1")).string());
            file.write(page);
            file.commit();
        };
        write("asperity", program_manual(*program_));
        for (const CLI::App* verb : program_->get_subcommands({}))
            write("asperity-" + verb->get_name(), verb_manual(*verb));
        return 0;
    }

    const CLI::App* program_;
    CLI::Option *verb_ = nullptr, *format_ = nullptr, *folder_ = nullptr;
};

}  // namespace

Verb add_reference(CLI::App& program) {
    CLI::App* app = program.add_subcommand(
        "reference", "print the page of all settings, the manual, completion for shells");
    const auto verb = std::make_shared<ReferenceVerb>(program, *app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
// asperity help: the page of the program, or of a verb.
#include "console.h"
#include "help.h"
#include "options.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/params/suggest.h>

#include <string>
#include <vector>

namespace asperity::cli {

namespace {

constexpr const char* kHelpClosing =
    "Examples\n"
    "  asperity help\n"
    "  asperity help simulate\n"
    "  asperity help render | less\n";

}  // namespace

const CLI::App& find_verb(const CLI::App& program, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* verb : program.get_subcommands({})) {
        if (verb->get_name() == name) return *verb;
        names.push_back(verb->get_name());
    }
    throw Error(ErrorCode::Usage, "there is no verb '" + name + "'" + did_you_mean(name, names));
}

Verb add_help(CLI::App& program) {
    CLI::App* app = program.add_subcommand("help", "explain the program, or a verb of it");
    const CLI::Option* name =
        add_text(*app, "verb", "VERB", "one of those asperity help lists", "");
    set_help(*app, "help [VERB]", kHelpClosing);
    return {app, [&program, name] {
                const CLI::App& page =
                    name->count() == 0 ? program : find_verb(program, text_of(name));
                // App::help() would be that of the verb under way
                write_out(page.get_formatter()->make_help(&page, "", CLI::AppFormatMode::Normal));
                return 0;
            }};
}

}  // namespace asperity::cli

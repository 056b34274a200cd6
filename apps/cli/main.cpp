// SPDX-License-Identifier: Apache-2.0
// The program: finds the verb, runs it, and says in one line what went wrong.
#include "console.h"
#include "help.h"
#include "leftovers.h"
#include "programs_beside.h"
#include "swapped.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/core/version.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace asperity::cli {

namespace {

constexpr const char* kProgramClosing =
    "asperity help VERB explains a verb.\n"
    "\n"
    "Start here\n"
    "  asperity simulate --surface gaussian --alpha 0.3 --isotropic -o metal.asperity\n"
    "  asperity info metal.asperity\n"
    "  asperity export metal.asperity -o pictures/\n"
    "  asperity render --model knot --brdf metal.asperity -o knot.png\n"
    "  asperity compare metal.asperity cook-torrance:roughness=0.55,metallic=1\n"
    "\n"
    "Exit codes: 0 done, 2 wrong use, 3 bad input, 4 input/output, 5 memory, 6 energy lost\n"
    "(a fault of ours or of the machine), 130 stopped.\n";

/// One line: an error never spreads over several.
std::string one_line(std::string text) {
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

void say_error(const std::string& text) {
    write_err("asperity: error: " + one_line(text) + "\n");
}

/// What the parser says, in our words.
std::string in_words(const CLI::ParseError& error) {
    const std::string text = error.what();
    if (error.get_name() == "ArgumentMismatch") {
        return text.substr(0, text.find(": ")) + " needs a value";
    }
    return text;
}

int run_program(int argc, char** argv) {
    CLI::App program(
        "a virtual gonioreflectometer: from a rough surface to its BRDF, and to pictures",
        "asperity");
    program.set_version_flag("--version", std::string("asperity ") + kVersion);
    set_program_help(program, kProgramClosing);
    // The verbs check their own needs, so that a mistyped option is named before a missing one.
    program.allow_extras();
    program.require_subcommand(0, 1);
    const std::vector<Verb> verbs = {
        add_surface(program),   add_simulate(program), add_refine(program),  add_merge(program),
        add_gloss(program),     add_info(program),     add_compare(program), add_fit(program),
        add_render(program),    add_sheet(program),    add_plot(program),    add_export(program),
        add_reference(program), add_selftest(program), add_help(program)};
    for (const Verb& verb : verbs) verb.app->allow_extras();
    const auto is_named = [&](const Verb& verb) { return verb.app->get_name() == argv[1]; };
    if (argc > 1 && std::none_of(verbs.begin(), verbs.end(), is_named))
        become_program_beside(argc, argv);

    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForVersion& version) {
        write_out(std::string(version.what()) + "\n");
        return 0;
    } catch (const CLI::CallForHelp&) {
        const std::vector<CLI::App*> chosen = program.get_subcommands();
        write_out((chosen.empty() ? &program : chosen[0])->help());
        return 0;
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::Usage, in_words(error));
    }
    refuse_leftovers(program);
    const auto chosen = std::find_if(verbs.begin(), verbs.end(),
                                     [](const Verb& verb) { return verb.app->parsed(); });
    try {
        return chosen->run();
    } catch (const Error& error) {
        throw with_cure_of_swap(*chosen->app, error);
    }
}

}  // namespace

}  // namespace asperity::cli

int main(int argc, char** argv) {
    using namespace asperity;
    const auto fail = [](ErrorCode code, const std::string& text) {
        cli::say_error(text);
        return static_cast<int>(code);
    };
    try {
        cli::prepare_standard_streams();
        return cli::run_program(argc, argv);
    } catch (const cli::BrokenPipe&) {
        return static_cast<int>(ErrorCode::InputOutput);
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::OutOfMemory, "not enough memory");
    } catch (const std::length_error&) {
        return fail(ErrorCode::OutOfMemory, "more memory asked for than there can be");
    } catch (const std::exception& error) {
        cli::say_error(std::string("unexpected: ") + error.what());
        return 1;
    }
}

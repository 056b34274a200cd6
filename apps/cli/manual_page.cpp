// SPDX-License-Identifier: Apache-2.0
#include "manual_page.h"

#include "help.h"
#include "options.h"

#include <asperity/core/version.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace asperity::cli {

namespace {

/// Text that roff shows as it is.
std::string plain(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

/// Lines that stay as they are: no line may begin like a request of roff.
std::string lines_of(const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && (line.front() == '.' || line.front() == '\'')) out += "\\&";
        out += plain(line) + '\n';
    }
    return out;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string title(const std::string& page) {
    return fmt::format(".TH \"{}\" 1 \"\" \"asperity {}\" \"User Commands\"\n", upper(page),
                       kVersion);
}

std::string paragraph(const std::string& heading, const std::string& text) {
    return ".TP\n" + heading + '\n' + lines_of(text);
}

std::string option_entry(const CLI::Option& option) {
    std::string text = option.get_description();
    if (!option.get_default_str().empty()) text += " [" + option.get_default_str() + "]";
    if (option.get_positional())
        return paragraph("\\fI" + plain(option.get_type_name()) + "\\fR", text);
    std::string names;
    const auto add = [&](const std::string& name) {
        names += (names.empty() ? "\\fB" : ", \\fB") + plain(name) + "\\fR";
    };
    for (const std::string& name : option.get_snames()) add("-" + name);
    for (const std::string& name : option.get_lnames()) add("--" + name);
    if (option.get_items_expected_max() > 0 && !option.get_type_name().empty())
        names += " \\fI" + plain(option.get_type_name()) + "\\fR";
    return paragraph(names, text);
}

/// What stands behind the options in help: text, and examples under a heading of their own.
std::string closing(const std::string& footer) {
    const std::string mark = "Examples\n";
    const std::size_t examples = footer.find(mark);
    const std::string text = footer.substr(0, examples);
    std::string out;
    if (!text.empty()) out += ".SH NOTES\n.nf\n" + lines_of(text) + ".fi\n";
    if (examples != footer.npos)
        out += ".SH EXAMPLES\n.nf\n" + lines_of(footer.substr(examples + mark.size())) + ".fi\n";
    return out;
}

}  // namespace

std::string program_manual(const CLI::App& program) {
    std::string page = title("asperity") + ".SH NAME\nasperity \\- " +
                       plain(program.get_description()) +
                       "\n.SH SYNOPSIS\n\\fBasperity\\fR \\fIVERB\\fR ...\n.SH VERBS\n";
    for (const CLI::App* verb : program.get_subcommands({}))
        page += paragraph("\\fBasperity " + verb->get_name() + "\\fR", verb->get_description());
    page += ".SH NOTES\n.nf\n" + lines_of(program.get_footer()) + ".fi\n.SH SEE ALSO\n";
    std::string others;
    for (const CLI::App* verb : program.get_subcommands({}))
        others +=
            (others.empty() ? "" : ",\n") + ("\\fBasperity\\-" + verb->get_name()) + "\\fR(1)";
    return page + others + '\n';
}

std::string verb_manual(const CLI::App& verb) {
    const std::string name = "asperity-" + verb.get_name();
    std::string page = title(name) + ".SH NAME\n" + plain(name) + " \\- " +
                       plain(verb.get_description()) + "\n.SH SYNOPSIS\n" + plain(usage_of(verb)) +
                       "\n.SH OPTIONS\n";
    for (const CLI::Option* option : verb.get_options())
        if (option->get_positional()) page += option_entry(*option);
    for (const char* group : kGroups) {
        std::string entries;
        for (const CLI::Option* option : verb.get_options())
            if (!option->get_positional() && option->get_group() == group)
                entries += option_entry(*option);
        if (!entries.empty()) page += fmt::format(".SS {}\n", group) + entries;
    }
    return page + closing(verb.get_footer()) + ".SH SEE ALSO\n\\fBasperity\\fR(1)\n";
}

}  // namespace asperity::cli

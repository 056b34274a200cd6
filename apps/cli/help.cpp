// SPDX-License-Identifier: Apache-2.0
#include "help.h"

#include "options.h"
#include "table.h"

#include <fmt/format.h>

#include <sstream>

namespace asperity::cli {

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 30;

/// Words of `text` in lines that begin at kIndent; the first continues a line `used` wide.
std::string wrapped(const std::string& text, std::size_t used) {
    std::string out;
    std::size_t column = used;
    if (column + 2 > kIndent) {
        out += '\n';
        column = 0;
    }
    out.append(kIndent - column, ' ');
    column = kIndent;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (column > kIndent && column + 1 + display_width(word) > kColumns) {
            out += '\n' + std::string(kIndent, ' ');
            column = kIndent;
        }
        if (column > kIndent) {
            out += ' ';
            ++column;
        }
        out += word;
        column += display_width(word);
    }
    return out + '\n';
}

/// As an option stands in a heading, "-o, --output FILE", a column of short names on the left.
std::string option_lines(const CLI::Option& option) {
    std::string line = "  ";
    if (option.get_positional()) {
        line += option.get_type_name();
    } else {
        line += option.get_snames().empty() ? "    " : "-" + option.get_snames().front() + ", ";
        line += option.get_lnames().empty() ? "" : "--" + option.get_lnames().front();
        const std::string metavar = option.get_type_name();
        if (option.get_items_expected_max() > 0 && !metavar.empty()) line += ' ' + metavar;
    }
    std::string text = option.get_description();
    if (!option.get_default_str().empty()) text += " [" + option.get_default_str() + "]";
    return line + wrapped(text, display_width(line));
}

std::string verb_help(const CLI::App& app, const std::string& usage, const std::string& closing) {
    std::string text = fmt::format("asperity {}: {}\n\nUsage: asperity {}\n", app.get_name(),
                                   app.get_description(), usage);
    std::string arguments;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional()) arguments += option_lines(*option);
    }
    if (!arguments.empty()) text += '\n' + arguments;
    for (const char* group : kGroups) {
        std::string lines;
        for (const CLI::Option* option : app.get_options()) {
            if (!option->get_positional() && option->get_group() == group) {
                lines += option_lines(*option);
            }
        }
        if (!lines.empty()) text += fmt::format("\n{}\n{}", group, lines);
    }
    return text + '\n' + closing;
}

}  // namespace

std::string usage_of(const CLI::App& verb) {
    const std::string page = verb.help(), mark = "\nUsage: ";
    const std::size_t begin = page.find(mark) + mark.size();
    return page.substr(begin, page.find('\n', begin) - begin);
}

void set_help(CLI::App& app, const std::string& usage, const std::string& closing) {
    app.set_help_flag("-h,--help", "show this page")->group(kOutput);
    app.footer(closing);
    app.formatter_fn([usage, closing](const CLI::App* self, std::string, CLI::AppFormatMode) {
        return verb_help(*self, usage, closing);
    });
}

void set_program_help(CLI::App& program, const std::string& closing) {
    program.footer(closing);
    program.formatter_fn([closing](const CLI::App* self, std::string, CLI::AppFormatMode) {
        std::string text =
            fmt::format("asperity: {}\n\nUsage: asperity VERB ...\n\n", self->get_description());
        for (const CLI::App* verb : self->get_subcommands({})) {
            text += fmt::format("  {:<10}{}\n", verb->get_name(), verb->get_description());
        }
        return text + '\n' + closing;
    });
}

}  // namespace asperity::cli

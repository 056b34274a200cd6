// SPDX-License-Identifier: Apache-2.0
#include "completion.h"

#include "option_names.h"

#include <asperity/formats/bsdfs/bsdf_format.h>
#include <fmt/format.h>

#include <string>
#include <vector>

namespace asperity::cli {

namespace {

using Words = std::vector<std::string>;

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

bool takes_file(const CLI::Option& option) {
    const std::string metavar = option.get_type_name();
    for (const char* word : {"FILE", "PICTURE", "FOLDER", ".png"})
        if (metavar.find(word) != metavar.npos) return true;
    return false;
}

/// The names, and those of formats with each setting they have: "rgl", "rgl:colour=".
Words words_for(const CLI::App& verb, const std::string& option) {
    Words words = names_for(verb, option);
    if (option != "format" || verb.get_name() != "export") return words;
    const io::BsdfFormats formats;
    for (const io::BsdfFormat& format : formats.rows())
        for (const io::FormatOption& setting : format.options)
            if (format.write) words.push_back(fmt::format("{}:{}=", format.name, setting.name));
    return words;
}

/// All spellings of an option, with their dashes.
Words spellings(const CLI::Option& option) {
    Words all;
    for (const std::string& name : option.get_snames()) all.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
    return all;
}

std::string key_of(const CLI::Option& option) {
    return option.get_positional()       ? option.get_single_name()
           : option.get_lnames().empty() ? ""
                                         : option.get_lnames().front();
}

/// The words that may follow, and whether a file may.
std::string bash_replies(const Words& names, bool file) {
    std::string text;
    if (!names.empty())
        text += fmt::format(" COMPREPLY+=($(compgen -W '{}' -- \"$cur\"))", fmt::join(names, " "));
    if (file)
        text += fmt::format("{} COMPREPLY+=($(compgen -f -- \"$cur\"))", text.empty() ? "" : ";");
    return text.empty() ? " :" : text;
}

/// What follows the options of a verb, and the words that it takes itself.
std::string bash_verb(const CLI::App& verb) {
    std::string values;
    Words options, own;
    bool files = false;
    for (const CLI::Option* option : verb.get_options()) {
        const Words names = words_for(verb, key_of(*option));
        if (option->get_positional()) {
            own.insert(own.end(), names.begin(), names.end());
            files = files || takes_file(*option);
            continue;
        }
        const Words all = spellings(*option);
        options.insert(options.end(), all.begin(), all.end());
        if (takes_value(*option))
            values += fmt::format("            {})\n               {}; return ;;\n",
                                  fmt::join(all, "|"), bash_replies(names, takes_file(*option)));
    }
    return fmt::format(
        "    {})\n        case \"$prev\" in\n{}        esac\n        case \"$cur\" in\n"
        "            -*) COMPREPLY=($(compgen -W '{}' -- \"$cur\")) ;;\n            *){} ;;\n"
        "        esac ;;\n",
        verb.get_name(), values, fmt::join(options, " "), bash_replies(own, files));
}

/// Inside 'single quotes', of a text behind which zsh looks for a colon.
std::string zsh_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\'')
            out += "'\\''";
        else if (c == '[' || c == ']' || c == ':' || c == '\\')
            out += std::string("\\") + c;
        else
            out += c;
    }
    return out;
}

std::string zsh_action(const Words& names, bool file) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : " ") + zsh_text(name);
    if (file && !names.empty())
        return fmt::format("{{_alternative \"names:name:({})\" \"files:file:_files\"}}", list);
    if (file) return "_files";
    return names.empty() ? " " : "(" + list + ")";
}

std::string zsh_verb(const CLI::App& verb) {
    std::string text = fmt::format("        {})\n            _arguments -s", verb.get_name());
    for (const CLI::Option* option : verb.get_options()) {
        const std::string metavar = zsh_text(option->get_type_name());
        const std::string action =
            zsh_action(words_for(verb, key_of(*option)), takes_file(*option));
        if (option->get_positional()) {
            text += fmt::format(" \\\n                '*:{}:{}'", metavar, action);
            continue;
        }
        for (const std::string& name : spellings(*option)) {
            text += fmt::format(" \\\n                '{}[{}]", name,
                                zsh_text(option->get_description()));
            if (takes_value(*option)) text += fmt::format(":{}:{}", metavar, action);
            text += "'";
        }
    }
    return text + " ;;\n";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
    std::string text = fmt::format(
        "# Completion of asperity, made by asperity reference --format bash\n"
        "_asperity() {{\n"
        "    local k word typed=\"${{COMP_WORDS[COMP_CWORD]}}\" words=()\n"
        "    # bash parts words at : and =, rgl:n=64 is one here\n"
        "    for ((k = 0; k <= COMP_CWORD; k++)); do\n"
        "        word=\"${{COMP_WORDS[k]}}\"\n"
        "        if [ $k -gt 1 ] && [[ \"$word\" == [:=]* || \"${{words[-1]}}\" == *[:=] ]]; then\n"
        "            words[-1]+=\"$word\"\n"
        "        else\n"
        "            words+=(\"$word\")\n"
        "        fi\n"
        "    done\n"
        "    local cur=\"${{words[-1]}}\" prev=\"${{words[-2]}}\"\n"
        "    COMPREPLY=()\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        COMPREPLY=($(compgen -W '{0} --help --version' -- \"$cur\"))\n"
        "        return\n"
        "    fi\n"
        "    _asperity_replies \"${{words[1]}}\" \"$cur\" \"$prev\"\n"
        "    # What stands before the part that bash replaces is not said again\n"
        "    [[ \"$typed\" == [:=] ]] && typed=\n"
        "    local before=\"${{cur%\"$typed\"}}\"\n"
        "    for k in \"${{!COMPREPLY[@]}}\"; do COMPREPLY[k]=\"${{COMPREPLY[k]#\"$before\"}}\"; "
        "done\n"
        "    [[ \"${{COMPREPLY[0]}}\" == *= ]] && compopt -o nospace 2> /dev/null\n"
        "    return 0\n"
        "}}\n"
        "_asperity_replies() {{\n"
        "    local cur=\"$2\" prev=\"$3\"\n"
        "    case \"$1\" in\n",
        fmt::join(verb_names(program), " "));
    for (const CLI::App* verb : program.get_subcommands({})) text += bash_verb(*verb);
    return text + "    esac\n}\ncomplete -o filenames -F _asperity asperity\n";
}

std::string zsh_completion(const CLI::App& program) {
    std::string text =
        "#compdef asperity\n"
        "# Completion of asperity, made by asperity reference --format zsh\n"
        "_asperity() {\n"
        "    local -a verbs\n"
        "    verbs=(\n";
    for (const CLI::App* verb : program.get_subcommands({}))
        text +=
            fmt::format("        '{}:{}'\n", verb->get_name(), zsh_text(verb->get_description()));
    text +=
        "    )\n"
        "    if (( CURRENT == 2 )); then\n"
        "        _describe verb verbs\n"
        "        return\n"
        "    fi\n"
        "    local verb=\"${words[2]}\"\n"
        "    shift words\n"
        "    (( CURRENT-- ))\n"
        "    case \"$verb\" in\n";
    for (const CLI::App* verb : program.get_subcommands({})) text += zsh_verb(*verb);
    return text + "    esac\n}\n_asperity \"$@\"\n";
}

}  // namespace asperity::cli

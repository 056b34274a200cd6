// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>

#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// One line of a settings file: `key = value`.
struct Setting {
    std::string key;
    std::string value;    ///< lists joined by commas
    int line = 0;         ///< in the file, from 1
    std::string section;  ///< empty: before the first `[name]`
};

/// Splits a settings text into its lines: `key = value`, `#` starts a comment, blank lines are
/// skipped, double quotes around a value are taken off. A line `[name]` begins a section, up to the
/// next one. Throws Error(InvalidInput, "name:line").
std::vector<Setting> parse_settings(std::string_view text, const std::string& name);

/// `key = value` and a line end, with quotes if parse_settings needs them to read the same value.
std::string setting_line(const std::string& key, const std::string& value);

/// All settings of a table, a line each and a comment line before each group.
template <typename Settings>
std::string settings_text(const ParamTable<Settings>& table, const Settings& settings) {
    std::string text, group;
    for (const Param<Settings>& param : table) {
        if (!param.written(settings)) continue;
        if (group != param.info.group) text += "# " + (group = param.info.group) + "\n";
        text += setting_line(param.info.name, param.text(settings));
    }
    return text;
}

}  // namespace asperity

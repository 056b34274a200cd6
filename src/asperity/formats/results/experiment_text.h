// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/experiment.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io {

/// One line of a settings file: `key = value`, the key being a long option of the command line.
struct Setting {
    std::string key;
    std::string value;    ///< lists joined by commas
    int line = 0;         ///< in the file, from 1
    std::string section;  ///< empty: of the experiment. Others belong to the program they name
};

/// Splits a settings text into its lines: `key = value`, `#` starts a comment, blank lines are
/// skipped, double quotes around a value are taken off. A line `[name]` begins a section, up to the
/// next one. Throws Error(InvalidInput, "name:line").
std::vector<Setting> parse_settings(std::string_view text, const std::string& name);

/// `key = value` and a line end, with quotes if parse_settings needs them to read the same value.
std::string setting_line(const std::string& key, const std::string& value);

/// Sets one field of the experiment from its long-option name ("alpha" takes "0.3" or "0.3,0.1").
/// Throws Error(Usage, key) for an unknown key or a value that does not parse or fit.
void apply_setting(Experiment& experiment, const std::string& key, const std::string& value);

/// All fields as settings, in the order of the command line's help; numbers in the shortest form
/// that reads back to the same bits. apply_setting over the result gives the same Experiment.
std::vector<Setting> settings_of(const Experiment& experiment);

/// The same as a text file with one comment line per group. Reading skips what lies in sections.
std::string to_text(const Experiment& experiment);
Experiment experiment_from_text(std::string_view text, const std::string& name);

/// Reads a surface given as "gaussian", "gaussian:alpha=0.3,size=256" or a file name into the
/// settings; keys are those of apply_setting. Throws Error(Usage).
void apply_surface_spec(SurfaceSettings& surface, const std::string& spec);

}  // namespace asperity::io

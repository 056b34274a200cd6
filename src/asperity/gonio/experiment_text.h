// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/experiment.h>
#include <asperity/params/settings_text.h>

#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// Sets one field of the experiment from its name ("alpha" takes "0.3" or "0.3,0.1"). Throws
/// Error(Usage, key) for an unknown key or a value that does not parse or fit.
void apply_setting(Experiment& experiment, const std::string& key, const std::string& value);

/// All fields as settings, in the order of files; numbers in the shortest form that reads back to
/// the same bits. apply_setting over the result gives the same Experiment.
std::vector<Setting> settings_of(const Experiment& experiment);

/// The same as a text file with one comment line per group.
std::string to_text(const Experiment& experiment);

/// Reads such a file; what lies in sections is skipped. A value outside its range is refused where
/// the experiment uses the setting: files of older versions may hold others. Throws
/// Error(InvalidInput, "name:line").
Experiment experiment_from_text(std::string_view text, const std::string& name);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/setting_value.h>
#include <asperity/gonio/experiment.h>

#include <span>
#include <string>
#include <string_view>

namespace asperity::io {

/// One setting of an experiment: its long option, how its text is read, how it is written.
struct ExperimentKey {
    const char* name;
    const char* group;  ///< heading in a settings file
    void (*set)(Experiment&, const SettingValue&);
    std::string (*get)(const Experiment&);
};

inline constexpr const char* kSurfaceGroup = "Surface";

/// Every setting, in the order of the command line's help.
std::span<const ExperimentKey> experiment_keys();

/// nullptr when there is no such setting.
const ExperimentKey* find_experiment_key(std::string_view name);

}  // namespace asperity::io

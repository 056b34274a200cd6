// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/experiment_text.h>

#include <asperity/core/parse_number.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/params/suggest.h>

#include <fmt/format.h>

#include <set>

namespace asperity {

namespace {

const Param<Experiment>& require(const ParamTable<Experiment>& table, const std::string& key) {
    if (const Param<Experiment>* param = find(table, key)) return *param;
    std::vector<std::string> names;
    for (const Param<Experiment>& param : table) names.push_back(param.info.name);
    throw Error(ErrorCode::Usage, "there is no such setting" + did_you_mean(key, names), key);
}

}  // namespace

void apply_setting(Experiment& experiment, const std::string& key, const std::string& value) {
    const ParamTable<Experiment> table = experiment_params();
    require(table, key).apply(experiment, value);
}

std::vector<Setting> settings_of(const Experiment& experiment) {
    std::vector<Setting> settings;
    for (const Param<Experiment>& param : experiment_params())
        if (param.written(experiment))
            settings.push_back({param.info.name, param.text(experiment), 0, {}});
    return settings;
}

std::string to_text(const Experiment& experiment) {
    return settings_text(experiment_params(), experiment);
}

Experiment experiment_from_text(std::string_view text, const std::string& name) {
    const ParamTable<Experiment> table = experiment_params();
    Experiment experiment;
    std::set<std::string> seen;
    // Whether a setting counts is known at the end: what it may be is looked at then.
    for (const bool checking : {false, true})
        for (const Setting& setting : parse_settings(text, name)) {
            if (!setting.section.empty()) continue;
            const std::string place = fmt::format("{}:{}", name, setting.line);
            if (!checking && !seen.insert(setting.key).second)
                throw Error(ErrorCode::InvalidInput, in_quotes(setting.key) + " is set twice",
                            place);
            try {
                const Param<Experiment>& param = require(table, setting.key);
                if (!checking)
                    param.set(experiment, parse(param.info, setting.value));
                else if (param.used(experiment))
                    param.check(experiment);
            } catch (const Error& error) {
                throw Error(ErrorCode::InvalidInput, error.what(), place);
            }
        }
    return experiment;
}

}  // namespace asperity

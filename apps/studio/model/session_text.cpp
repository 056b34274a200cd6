// SPDX-License-Identifier: Apache-2.0
#include "session_text.h"

#include "settings_keys.h"

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/gonio/experiment_text.h>

#include <fmt/format.h>

#include <set>

namespace asperity::studio {
namespace {

constexpr const char* kSection = "studio";

void set(StudioSettings& settings, const Setting& setting) {
    if (setting.section.empty()) {
        apply_setting(settings.experiment, setting.key, setting.value);
        return;
    }
    const Param<StudioSettings>* param = find(studio_params(), setting.key);
    if (param == nullptr) throw Error(ErrorCode::Usage, "there is no such setting", setting.key);
    param->apply(settings, setting.value);
}

}  // namespace

std::string session_text(const StudioSettings& settings) {
    return to_text(settings.experiment) + fmt::format("\n[{}]\n", kSection) +
           settings_text(studio_params(), settings);
}

StudioSettings session_from_text(std::string_view text, const std::string& name) {
    StudioSettings settings;
    std::set<std::pair<std::string, std::string>> seen;
    for (const Setting& setting : parse_settings(text, name)) {
        if (!setting.section.empty() && setting.section != kSection) continue;
        const std::string place = fmt::format("{}:{}", name, setting.line);
        if (!seen.emplace(setting.section, setting.key).second)
            throw Error(ErrorCode::InvalidInput, in_quotes(setting.key) + " is set twice", place);
        try {
            set(settings, setting);
        } catch (const Error& error) {
            throw Error(ErrorCode::InvalidInput, error.what(), place);
        }
    }
    // Sessions were written when both sides of a comparison had one result
    if (seen.contains({kSection, "result"}) && !seen.contains({kSection, "second-result"}))
        settings.model_view.second.result = settings.model_view.brdf.result;
    return settings;
}

}  // namespace asperity::studio

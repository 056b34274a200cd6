// SPDX-License-Identifier: Apache-2.0
#include "session_text.h"

#include "settings_keys.h"

#include <asperity/core/error.h>
#include <asperity/formats/results/experiment_text.h>

#include <fmt/format.h>

#include <set>

namespace asperity::studio {
namespace {

constexpr const char* kSection = "studio";

void set(StudioSettings& settings, const io::Setting& setting) {
    if (setting.section.empty()) {
        io::apply_setting(settings.experiment, setting.key, setting.value);
        return;
    }
    const StudioKey* key = find_studio_key(setting.key);
    if (key == nullptr) throw Error(ErrorCode::Usage, "there is no such setting", setting.key);
    key->set(settings, io::SettingValue(setting.key, setting.value));
}

}  // namespace

std::string session_text(const StudioSettings& settings) {
    std::string text = io::to_text(settings.experiment);
    text += fmt::format("\n[{}]\n", kSection);
    std::string group;
    for (const StudioKey& key : studio_keys()) {
        if (group != key.group) text += fmt::format("# {}\n", group = key.group);
        text += io::setting_line(key.name, key.get(settings));
    }
    return text;
}

StudioSettings session_from_text(std::string_view text, const std::string& name) {
    StudioSettings settings;
    std::set<std::pair<std::string, std::string>> seen;
    for (const io::Setting& setting : io::parse_settings(text, name)) {
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
    return settings;
}

}  // namespace asperity::studio

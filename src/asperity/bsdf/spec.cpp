// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/params/suggest.h>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace asperity {
namespace {

[[noreturn]] void fail(const std::string& spec, std::string message) {
    throw Error(ErrorCode::Usage, std::move(message), spec);
}

bool has(const SpecSettings& settings, std::string_view key) {
    return std::any_of(settings.begin(), settings.end(),
                       [&](const auto& setting) { return setting.first == key; });
}

/// One "key=value" more.
void add(SpecSettings& settings, const std::string& spec, const BsdfModel& model,
         std::string_view text) {
    const std::size_t equals = text.find('=');
    const std::string key(text.substr(0, equals));
    if (equals == std::string_view::npos)
        fail(spec, fmt::format("\"{}\" is not of the form key=value", text));
    const auto is_key = [&](const BsdfParam& param) { return param.info.name == key; };
    if (std::none_of(model.params.begin(), model.params.end(), is_key)) {
        std::vector<std::string> keys;
        for (const BsdfParam& param : model.params) keys.push_back(param.info.name);
        fail(spec, fmt::format("\"{}\" is not a key of this model; there are {}{}", key,
                               fmt::join(keys, ", "), did_you_mean(key, keys)));
    }
    if (has(settings, key)) fail(spec, fmt::format("{} is given twice", key));
    const std::string_view value = text.substr(equals + 1);
    if (value.empty()) fail(spec, fmt::format("{}: the value is empty", key));
    settings.emplace_back(key, value);
}

SpecSettings read_settings(const std::string& spec, const BsdfModel& model, std::string_view text) {
    SpecSettings settings;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        add(settings, spec, model, text.substr(0, comma));
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
        if (text.empty()) fail(spec, "a setting is missing after the last \",\"");
    }
    for (const BsdfParam& param : model.params)
        if (param.required && !has(settings, param.info.name))
            fail(spec, fmt::format("{} is missing", param.info.name));
    return settings;
}

/// What help shows behind "key=": the choices, the default, or a word for what is taken.
std::string help_value(const BsdfParam& param) {
    const ParamInfo& info = param.info;
    if (info.type == ParamType::Choice) return fmt::format("{}", fmt::join(info.choices, "|"));
    const bool open = param.otherwise.empty() || param.otherwise == info.absent;
    if (open || !info.metavar.empty()) return to_spec_text(info, metavar(info));
    return param.otherwise;
}

}  // namespace

std::unique_ptr<Bsdf> parse_brdf_spec(const std::string& spec) {
    if (std::any_of(spec.begin(), spec.end(),
                    [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }))
        throw Error(ErrorCode::Usage, "control characters are no part of a model", in_quotes(spec));
    const std::size_t colon = spec.find(':');
    const std::string name = spec.substr(0, colon);
    const std::optional<BsdfModel> model = find_bsdf_model(name);
    if (!model)
        fail(spec, fmt::format("\"{}\" is not a model; there are {}", name, bsdf_model_names()));
    const SpecSettings settings = read_settings(
        spec, *model,
        colon == std::string::npos ? std::string_view{} : std::string_view(spec).substr(colon + 1));
    try {
        return model->make(settings);
    } catch (const Error& e) {
        // The models know their settings; the user knows the specification.
        throw Error(e.code(), fmt::format("{}: {}", e.where(), e.message()), spec);
    }
}

bool is_brdf_spec(const std::string& spec) {
    return find_bsdf_model(spec.substr(0, spec.find(':'))).has_value();
}

std::string brdf_spec_help() {
    constexpr std::size_t kWidth = 78;
    std::string text;
    for (const BsdfModel& model : bsdf_models()) {
        std::string line = "  " + model.name + ":";
        for (const BsdfParam& param : model.params) {
            const bool last = &param == &model.params.back();
            const std::string word = param.info.name + "=" + help_value(param) + (last ? "" : ",");
            if (line.size() + word.size() > kWidth) {
                text += line + "\n";
                line = "      ";
            }
            line += word;
        }
        text += line + "\n";
    }
    return text;
}

}  // namespace asperity

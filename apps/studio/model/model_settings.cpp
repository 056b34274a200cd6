// SPDX-License-Identifier: Apache-2.0
#include "model_settings.h"

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity::studio {
namespace {

std::string* find_setting(SpecSettings& settings, std::string_view key) {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const auto& setting) { return setting.first == key; });
    return found == settings.end() ? nullptr : &found->second;
}

/// A value of the row where its default is none, because a specification must give one.
ParamValue value_to_begin_with(const ParamInfo& info) {
    const double number = std::clamp(1.0, info.range.low, info.range.high);
    switch (info.type) {
        case ParamType::Flag:
            return false;
        case ParamType::Integer:
            return static_cast<std::int64_t>(number);
        case ParamType::Natural:
            return static_cast<std::uint64_t>(number);
        case ParamType::Real:
            return number;
        case ParamType::Choice:
            return info.choices.empty() ? std::string() : info.choices.front();
        case ParamType::List:
            return std::vector{number};
        case ParamType::Pair:
            return std::vector{number, number};
        case ParamType::Text:
            break;
    }
    return std::string();
}

/// The value that a specification's text stands for.
ParamValue value_of(const ParamInfo& info, const std::string& text) {
    try {
        return parse(info, from_spec_text(info, text));
    } catch (const Error&) {
        if (!info.absent.empty()) return {};
        return value_to_begin_with(info);
    }
}

std::string text_of(const ParamInfo& info, const ParamValue& value) {
    return to_spec_text(info, format(info, value));
}

/// Adds "key=value" to the settings of a model.
void add(const std::string& row, ModelSettings& all, const BsdfModel& model,
         std::string_view item) {
    const std::size_t equals = item.find('=');
    const std::string key(item.substr(0, equals));
    const auto param = std::find_if(model.params.begin(), model.params.end(),
                                    [&](const BsdfParam& p) { return p.info.name == key; });
    if (equals == std::string_view::npos || param == model.params.end())
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is no setting of the model {}", in_quotes(item), model.name),
                    row);
    const std::string text(item.substr(equals + 1));
    try {
        check(param->info, parse(param->info, from_spec_text(param->info, text)));
    } catch (const Error& error) {
        throw Error(ErrorCode::Usage, fmt::format("{}: {}", model.name, error.what()), row);
    }
    if (find_setting(all[model.name], key) != nullptr)
        throw Error(ErrorCode::Usage, fmt::format("{} of {} is set twice", key, model.name), row);
    all[model.name].emplace_back(key, text);
}

}  // namespace

std::string model_setting(const ModelSettings& all, const BsdfModel& model,
                          const BsdfParam& param) {
    const auto found = all.find(model.name);
    if (found != all.end())
        for (const auto& [key, text] : found->second)
            if (key == param.info.name) return text;
    return param.otherwise;
}

void set_model_setting(ModelSettings& all, const BsdfModel& model, const BsdfParam& param,
                       const std::string& text) {
    SpecSettings kept;
    // In the order of the model's parameters, so that equal settings are equal texts.
    for (const BsdfParam& each : model.params) {
        const std::string value =
            each.info.name == param.info.name ? text : model_setting(all, model, each);
        if (value != each.otherwise) kept.emplace_back(each.info.name, value);
    }
    if (kept.empty())
        all.erase(model.name);
    else
        all[model.name] = std::move(kept);
}

std::string model_spec(const ModelSettings& all, const BsdfModel& model) {
    std::string spec = model.name + ":";
    for (const BsdfParam& param : model.params) {
        std::string text = model_setting(all, model, param);
        if (text == param.otherwise && !param.required) continue;
        if (text.empty()) text = text_of(param.info, value_of(param.info, text));
        spec += fmt::format("{}{}={}", spec.back() == ':' ? "" : ",", param.info.name, text);
    }
    return spec;
}

std::string to_line(const ModelSettings& all) {
    std::string line;
    for (const auto& [name, settings] : all) {
        std::string begin = name + ":";
        for (const auto& [key, text] : settings) {
            line += fmt::format("{}{}{}={}", line.empty() ? "" : ",", begin, key, text);
            begin.clear();
        }
    }
    return line;
}

ModelSettings from_line(const std::string& key, std::string_view line) {
    ModelSettings all;
    std::optional<BsdfModel> model;
    while (!line.empty()) {
        const std::size_t comma = std::min(line.find(','), line.size());
        std::string_view item = line.substr(0, comma);
        line.remove_prefix(std::min(comma + 1, line.size()));
        const std::size_t colon = item.substr(0, item.find('=')).find(':');
        if (colon != std::string_view::npos) {
            model = expect_model(key, item.substr(0, colon));
            item.remove_prefix(colon + 1);
        }
        if (!model)
            throw Error(
                ErrorCode::Usage,
                fmt::format("{} does not begin with a model's name and ':'", in_quotes(item)), key);
        add(key, all, *model, item);
    }
    return all;
}

ParamValue model_value(const ModelSettings& all, const BsdfModel& model, const BsdfParam& param) {
    return value_of(param.info, model_setting(all, model, param));
}

void set_model_value(ModelSettings& all, const BsdfModel& model, const BsdfParam& param,
                     const ParamValue& value) {
    const std::string text = text_of(param.info, value);
    if (text.find(',') != std::string::npos)
        refuse(param.info, in_quotes(text) + " has a comma, which parts the settings of a model");
    set_model_setting(all, model, param, text);
}

BsdfModel expect_model(const std::string& key, std::string_view name) {
    std::optional<BsdfModel> model = find_bsdf_model(name);
    if (!model)
        throw Error(
            ErrorCode::Usage,
            fmt::format("{} is not a model; there are {}", in_quotes(name), bsdf_model_names()),
            key);
    return *std::move(model);
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/builtin_models.h>
#include <asperity/core/error.h>

#include <mutex>

namespace asperity {
namespace {

struct Registry {
    std::mutex mutex;
    std::vector<BsdfModel> models = builtin_bsdf_models();
};

Registry& registry() {
    static Registry registry;
    return registry;
}

std::string with(std::string text, char from, char to) {
    std::replace(text.begin(), text.end(), from, to);
    return text;
}

bool is_list(const ParamInfo& info) {
    return info.type == ParamType::List || info.type == ParamType::Pair;
}

}  // namespace

std::vector<BsdfModel> bsdf_models() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.models;
}

std::optional<BsdfModel> find_bsdf_model(std::string_view name) {
    for (BsdfModel& model : bsdf_models())
        if (model.name == name) return std::move(model);
    return std::nullopt;
}

std::string bsdf_model_names() {
    std::string names;
    for (const BsdfModel& model : bsdf_models()) names += (names.empty() ? "" : ", ") + model.name;
    return names;
}

void add_bsdf_model(BsdfModel model) {
    const auto refuse_model = [&](const char* why) {
        throw Error(ErrorCode::Usage, why, model.name);
    };
    if (model.name.empty()) refuse_model("a model needs a name");
    if (model.name.find_first_of(":=,/ ") != std::string::npos)
        refuse_model("the name of a model has none of ':', '=', ',', '/' and spaces");
    if (!model.make) refuse_model("a model needs a function that makes its BSDF");
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    for (const BsdfModel& known : all.models)
        if (known.name == model.name) refuse_model("there is a model of that name");
    all.models.push_back(std::move(model));
}

std::string from_spec_text(const ParamInfo& info, std::string_view text) {
    return is_list(info) ? with(std::string(text), '/', ',') : std::string(text);
}

std::string to_spec_text(const ParamInfo& info, std::string text) {
    return is_list(info) ? with(std::move(text), ',', '/') : text;
}

}  // namespace asperity

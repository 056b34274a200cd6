// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/fit/free_params.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/optics_params.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr double kLongRange = 100;  ///< ratio of its ends, or its upper end
constexpr double kSearchLow = 0.02, kSearchHigh = 20;
constexpr double kVerySmall = 1e-6;  ///< ranges that begin below are searched from here on

const BsdfParam* find_row(const BsdfModel& model, const std::string& key) {
    for (const BsdfParam& param : model.params)
        if (param.info.name == key) return &param;
    return nullptr;
}

bool is_given(const SpecSettings& settings, const std::string& key) {
    return std::any_of(settings.begin(), settings.end(),
                       [&](const auto& setting) { return setting.first == key; });
}

bool is_number(const ParamInfo& info) {
    return (info.type == ParamType::Real || info.type == ParamType::List) &&
           std::isfinite(info.range.low) && std::isfinite(info.range.high);
}

std::vector<std::string> optics_keys() {
    std::vector<std::string> keys;
    for (const Param<OpticsSettings>& row : optics_params()) keys.push_back(row.info.name);
    return keys;
}

SpecSettings given_settings(const std::string& text, const BsdfModel& model) {
    SpecSettings settings;
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) return settings;
    for (const std::string_view piece : split(std::string_view(text).substr(colon + 1), ',')) {
        const std::size_t equals = piece.find('=');
        const std::string key(piece.substr(0, equals));
        if (equals == std::string_view::npos || !find_row(model, key))
            throw Error(ErrorCode::Usage, fmt::format("'{}' is no setting of this model", piece),
                        text);
        if (is_given(settings, key))
            throw Error(ErrorCode::Usage, fmt::format("{} is given twice", key), text);
        settings.emplace_back(key, piece.substr(equals + 1));
    }
    return settings;
}

class Chooser {
  public:
    Chooser(FreeModel& model, const FitData& data) : model_(model), data_(data) {}

    void add(const BsdfParam& row) {
        const Range& range = row.info.range;
        // An open end is no value: a millionth of the range inside.
        const double margin = 1e-6 * (range.high - range.low);
        FreeParam param{row.info.name, -1, range.low_open ? range.low + margin : range.low,
                        range.high_open ? range.high - margin : range.high};
        if (row.info.type != ParamType::List) {
            model_.free.push_back(param);
            return;
        }
        for (int c = 0; c < data_.channels; ++c) {
            param.entry = c;
            model_.free.push_back(param);
        }
    }

    void add(const std::string& key) {
        const BsdfParam* row = find_row(model_.model, key);
        if (row && !is_free(key)) add(*row);
    }

    bool is_free(const std::string& key) const {
        return std::any_of(model_.free.begin(), model_.free.end(),
                           [&](const FreeParam& param) { return param.key == key; });
    }

    void set_reflectance(FitReflectance reflectance) {
        const auto law = [&](FitReflectance kind, const char* name,
                             std::initializer_list<const char*> keys) {
            if (reflectance != kind) return;
            model_.fixed.emplace_back("fresnel", name);
            for (const char* key : keys) add(key);
        };
        law(FitReflectance::F0, "schlick", {"f0"});
        law(FitReflectance::Ior, "dielectric", {"ior"});
        law(FitReflectance::Conductor, "conductor", {"ior", "k"});
        if (reflectance == FitReflectance::Run) take_run();
    }

  private:
    void take_run() {
        if (!data_.knows_optics)
            throw Error(ErrorCode::Usage,
                        "the data do not say what their facets reflect: f0, ior or "
                        "conductor, or name the material in the model",
                        "reflectance");
        for (const Param<OpticsSettings>& row : optics_params()) {
            const std::string text = row.text(data_.optics);
            if (text != row.default_text())
                model_.fixed.emplace_back(row.info.name, to_spec_text(row.info, text));
        }
    }

    FreeModel& model_;
    const FitData& data_;
};

}  // namespace

double FreeParam::coordinate(double x) const {
    if (low > 0 && high > kLongRange * low) return std::log(x);
    return high > kLongRange ? std::log1p(x) : x;
}

double FreeParam::value(double u) const {
    if (low > 0 && high > kLongRange * low) return std::clamp(std::exp(u), low, high);
    return std::clamp(high > kLongRange ? std::expm1(u) : u, low, high);
}

double FreeParam::search_low() const {
    const double least = low < kVerySmall ? kVerySmall : kSearchLow;
    return low > 0 && high > kLongRange * low ? coordinate(std::max(low, least)) : lowest();
}

double FreeParam::search_high() const {
    return coordinate(high > kLongRange ? std::min(high, kSearchHigh) : high);
}

std::unique_ptr<Bsdf> FreeModel::make(const std::vector<double>& values) const {
    SpecSettings settings;
    for (std::size_t k = 0; k < free.size(); ++k) {
        const std::string text = shortest(std::clamp(values[k], free[k].low, free[k].high));
        if (free[k].entry > 0)
            settings.back().second += "/" + text;
        else
            settings.emplace_back(free[k].key, text);
    }
    settings.insert(settings.end(), fixed.begin(), fixed.end());
    return model.make(settings);
}

FreeModel free_model(const std::string& text, const FitData& data, FitReflectance reflectance,
                     const std::vector<std::string>& also) {
    const std::string name = text.substr(0, text.find(':'));
    const std::optional<BsdfModel> model = find_bsdf_model(name);
    if (!model)
        throw Error(
            ErrorCode::Usage,
            fmt::format("{} is not a model; there are {}", in_quotes(name), bsdf_model_names()),
            "model");
    FreeModel result{*model, given_settings(text, *model), {}};
    Chooser chooser(result, data);
    const std::vector<std::string> optics = optics_keys();
    const auto is_optics = [&](const std::string& key) {
        return std::find(optics.begin(), optics.end(), key) != optics.end();
    };
    for (const BsdfParam& row : model->params)
        if (is_number(row.info) && row.info.absent.empty() && !is_optics(row.info.name) &&
            !is_given(result.fixed, row.info.name))
            chooser.add(row);
    const bool law_given = std::any_of(result.fixed.begin(), result.fixed.end(),
                                       [&](const auto& s) { return is_optics(s.first); });
    if (find_row(*model, "fresnel") && !law_given) chooser.set_reflectance(reflectance);
    for (const std::string& key : also) {
        const BsdfParam* row = find_row(*model, key);
        if (!row) continue;
        if (!is_number(row->info) || is_given(result.fixed, key))
            throw Error(ErrorCode::Usage,
                        fmt::format("{} of {} cannot be free: it is {}", key, name,
                                    is_number(row->info) ? "given" : "no number in a range"),
                        "free");
        chooser.add(key);
    }
    if (result.free.empty())
        throw Error(ErrorCode::Usage, fmt::format("nothing of {} is free", in_quotes(text)),
                    "model");
    return result;
}

std::vector<std::string> split_models(const std::string& text) {
    std::vector<std::string> models;
    for (const std::string_view piece : split(text, ',')) {
        const std::size_t colon = piece.find(':'), equals = piece.find('=');
        const bool continues = equals != piece.npos && (colon == piece.npos || colon > equals);
        if (continues && !models.empty())
            models.back() += "," + std::string(piece);
        else if (!piece.empty())
            models.emplace_back(piece);
    }
    return models;
}

}  // namespace asperity

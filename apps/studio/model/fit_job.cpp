// SPDX-License-Identifier: Apache-2.0
#include "fit_job.h"

#include "model_settings.h"

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/optics/optics_params.h>

#include <QObject>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kCellsOfFiles = 64;
constexpr double kNoticed = 0.01;  ///< share of light worth a word

FitData data_of(const FitWish& wish, int threads, QString& hint) {
    const double last = radians(wish.settings.last_theta_deg);
    const OpenedBrdf opened = open_brdf(wish.source, wish.drawn);
    if (const auto* measurement = std::get_if<std::shared_ptr<const Measurement>>(&opened)) {
        const double multiple = multiple_share(**measurement);
        if (wish.settings.light == FitLight::All && multiple > kNoticed)
            hint = QObject::tr(
                       "%1 % of the light was reflected more than once, which microfacet "
                       "models leave out: Light \"Single\" leaves it out of the data, too.")
                       .arg(100 * multiple, 0, 'g', 3);
        return fit_data(**measurement, wish.settings.light, last);
    }
    if (wish.settings.light == FitLight::Single)
        throw Error(ErrorCode::Usage, "the file does not tell how often light was reflected",
                    "light");
    const Bsdf& bsdf = *std::get<std::shared_ptr<const Bsdf>>(opened);
    Experiment experiment;
    experiment.detector.resolution = kCellsOfFiles;
    experiment.illumination.isotropic = bsdf.isotropic();
    return fit_data(bsdf, experiment, last, threads);
}

const BsdfParam* find_param(const BsdfModel& model, const std::string& name) {
    const auto found = std::find_if(model.params.begin(), model.params.end(),
                                    [&](const BsdfParam& p) { return p.info.name == name; });
    return found == model.params.end() ? nullptr : &*found;
}

/// The model of a specification and what it sets.
struct ReadSpec {
    BsdfModel model;
    SpecSettings settings;
};

ReadSpec read_spec(const std::string& spec) {
    const ModelSettings all = from_line("model", spec);
    BsdfModel model = expect_model("model", spec.substr(0, spec.find(':')));
    const auto found = all.find(model.name);
    return {std::move(model), found == all.end() ? SpecSettings{} : found->second};
}

/// The width of the facets' slopes for which the model sets `key` to `value`, by halving: settings
/// grow with the width.
double alpha_of(const BsdfModel& model, const std::string& key, double value) {
    double low = 1e-3, high = 100;
    for (int k = 0; k < 60; ++k) {
        const double middle = std::sqrt(low * high);
        double there = 0;
        for (const auto& [name, text] : model.with_alpha(middle))
            if (name == key) there = QString::fromStdString(text).toDouble();
        (there < value ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

/// Keys of a model that follow from the width of its slopes.
std::vector<std::string> width_keys(const BsdfModel& model) {
    std::vector<std::string> keys;
    if (model.with_alpha)
        for (const auto& setting : model.with_alpha(1)) keys.push_back(setting.first);
    return keys;
}

}  // namespace

FitOutcome fit_brdf(const FitWish& wish, Run& run) {
    FitOutcome outcome;
    auto data = std::make_shared<FitData>(data_of(wish, run.threads(), outcome.hint));
    data->name = name_of(wish.source);
    outcome.report = fit_models(*data, wish.settings, run);
    outcome.data = std::move(data);
    return outcome;
}

bool fits_materialx(const Fit& fit) {
    return fit.spec.starts_with("ggx:") && fit.spec.find(",lambert=") == fit.spec.npos;
}

void put_in_plots(StudioSettings& settings, const std::string& spec,
                  std::optional<double> surface_alpha) {
    const auto [model, given] = read_spec(spec);
    PlotView& plots = settings.plots;
    if (plots.follow_surface && surface_alpha)
        for (auto& [name, overlay] : plots.overlays) overlay.alpha = *surface_alpha;
    plots.follow_surface = false;
    Overlay& overlay = plots.overlays[model.name];
    overlay.shown = true;
    // All that facets reflect by, defaults too: without, plots take it from the measurement
    std::map<std::string, std::string> values;
    for (const Param<OpticsSettings>& row : optics_params())
        if (const BsdfParam* param = find_param(model, row.info.name))
            values[param->info.name] = param->otherwise;
    for (const auto& [key, text] : given) values[key] = text;
    for (const std::string& key : width_keys(model)) {
        const auto found = values.find(key);
        if (found == values.end()) continue;
        overlay.alpha = alpha_of(model, key, QString::fromStdString(found->second).toDouble());
        values.erase(found);
    }
    SpecSettings& kept = plots.overlay_settings[model.name];
    kept.assign(values.begin(), values.end());
    if (kept.empty()) plots.overlay_settings.erase(model.name);
}

void put_in_compare(StudioSettings& settings, const std::string& spec, const BrdfSource& fitted) {
    const auto [model, given] = read_spec(spec);
    ModelView& view = settings.model_view;
    view.brdf.type = BrdfType::Simulated;
    view.brdf.result = fitted.kind == BrdfSource::Kind::File ? fitted.text : std::string();
    view.second.type = BrdfType::Model;
    view.second.model = model.name;
    view.second.settings[model.name] = given;
    view.compare = view.brdf_runs = true;
    if (view.model.empty()) view.model = "ball";
    settings.scene = SceneKind::Model;
}

}  // namespace asperity::studio

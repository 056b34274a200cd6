// SPDX-License-Identifier: Apache-2.0
#include "plot_overlays.h"

#include "../model/model_settings.h"

#include <asperity/optics/optics_params.h>

#include <QStringList>

#include <algorithm>
#include <array>

namespace asperity::studio {

namespace {

constexpr double kLeastAlpha = 1e-3, kLargestAlpha = 100;

const BsdfParam* find_param(const BsdfModel& model, const std::string& name) {
    for (const BsdfParam& param : model.params)
        if (param.info.name == name) return &param;
    return nullptr;
}

/// What the facets of a measurement are, for models that take all that decides it.
void take_optics(ModelSettings& all, const BsdfModel& model, const OpticsSettings& optics) {
    const ParamTable<OpticsSettings> rows = optics_params();
    const auto is_known = [&](const auto& row) {
        return find_param(model, row.info.name) != nullptr;
    };
    if (!std::all_of(rows.begin(), rows.end(), is_known)) return;
    for (const Param<OpticsSettings>& row : rows)
        set_model_setting(all, model, *find_param(model, row.info.name),
                          to_spec_text(row.info, row.text(optics)));
}

/// "α = 0.3"
QString term(const std::string& key, const std::string& text) {
    bool number = false;
    const double value = QString::fromStdString(text).toDouble(&number);
    return (key == "alpha" ? QStringLiteral("α") : QString::fromStdString(key)) +
           QStringLiteral(" = ") +
           (number ? QString::number(value, 'g', 3) : QString::fromStdString(text));
}

OverlayModel overlay_model(const BsdfModel& model, const PlotView& view, double alpha,
                           const Measurement* measurement) {
    ModelSettings all;
    if (measurement != nullptr) take_optics(all, model, measurement->experiment.optics);
    OverlayModel made{model.name, 0, {}, QString::fromStdString(model.label), {}};
    if (made.label.isEmpty()) made.label = QString::fromStdString(model.name);
    QStringList terms;
    const auto given = view.overlay_settings.find(model.name);
    if (given != view.overlay_settings.end())
        for (const auto& [key, text] : given->second)
            if (const BsdfParam* param = find_param(model, key)) {
                // What the measurement has anyway needs no word
                if (text != model_setting(all, model, *param) && text != param->otherwise)
                    terms << term(key, text);
                set_model_setting(all, model, *param, text);
            }
    if (model.with_alpha)
        for (const auto& [key, text] : model.with_alpha(alpha))
            if (const BsdfParam* param = find_param(model, key)) {
                set_model_setting(all, model, *param, text);
                terms.prepend(term(key, text));
            }
    made.spec = model_spec(all, model);
    made.title = made.label;
    if (!terms.isEmpty()) made.title += QStringLiteral(" ") + terms.join(QStringLiteral("; "));
    return made;
}

}  // namespace

std::vector<OverlayModel> overlay_models(const PlotView& view, std::optional<double> surface_alpha,
                                         const Measurement* measurement) {
    std::vector<OverlayModel> shown;
    std::size_t place = 0;
    for (const BsdfModel& model : bsdf_models()) {
        const Overlay overlay = view.overlay(model.name);
        if (overlay.shown) {
            const double alpha =
                view.follow_surface && surface_alpha ? *surface_alpha : overlay.alpha;
            shown.push_back(overlay_model(
                model, view, std::clamp(alpha, kLeastAlpha, kLargestAlpha), measurement));
            shown.back().place = place;
        }
        ++place;
    }
    return shown;
}

plots::PlotInk model_ink(std::size_t place) {
    using plots::PlotInk;
    constexpr std::array kInks = {PlotInk::Eighth,   PlotInk::CookTorrance, PlotInk::Ggx,
                                  PlotInk::Beckmann, PlotInk::Fifth,        PlotInk::Seventh,
                                  PlotInk::Sixth};
    return kInks[place % kInks.size()];
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "plot_make.h"

#include <asperity/core/directions.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/plots/curves_of.h>
#include <asperity/plots/plot_frame.h>
#include <asperity/plots/plot_hemisphere.h>
#include <asperity/plots/plot_polar.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kOrdersShown = 4;

const Layer* shown_layer(const PlotSource& source) {
    return source.layers.head ? source.layers.layer(source.current_layer) : nullptr;
}

/// The dome's channel, or the mean of all where this measurement has none such.
int shown_channel(const PlotSource& source) {
    const int channel = source.sky_map.channel;
    return channel < source.layers.head->channels() ? channel : -1;
}

std::vector<OverlayModel> shown_models(const PlotSource& source) {
    return overlay_models(source.view, source.surface_alpha, source.layers.head.get());
}

void add_models(plots::CurveSet& set, const ModelValues* models, const PlotSource& source,
                const std::string& quantity) {
    if (models == nullptr) return;
    for (const OverlayModel& asked : shown_models(source)) {
        const auto& found = models->wish.models;
        // A model may have been made of other settings a moment ago.
        const auto made = std::find_if(found.begin(), found.end(), [&](const OverlayModel& model) {
            return model.name == asked.name;
        });
        if (made == found.end()) continue;
        const auto& y = models->y[static_cast<std::size_t>(made - found.begin())];
        if (y.empty()) continue;
        set.curves.push_back(plots::model_curve(made->title.toStdString(),
                                                made->label.toStdString(), quantity,
                                                model_ink(made->place), models->x, y));
    }
}

plots::PlotAxis value_axis(const PlotSource& source, const plots::CurveSet& set,
                           const std::string& label) {
    return plots::value_axis(set, source.view.scale == io::Scale::Log, source.sky_map.decades,
                             label);
}

std::shared_ptr<const plots::Plot> lobe_plot(const PlotSource& source, const Layer& layer,
                                             const ModelValues* models) {
    const LobeSlice slice = lobe_slice(*source.layers.head, layer, shown_channel(source));
    plots::CurveSet set = plots::lobe_set(plots::layer_title(layer));
    set.error_band = source.view.error_band;
    set.curves.push_back(
        plots::lobe_curve(slice, "Simulated", "simulated: f [1/sr]", plots::PlotInk::Simulated));
    set.more = plots::cosine_columns(slice, "simulated: ");
    add_models(set, models, source, "f [1/sr]");
    plots::PlotAxis axis = value_axis(source, set, "BRDF  f  [sr⁻¹]");
    const std::vector<double> theta_i = {degrees(layer.theta_i)};
    if (source.view.kind == PlotKind::LobePolar)
        return std::make_shared<plots::PolarPlot>(std::move(set), std::move(axis), theta_i);
    return plots::lobe_plot(std::move(set), std::move(axis), "plane of incidence", theta_i);
}

/// The layers with light from the azimuth of the current one, by angle of incidence.
std::vector<const Layer*> layers_by_angle(const PlotSource& source) {
    const Layer* current = shown_layer(source);
    const auto& all = source.layers.by_number;
    if (current == nullptr && !all.empty()) current = all.rbegin()->second.get();
    std::vector<const Layer*> layers;
    for (const auto& [number, layer] : all)
        if (layer->phi_i == current->phi_i) layers.push_back(layer.get());
    std::sort(layers.begin(), layers.end(),
              [](const Layer* a, const Layer* b) { return a->theta_i < b->theta_i; });
    return layers;
}

std::shared_ptr<const plots::Plot> albedo_plot(const PlotSource& source,
                                               const ModelValues* models) {
    plots::CurveSet set = plots::albedo_set("Albedo by number of reflections");
    set.error_band = source.view.error_band;
    set.curves = plots::albedo_curves(*source.layers.head, layers_by_angle(source),
                                      shown_channel(source), kOrdersShown);
    add_models(set, models, source, "albedo [1]");
    plots::PlotAxis axis = value_axis(source, set, "albedo");
    return std::make_shared<plots::CurvePlot>(std::move(set), plots::incidence_angles(),
                                              std::move(axis));
}

std::shared_ptr<const plots::Plot> normals_plot(const PlotSource& source,
                                                const ModelValues& models) {
    plots::CurveSet set = plots::normals_set("Distribution of facet normals");
    set.curves.push_back(plots::normals_curve(models.normals->density, "Surface",
                                              "surface: D [1/sr]", plots::PlotInk::Simulated));
    add_models(set, &models, source, "D [1/sr]");
    const plots::PlotAxis angle = plots::normal_angles(set);
    plots::PlotAxis axis = value_axis(source, set, "D  [sr⁻¹]");
    return std::make_shared<plots::CurvePlot>(std::move(set), angle, std::move(axis));
}

std::shared_ptr<const plots::Plot> hemisphere_plot(const PlotSource& source, const Layer& layer) {
    io::SkyMapSettings settings = source.sky_map;
    settings.scale = source.view.scale;
    settings.channel = shown_channel(source);
    plots::HemispherePlot::Data data;
    data.title = plots::layer_title(layer);
    data.discs = {plots::hemisphere_values(*source.layers.head, layer, settings.channel)};
    data.colour_map = settings.colour_map;
    data.scale = io::value_scale(*source.layers.head, {&layer}, settings);
    data.cell = source.cell;
    data.painter = source.disc_painter;
    return std::make_shared<plots::HemispherePlot>(std::move(data));
}

}  // namespace

std::optional<ModelWish> models_for(const PlotSource& source) {
    ModelWish wish;
    wish.kind = source.view.kind;
    wish.models = shown_models(source);
    if (wish.kind == PlotKind::Hemisphere) return std::nullopt;
    if (wish.kind == PlotKind::Normals) {
        wish.surface = source.surface;
        return wish.surface ? std::optional(wish) : std::nullopt;
    }
    if (!source.layers.head) return std::nullopt;
    wish.head = source.layers.head;
    wish.channel = shown_channel(source);
    if (wish.kind == PlotKind::Albedo) return wish;
    const Layer* layer = shown_layer(source);
    if (layer == nullptr) return std::nullopt;
    wish.theta_i = layer->theta_i;
    wish.phi_i = layer->phi_i;
    return wish;
}

std::shared_ptr<const plots::Plot> make_plot(const PlotSource& source, const ModelValues* models) {
    const auto message = [](const QString& text) {
        return std::make_shared<plots::MessagePlot>(text.toStdString());
    };
    if (source.view.kind == PlotKind::Normals) {
        if (models != nullptr) return normals_plot(source, *models);
        return message(source.surface ? QObject::tr("The facets are being counted")
                                      : QObject::tr("The surface is being made"));
    }
    if (!source.layers.head || source.layers.by_number.empty())
        return message(QObject::tr("Nothing drawn yet: Draw To Textures fills the layers"));
    if (source.view.kind == PlotKind::Albedo) return albedo_plot(source, models);
    const Layer* layer = shown_layer(source);
    if (layer == nullptr)
        return message(QObject::tr("Layer %1 is not drawn yet").arg(source.current_layer));
    if (source.view.kind != PlotKind::Hemisphere) return lobe_plot(source, *layer, models);
    return hemisphere_plot(source, *layer);
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "plot_make.h"

#include "plot_frame.h"
#include "plot_hemisphere.h"
#include "plot_polar.h"

#include <asperity/core/directions.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/measured/lobe_slice.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kOrdersShown = 4;

/// Says why there is no plot.
class MessagePlot final : public Plot {
  public:
    explicit MessagePlot(QString message) : message_(std::move(message)) {}

    void paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const override {
        painter.fillRect(area, style.paper);
        painter.setPen(style.faint);
        painter.setFont(style.font);
        painter.drawText(area, Qt::AlignCenter | Qt::TextWordWrap, message_);
    }
    std::optional<PlotReading> reading(QPointF, const QRectF&, const PlotStyle&) const override {
        return std::nullopt;
    }
    PlotTable table() const override { return {}; }

  private:
    QString message_;
};

const Layer* shown_layer(const PlotSource& source) {
    return source.layers.head ? source.layers.layer(source.current_layer) : nullptr;
}

/// The dome's channel, or the mean of all where this measurement has none such.
int shown_channel(const PlotSource& source) {
    const int channel = source.sky_map.channel;
    return channel < source.layers.head->channels() ? channel : -1;
}

void add_models(CurveSet& set, const ModelValues* models, const PlotSource& source,
                const QString& column) {
    if (models == nullptr) return;
    constexpr std::array kInks = {PlotInk::CookTorrance, PlotInk::Ggx, PlotInk::Beckmann};
    static const std::array kBriefly = {QStringLiteral("Cook-Torrance"), QStringLiteral("GGX"),
                                        QStringLiteral("Beckmann")};
    const OverlayAlphas asked = overlay_alphas(source.view, source.surface_alpha);
    for (std::size_t k = 0; k < kOverlays; ++k) {
        if (asked[k] == 0 || models->y[k].empty()) continue;
        const QString name = overlay_name(k, models->wish.alphas[k]);
        set.curves.push_back({name,
                              name + QStringLiteral(": ") + column,
                              kInks[k],
                              CurveLook::Dashes,
                              models->x,
                              models->y[k],
                              {},
                              {},
                              kBriefly[k]});
    }
}

QString layer_title(const Layer& layer) {
    return QObject::tr("Layer %1, θᵢ = %2°")
        .arg(layer.number)
        .arg(value_text(degrees(layer.theta_i)));
}

CurveSet lobe_curves(const PlotSource& source, const Layer& layer, const ModelValues* models) {
    CurveSet set;
    set.title = layer_title(layer);
    set.x_name = QStringLiteral("θₒ");
    set.x_unit = QStringLiteral("°");
    set.x_column = QStringLiteral("theta_o [deg]");
    set.y_name = QStringLiteral("f");
    set.y_unit = QStringLiteral("sr⁻¹");
    set.error_band = source.view.error_band;
    PlotCurve curve{QObject::tr("Simulated"),
                    QStringLiteral("simulated: f [1/sr]"),
                    PlotInk::Simulated,
                    CurveLook::Line,
                    {},
                    {},
                    {},
                    {}};
    PlotTable::Column f_cos{QStringLiteral("simulated: f cos(theta_o) [1/sr]"), {}};
    PlotTable::Column f_cos_error{QStringLiteral("standard error of ") + f_cos.header, {}};
    for (const LobeSample& sample :
         lobe_slice(*source.layers.head, layer, shown_channel(source)).samples) {
        curve.x.push_back(degrees(sample.theta_o));
        curve.y.push_back(sample.f);
        curve.error.push_back(sample.f_stderr);
        curve.cells.push_back(sample.cell);
        f_cos.values.push_back(sample.f_cos);
        f_cos_error.values.push_back(sample.f_cos_stderr);
    }
    set.curves.push_back(std::move(curve));
    set.more = {std::move(f_cos), std::move(f_cos_error)};
    add_models(set, models, source, QStringLiteral("f [1/sr]"));
    return set;
}

PlotAxis value_axis(const PlotSource& source, const CurveSet& set, const QString& label) {
    PlotAxis axis =
        axis_up_to(set.top(), source.view.scale == io::Scale::Log, source.sky_map.decades);
    axis.label = label;
    return axis;
}

std::shared_ptr<const Plot> lobe_plot(const PlotSource& source, const Layer& layer,
                                      const ModelValues* models) {
    const double theta_i = degrees(layer.theta_i);
    CurveSet set = lobe_curves(source, layer, models);
    PlotAxis axis = value_axis(source, set, QObject::tr("BRDF  f  [sr⁻¹]"));
    if (source.view.kind == PlotKind::LobePolar)
        return std::make_shared<PolarPlot>(std::move(set), std::move(axis), theta_i);
    const PlotAxis angle{QObject::tr("θₒ in the plane of incidence  [°]"), -90, 90, false, 30};
    std::vector<CurvePlot::Upright> uprights = {
        {-theta_i, QObject::tr("light"), PlotInk::Light},
        {theta_i, QObject::tr("mirror direction"), PlotInk::Mirror}};
    return std::make_shared<CurvePlot>(std::move(set), angle, std::move(axis), std::move(uprights));
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

std::shared_ptr<const Plot> albedo_plot(const PlotSource& source, const ModelValues* models) {
    constexpr std::array kInks = {PlotInk::FirstOrder, PlotInk::SecondOrder, PlotInk::ThirdOrder,
                                  PlotInk::HigherOrders};
    CurveSet set;
    set.title = QObject::tr("Albedo by number of reflections");
    set.x_name = QStringLiteral("θᵢ");
    set.x_unit = QStringLiteral("°");
    set.x_column = QStringLiteral("theta_i [deg]");
    set.y_name = QObject::tr("albedo");
    set.error_band = source.view.error_band;
    const Measurement& head = *source.layers.head;
    const auto add = [&set](const QString& name, const QString& column, PlotInk ink) {
        set.curves.push_back({name, column, ink, CurveLook::Marks, {}, {}, {}, {}});
    };
    add(QObject::tr("all"), QStringLiteral("albedo [1]"), PlotInk::Total);
    const int orders = std::min(kOrdersShown, head.bounces());
    for (int k = 1; k <= orders; ++k) {
        const bool rest = k == kOrdersShown && head.bounces() > kOrdersShown;
        const QString order = QString::number(k) + (rest ? QStringLiteral("+") : QString());
        add(order, QStringLiteral("albedo of order %1 [1]").arg(order),
            kInks[static_cast<std::size_t>(k - 1)]);
    }
    for (const Layer* layer : layers_by_angle(source)) {
        const AlbedoByBounce albedo =
            albedo_by_bounce(head, *layer, kOrdersShown, shown_channel(source));
        const auto add_point = [&](PlotCurve& curve, const AlbedoShare& share) {
            curve.x.push_back(degrees(layer->theta_i));
            curve.y.push_back(share.value);
            curve.error.push_back(share.error);
        };
        add_point(set.curves.front(), albedo.total);
        for (std::size_t k = 0; k < albedo.order.size(); ++k)
            add_point(set.curves[k + 1], albedo.order[k]);
    }
    add_models(set, models, source, QStringLiteral("albedo [1]"));
    const PlotAxis angle{QObject::tr("angle of incidence  θᵢ  [°]"), 0, 90, false, 15};
    PlotAxis axis = value_axis(source, set, QObject::tr("albedo"));
    return std::make_shared<CurvePlot>(std::move(set), angle, std::move(axis));
}

std::shared_ptr<const Plot> normals_plot(const PlotSource& source, const ModelValues& models) {
    CurveSet set;
    set.title = QObject::tr("Distribution of facet normals");
    set.x_name = QStringLiteral("θₘ");
    set.x_unit = QStringLiteral("°");
    set.x_column = QStringLiteral("theta_m [deg]");
    set.y_name = QStringLiteral("D");
    set.y_unit = QStringLiteral("sr⁻¹");
    const std::vector<double>& density = models.normals->density;
    set.curves.push_back({QObject::tr("Surface"),
                          QStringLiteral("surface: D [1/sr]"),
                          PlotInk::Simulated,
                          CurveLook::Line,
                          models.x,
                          density,
                          {},
                          {}});
    add_models(set, &models, source, QStringLiteral("D [1/sr]"));
    // Up to the steepest facet
    const auto steepest =
        std::find_if(density.rbegin(), density.rend(), [](double value) { return value > 0; });
    const double tilt =
        90.0 * static_cast<double>(density.rend() - steepest) / static_cast<double>(density.size());
    const double end = std::clamp(15 * std::ceil(tilt / 15), 15.0, 90.0);
    const PlotAxis angle{QObject::tr("tilt of the normal  θₘ  [°]"), 0, end, false,
                         end > 45 ? 15.0 : 5.0};
    PlotAxis axis = value_axis(source, set, QObject::tr("D  [sr⁻¹]"));
    return std::make_shared<CurvePlot>(std::move(set), angle, std::move(axis));
}

}  // namespace

std::optional<ModelWish> models_for(const PlotSource& source) {
    ModelWish wish;
    wish.kind = source.view.kind;
    wish.alphas = overlay_alphas(source.view, source.surface_alpha);
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

std::shared_ptr<const Plot> make_plot(const PlotSource& source, const ModelValues* models) {
    const auto message = [](const QString& text) { return std::make_shared<MessagePlot>(text); };
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
    io::SkyMapSettings settings = source.sky_map;
    settings.scale = source.view.scale;
    settings.channel = shown_channel(source);
    return std::make_shared<HemispherePlot>(
        HemispherePlot::Data{source.layers.head, source.layers.by_number.at(source.current_layer),
                             settings, source.cell, source.disc_painter});
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/curves_of.h>

#include <asperity/core/directions.h>
#include <asperity/plots/plot_frame.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

/// Curves of a figure over an angle in degrees: its symbol, and its name in ASCII for tables.
CurveSet set_over(std::string title, const char* angle, const char* column, const char* figure,
                  const char* unit = "") {
    CurveSet set;
    set.title = std::move(title);
    set.x_name = angle;
    set.x_unit = "°";
    set.x_column = column;
    set.y_name = figure;
    set.y_unit = unit;
    return set;
}

}  // namespace

CurveSet lobe_set(std::string title) {
    return set_over(std::move(title), "θₒ", "theta_o [deg]", "f", "sr⁻¹");
}

CurveSet albedo_set(std::string title) {
    return set_over(std::move(title), "θᵢ", "theta_i [deg]", "albedo");
}

CurveSet normals_set(std::string title) {
    return set_over(std::move(title), "θₘ", "theta_m [deg]", "D", "sr⁻¹");
}

std::string layer_title(const Layer& layer) {
    return fmt::format("Layer {}, θᵢ = {}°", layer.number, value_text(degrees(layer.theta_i)));
}

PlotCurve model_curve(const std::string& name, const std::string& brief,
                      const std::string& quantity, PlotInk ink, std::vector<double> x,
                      std::vector<double> y) {
    PlotCurve curve;
    curve.name = name;
    curve.column = name + ": " + quantity;
    curve.ink = ink;
    curve.look = CurveLook::Dashes;
    curve.x = std::move(x);
    curve.y = std::move(y);
    curve.brief = brief;
    return curve;
}

PlotCurve lobe_curve(const LobeSlice& slice, const std::string& name, const std::string& column,
                     PlotInk ink) {
    PlotCurve curve;
    curve.name = name;
    curve.column = column;
    curve.ink = ink;
    for (const LobeSample& sample : slice.samples) {
        curve.x.push_back(degrees(sample.theta_o));
        curve.y.push_back(sample.f);
        curve.error.push_back(sample.f_stderr);
        curve.cells.push_back(sample.cell);
    }
    return curve;
}

std::vector<PlotTable::Column> cosine_columns(const LobeSlice& slice, const std::string& whose) {
    PlotTable::Column f_cos{whose + "f cos(theta_o) [1/sr]", {}};
    PlotTable::Column error{"standard error of " + f_cos.header, {}};
    for (const LobeSample& sample : slice.samples) {
        f_cos.values.push_back(sample.f_cos);
        error.values.push_back(sample.f_cos_stderr);
    }
    return {std::move(f_cos), std::move(error)};
}

std::vector<PlotCurve> albedo_curves(const Measurement& measurement,
                                     const std::vector<const Layer*>& layers, int channel,
                                     int orders) {
    constexpr std::array kInks = {PlotInk::FirstOrder, PlotInk::SecondOrder, PlotInk::ThirdOrder,
                                  PlotInk::HigherOrders};
    std::vector<PlotCurve> curves;
    const auto add = [&curves](const std::string& name, const std::string& column, PlotInk ink) {
        curves.emplace_back();
        curves.back().name = name;
        curves.back().column = column;
        curves.back().ink = ink;
        curves.back().look = CurveLook::Marks;
    };
    add("all", "albedo [1]", PlotInk::Total);
    const int shown = std::min(orders, measurement.bounces());
    for (int k = 1; k <= shown; ++k) {
        const bool rest = k == orders && measurement.bounces() > orders;
        const std::string order = std::to_string(k) + (rest ? "+" : "");
        const std::string name = rest     ? fmt::format("{} or more", k)
                                 : k == 1 ? std::string("1 reflection")
                                          : std::to_string(k);
        add(name, fmt::format("albedo of order {} [1]", order),
            kInks[static_cast<std::size_t>(std::min(k, 4) - 1)]);
        curves.back().brief = order;
    }
    for (const Layer* layer : layers) {
        const AlbedoByBounce albedo =
            albedo_by_bounce(measurement, *layer, std::max(1, orders), channel);
        const auto add_point = [&](PlotCurve& curve, const AlbedoShare& share) {
            curve.x.push_back(degrees(layer->theta_i));
            curve.y.push_back(share.value);
            curve.error.push_back(share.error);
        };
        add_point(curves.front(), albedo.total);
        for (std::size_t k = 0; k + 1 < curves.size(); ++k)
            add_point(curves[k + 1], albedo.order[k]);
    }
    return curves;
}

PlotCurve normals_curve(const std::vector<double>& density, const std::string& name,
                        const std::string& column, PlotInk ink) {
    PlotCurve curve;
    curve.name = name;
    curve.column = column;
    curve.ink = ink;
    curve.y = density;
    for (std::size_t t = 0; t < density.size(); ++t)
        curve.x.push_back(90 * (static_cast<double>(t) + 0.5) /
                          static_cast<double>(density.size()));
    return curve;
}

PlotAxis lobe_angles(const std::string& plane) {
    return {"θₒ in the " + plane + "  [°]", -90, 90, false, 30};
}

PlotAxis incidence_angles() {
    return {"angle of incidence  θᵢ  [°]", 0, 90, false, 15};
}

PlotAxis normal_angles(const CurveSet& set) {
    double tilt = 0;
    for (const PlotCurve& curve : set.curves) {
        if (curve.look == CurveLook::Dashes) continue;
        const double half = curve.x.empty() ? 0 : curve.x.front();
        for (std::size_t k = 0; k < curve.x.size(); ++k)
            if (curve.y[k] > 0) tilt = std::max(tilt, curve.x[k] + half);
    }
    const double end = std::clamp(15 * std::ceil(tilt / 15 - 1e-9), 15.0, 90.0);
    return {"tilt of the normal  θₘ  [°]", 0, end, false, end > 45 ? 15.0 : 5.0};
}

PlotAxis value_axis(const CurveSet& set, bool log, double decades, const std::string& label) {
    PlotAxis axis = axis_up_to(set.top(), log, decades);
    axis.label = label;
    return axis;
}

std::shared_ptr<const Plot> lobe_plot(CurveSet set, PlotAxis values, const std::string& plane,
                                      const std::vector<double>& theta_i_deg) {
    std::vector<CurvePlot::Upright> uprights;
    for (const double theta : theta_i_deg) {
        const bool first = uprights.empty();
        uprights.push_back({-theta, first ? "light" : "", PlotInk::Light});
        uprights.push_back({theta, first ? "mirror direction" : "", PlotInk::Mirror});
    }
    return std::make_shared<CurvePlot>(std::move(set), lobe_angles(plane), std::move(values),
                                       std::move(uprights));
}

}  // namespace asperity::plots

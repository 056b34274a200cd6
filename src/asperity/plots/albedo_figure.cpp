// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/plots/curves_of.h>
#include <asperity/plots/figures.h>
#include <asperity/plots/plot_frame.h>

#include <algorithm>
#include <cmath>

namespace asperity::plots::detail {

namespace {

constexpr int kOrdersShown = 4;
constexpr double kModelStep = 3;  ///< degrees

std::vector<const Layer*> layers_by_angle(const Measurement& m, double phi_deg) {
    std::vector<const Layer*> layers;
    for (const Layer& layer : m.layers) {
        const double apart = std::remainder(degrees(layer.phi_i) - phi_deg, 360.0);
        if (std::abs(apart) < 0.01 || layer.theta_i == 0) layers.push_back(&layer);
    }
    std::sort(layers.begin(), layers.end(),
              [](const Layer* a, const Layer* b) { return a->theta_i < b->theta_i; });
    return layers;
}

PlotCurve albedo_of_model(const PlotSubject& subject, int channel, PlotInk ink, const Run& run) {
    std::vector<double> theta, albedo;
    for (double t = 0; t < 90; t += kModelStep) {
        if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
        theta.push_back(t);
        albedo.push_back(albedo_at(*subject.model, radians(t), channel));
    }
    return model_curve(subject.name, subject.name, "albedo [1]", ink, std::move(theta),
                       std::move(albedo));
}

}  // namespace

PlotPointer albedo_figure(const Subjects& subjects, const PlotSettings& settings, Run& run) {
    const auto results = std::count_if(subjects.begin(), subjects.end(),
                                       [](const PlotSubject& s) { return s.measurement; });
    const bool by_order = results == 1;
    CurveSet set = albedo_set(!settings.title.empty() ? settings.title
                              : by_order              ? "Albedo by number of reflections"
                                                      : "Albedo");
    set.error_band = !settings.no_errors;
    int k = 0;
    for (const PlotSubject& subject : subjects) {
        const PlotInk ink = series_ink(k++);
        if (subject.model) {
            const int channel = channel_of(*subject.model, subjects, settings);
            set.curves.push_back(albedo_of_model(subject, channel, ink, run));
            continue;
        }
        const Measurement& m = *subject.measurement;
        const std::vector<const Layer*> layers = layers_by_angle(m, settings.phi);
        if (layers.empty())
            throw Error(ErrorCode::Usage, subject.name + " has no light from there", "phi");
        std::vector<PlotCurve> curves =
            albedo_curves(m, layers, channel_of(m, settings), by_order ? kOrdersShown : 0);
        if (!by_order) {
            curves.front().name = subject.name;
            curves.front().column = subject.name + ": albedo [1]";
            curves.front().ink = ink;
        }
        for (PlotCurve& curve : curves) set.curves.push_back(std::move(curve));
    }
    PlotAxis values = value_axis(set, is_log(settings), settings.decades, "albedo");
    return std::make_shared<CurvePlot>(std::move(set), incidence_angles(), std::move(values));
}

}  // namespace asperity::plots::detail

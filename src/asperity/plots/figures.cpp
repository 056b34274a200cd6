// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/figures.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/measured/compare.h>
#include <asperity/plots/curves_of.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace asperity::plots::detail {

namespace {

constexpr double kUsualTheta = 45;   ///< degrees
constexpr double kSameAngle = 0.01;  ///< degrees

std::string angle_text(double angle) {
    return fmt::format("{:.4g}", degrees(angle));
}

bool comes_from(const Layer& layer, double phi_deg) {
    const double apart = std::remainder(degrees(layer.phi_i) - phi_deg, 360.0);
    return std::abs(apart) < kSameAngle;
}

/// The layers with light from the azimuth of the settings; all of an isotropic measurement.
std::vector<const Layer*> layers_from(const PlotSubject& subject, double phi_deg) {
    std::vector<const Layer*> layers;
    std::set<std::string> azimuths;
    for (const Layer& layer : subject.measurement->layers) {
        azimuths.insert(angle_text(layer.phi_i) + "°");
        if (comes_from(layer, phi_deg) || layer.theta_i == 0) layers.push_back(&layer);
    }
    if (!layers.empty()) return layers;
    if (azimuths.empty()) throw Error(ErrorCode::InvalidInput, "has no layers", subject.name);
    throw Error(ErrorCode::Usage,
                fmt::format("{} has no light from {}°; it has {}", subject.name, phi_deg,
                            fmt::join(azimuths, ", ")),
                "phi");
}

const Layer* layer_at(const PlotSubject& subject, double theta_deg, double phi_deg) {
    std::string there;
    for (const Layer* layer : layers_from(subject, phi_deg)) {
        if (std::abs(degrees(layer->theta_i) - theta_deg) < kSameAngle) return layer;
        there += (there.empty() ? "" : ", ") + angle_text(layer->theta_i);
    }
    throw Error(
        ErrorCode::Usage,
        fmt::format("{} has no layer of {}°; its angles are {}", subject.name, theta_deg, there),
        "theta");
}

const Layer* layer_numbered(const PlotSubject& subject, int number) {
    std::string there;
    for (const Layer& layer : subject.measurement->layers) {
        if (layer.number == number) return &layer;
        there += fmt::format("{}{}", there.empty() ? "" : ", ", layer.number);
    }
    throw Error(ErrorCode::Usage,
                fmt::format("{} has no layer {}; it has {}", subject.name, number, there), "layer");
}

/// The layers of a measurement that are shown.
std::vector<const Layer*> shown_layers(const PlotSubject& subject, const PlotSettings& settings) {
    std::vector<const Layer*> layers;
    for (const double number : settings.layer)
        layers.push_back(layer_numbered(subject, static_cast<int>(number)));
    for (const double theta : settings.theta)
        layers.push_back(layer_at(subject, theta, settings.phi));
    if (!layers.empty()) return layers;
    const std::vector<const Layer*> all = layers_from(subject, settings.phi);
    return {*std::min_element(all.begin(), all.end(), [](const Layer* a, const Layer* b) {
        const auto off = [](const Layer* layer) {
            return std::abs(degrees(layer->theta_i) - kUsualTheta);
        };
        return off(a) < off(b);
    })};
}

/// What models are lit by.
std::vector<Layer> lights_of_models(const Subjects& subjects, const PlotSettings& settings) {
    std::vector<Layer> lights;
    const auto measured = std::find_if(subjects.begin(), subjects.end(),
                                       [](const PlotSubject& s) { return s.measurement; });
    if (measured != subjects.end()) {
        for (const Layer* layer : shown_layers(*measured, settings)) {
            lights.emplace_back();
            lights.back().number = layer->number;
            lights.back().theta_i = layer->theta_i;
            lights.back().phi_i = layer->phi_i;
        }
        return lights;
    }
    if (!settings.layer.empty())
        throw Error(ErrorCode::Usage, "models have no layers; choose angles by --theta", "layer");
    const std::vector<double> angles =
        settings.theta.empty() ? std::vector{kUsualTheta} : settings.theta;
    for (const double theta : angles) {
        lights.emplace_back();
        lights.back().theta_i = radians(theta);
        lights.back().phi_i = radians(settings.phi);
    }
    return lights;
}

}  // namespace

std::vector<LitSubject> lit_subjects(const Subjects& subjects, const PlotSettings& settings) {
    std::vector<LitSubject> lit;
    for (std::size_t k = 0; k < subjects.size(); ++k) {
        const PlotSubject& subject = subjects[k];
        const int index = static_cast<int>(k);
        if (subject.model) {
            for (const Layer& light : lights_of_models(subjects, settings))
                lit.push_back({&subject, light, nullptr, subject.name, index});
            continue;
        }
        for (const Layer* layer : shown_layers(subject, settings)) {
            Layer light;
            light.number = layer->number;
            light.theta_i = layer->theta_i;
            light.phi_i = layer->phi_i;
            lit.push_back({&subject, light, layer, subject.name, index});
        }
    }
    const bool several = std::any_of(lit.begin(), lit.end(), [&](const LitSubject& one) {
        return std::abs(one.light.theta_i - lit.front().light.theta_i) > radians(kSameAngle);
    });
    for (LitSubject& one : lit) {
        if (!several) continue;
        const std::string angle = fmt::format("θᵢ = {}°", angle_text(one.light.theta_i));
        one.name = subjects.size() == 1 ? angle : one.name + ", " + angle;
    }
    return lit;
}

const LitSubject* first_measured(const std::vector<LitSubject>& lit) {
    for (const LitSubject& one : lit)
        if (one.layer != nullptr) return &one;
    return nullptr;
}

std::string title_of(const std::vector<LitSubject>& lit, const PlotSettings& settings) {
    if (!settings.title.empty()) return settings.title;
    const LitSubject& first = lit.front();
    const bool one_subject = first.subject == lit.back().subject;
    if (lit.size() > 1 && one_subject) return first.subject->name;
    const std::string angle = fmt::format("θᵢ = {}°", angle_text(first.light.theta_i));
    if (lit.size() > 1 && first.light.theta_i != lit.back().light.theta_i) return "";
    if (lit.size() > 1) return "BRDF, " + angle;
    return first.layer != nullptr ? fmt::format("Layer {}, {}", first.light.number, angle)
                                  : "BRDF, " + angle;
}

int channel_of(const Measurement& measurement, const PlotSettings& settings) {
    if (settings.channel.empty()) return -1;
    const auto& names = measurement.channel_names;
    const auto found = std::find(names.begin(), names.end(), settings.channel);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    const auto number = parse_double(settings.channel);
    if (number && *number == std::floor(*number) && *number >= 0 &&
        *number < measurement.channels())
        return static_cast<int>(*number);
    throw Error(ErrorCode::Usage,
                fmt::format("'{}' is none of {}", settings.channel, fmt::join(names, ", ")),
                "channel");
}

int channel_of(const Bsdf& model, const Subjects& subjects, const PlotSettings& settings) {
    if (settings.channel.empty()) return -1;
    for (const PlotSubject& subject : subjects)
        if (subject.measurement) {
            const int channel = channel_of(*subject.measurement, settings);
            return channel < model.channels() ? channel : -1;
        }
    const auto number = parse_double(settings.channel);
    if (!number || *number != std::floor(*number) || *number < 0 || *number >= model.channels())
        throw Error(ErrorCode::Usage,
                    fmt::format("'{}' is no channel; {} has 0 .. {}", settings.channel,
                                model.name(), model.channels() - 1),
                    "channel");
    return static_cast<int>(*number);
}

bool is_log(const PlotSettings& settings) {
    if (settings.scale != PlotScale::Auto) return settings.scale == PlotScale::Log;
    return find_plot_kind(settings.kind)->usually_log;
}

}  // namespace asperity::plots::detail

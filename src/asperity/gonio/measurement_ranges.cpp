// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement_ranges.h>

#include <asperity/detector/illumination.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity {

namespace {

/// Angles of a file and those worked out anew from its experiment may differ by this [rad].
constexpr double kSameAngle = 1e-9;

template <class T>
bool all_errors(const std::vector<T>& errors, bool may_be_infinite) {
    return std::all_of(errors.begin(), errors.end(),
                       [=](T e) { return e >= 0 && (may_be_infinite || std::isfinite(e)); });
}

std::string wrong_errors(const Layer& layer) {
    // One batch alone tells no error
    const bool unknown = layer.batches == 1;
    const bool good = all_errors(layer.stderr_energy, unknown) &&
                      all_errors(layer.stderr_albedo, unknown) &&
                      all_errors(layer.stderr_albedo_by_bounce, unknown);
    return good ? "" : "an error that is negative or no number";
}

std::string wrong_counts(const Layer& layer, int bounces) {
    if (layer.batches < 0) return fmt::format("{} batches", layer.batches);
    if (static_cast<std::uint64_t>(layer.batches) > layer.rays)
        return fmt::format("{} batches of {} rays", layer.batches, layer.rays);
    if (layer.stuck > layer.rays)
        return fmt::format("{} of {} rays stuck", layer.stuck, layer.rays);
    if (layer.reflections / static_cast<std::uint64_t>(bounces) > layer.rays)
        return fmt::format("{} reflections of {} rays", layer.reflections, layer.rays);
    return {};
}

bool fits(const Layer& layer, const Incidence& light) {
    return layer.number == light.number && std::abs(layer.theta_i - light.theta) <= kSameAngle &&
           std::abs(layer.phi_i - light.phi) <= kSameAngle;
}

std::string wrong_surface(const Measurement& m) {
    if (m.surface_nx < 0 || m.surface_ny < 0)
        return fmt::format("a surface of {} x {} samples", m.surface_nx, m.surface_ny);
    const auto spacing = [](double d) { return std::isfinite(d) && d > 0; };
    if (!spacing(m.surface_dx) || !spacing(m.surface_dy))
        return fmt::format("a surface with samples {} x {} apart", m.surface_dx, m.surface_dy);
    return {};
}

}  // namespace

std::string out_of_range(const Measurement& m) {
    if (const std::string why = wrong_surface(m); !why.empty()) return why;
    if (m.layers.empty()) return {};
    const IlluminationSettings& illumination = m.experiment.illumination;
    if (illumination.layers == 0 && illumination.theta_deg.empty())
        return "layers as the lobe asks, without their angles";
    const std::vector<Incidence> expected = incidences(illumination);
    auto light = expected.begin();
    for (const Layer& layer : m.layers) {
        std::string why = wrong_errors(layer);
        if (why.empty()) why = wrong_counts(layer, m.bounces());
        // A stopped run has some of the layers, in their order
        light =
            std::find_if(light, expected.end(), [&](const Incidence& l) { return fits(layer, l); });
        if (light != expected.end())
            ++light;
        else if (why.empty())
            why = "the experiment has no such light, or the layers are not in its order";
        if (!why.empty()) return fmt::format("layer {}: {}", layer.number, why);
    }
    return {};
}

}  // namespace asperity

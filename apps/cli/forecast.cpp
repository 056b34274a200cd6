// SPDX-License-Identifier: Apache-2.0
#include "forecast.h"

#include "progress.h"
#include "report.h"

#include <asperity/core/energy.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::cli {

namespace {

constexpr double kLong = 60;            ///< seconds worth a word
constexpr double kFewRays = 5e5;        ///< never take as long
constexpr double kManyCells = 16e6;     ///< take longer to try than a word is worth
constexpr std::uint64_t kFirst = 4096;  ///< rays per direction of the first try
constexpr double kMostOfSecond = 1 << 21;
constexpr double kTrySeconds = 0.7;  ///< what the second try may cost

double rays_per_layer(const Experiment& e, const Heightfield& surface) {
    return rays_wanted(e.run, surface.cell_count());
}

/// The first, the middle and the last direction, with so many rays each.
Experiment small(const Experiment& experiment, std::uint64_t rays) {
    Experiment e = experiment;
    e.run.until = 0;
    e.run.surfaces = 1;
    e.run.rays = rays;
    e.run.batches = 2;
    e.detector.resolution = std::min(e.detector.resolution, 32);
    if (e.illumination.theta_deg.empty()) {
        e.illumination.layers = std::min(e.illumination.layers, 3);
    } else if (e.illumination.theta_deg.size() > 3) {
        const auto& t = experiment.illumination.theta_deg;
        e.illumination.theta_deg = {t.front(), t[t.size() / 2], t.back()};
    }
    e.illumination.phi_deg.resize(std::min<std::size_t>(e.illumination.phi_deg.size(), 1));
    return e;
}

struct Trial {
    double seconds = 0, rays = 0;
    Measurement m;
};

Trial tried(const Heightfield& surface, const Experiment& experiment, const Run& run) {
    Run own(run.threads());
    own.on_progress([&](const Progress&) {
        if (run.stop_requested()) own.request_stop();
    });
    Trial trial;
    trial.m = measure(surface, experiment, own);
    trial.seconds = trial.m.trace_seconds;
    trial.rays = static_cast<double>(launched_total(trial.m));
    return trial;
}

double truncated_share(const Measurement& m) {
    double sum = 0;
    for (const Layer& layer : m.layers)
        for (const auto energy : layer.truncated) sum += energy_fraction(energy, layer.rays);
    return sum / std::max(1.0, static_cast<double>(m.layers.size()) * m.channels());
}

/// The options that make a surface of this kind less steep, and what else helps.
std::string cure_of_steep(const SurfaceSettings& settings) {
    for (const char* option : {"alpha", "roughness", "tilt", "amplitude"})
        if (surface_uses(settings.kind, option))
            return fmt::format("a smaller --{} or --bounces makes", option);
    return "a smaller --height-scale or --bounces makes";
}

}  // namespace

Forecast forecast(const Heightfield& surface, const Experiment& experiment, const Run& run) {
    const double layers = static_cast<double>(incidences(experiment.illumination).size());
    const double rays = layers * rays_per_layer(experiment, surface);
    if (rays < kFewRays || static_cast<double>(surface.cell_count()) > kManyCells) return {};
    Trial trial = tried(surface, small(experiment, kFirst), run);
    if (!(trial.rays > 0)) return {};
    // Everything counted as if it were spent on rays: no run takes longer
    double per_ray = trial.seconds / trial.rays;
    if (per_ray * rays > kLong && !run.stop_requested()) {
        const double more = std::min(kMostOfSecond, kTrySeconds / per_ray / 3);
        if (more > 2.0 * kFirst) {
            const Trial second =
                tried(surface, small(experiment, static_cast<std::uint64_t>(more)), run);
            // What both spend alike is spent on the directions
            if (second.rays > trial.rays)
                per_ray =
                    std::max(0.0, second.seconds - trial.seconds) / (second.rays - trial.rays);
            trial = second;
        }
    }
    double reflections = 0;
    for (const Layer& layer : trial.m.layers) reflections += mean_bounces(layer);
    return {per_ray * rays, reflections / static_cast<double>(trial.m.layers.size()),
            truncated_share(trial.m), experiment.run.until > 0};
}

std::string Forecast::warning(const Experiment& experiment, const Heightfield& surface) const {
    constexpr double kSteep = 4, kCut = 0.01;
    if (seconds < kLong) return {};
    std::string text = fmt::format("{} {} min: ", at_least ? "at least" : "about",
                                   std::max(1.0, std::round(seconds / 60)));
    if (bounces > kSteep || truncated > kCut)
        return text + fmt::format(
                          "the surface is steep, a ray meets {:.3g} facets and {:.3g} % of "
                          "the light\nis truncated after --bounces {}; {} it shorter\n",
                          bounces, 100 * truncated, experiment.run.bounces,
                          cure_of_steep(experiment.surface));
    const auto layers = incidences(experiment.illumination).size();
    const double each = rays_per_layer(experiment, surface);
    return text + fmt::format(
                      "{}rays in each of {} directions; fewer --rays or --jitter make it "
                      "shorter\n",
                      short_number(each), layers);
}

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
#include "checks.h"

#include "expect.h"
#include "run_check.h"

#include <asperity/core/energy.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/statistics.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity::checks {

namespace {

/// launched = escaped + absorbed + truncated + edge, exactly, on every channel; and the cells hold
/// what escaped.
std::string energy_balance(const Measurement& m, const Layer& layer) {
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const auto channels = static_cast<std::size_t>(m.channels());
    for (std::size_t c = 0; c < channels; ++c) {
        const std::uint64_t sum =
            layer.escaped[c] + layer.absorbed[c] + layer.truncated[c] + layer.edge[c];
        if (sum != layer.rays * kRayEnergy) {
            return fmt::format("layer {}: {} units of energy launched, {} accounted for",
                               layer.number, layer.rays * kRayEnergy, sum);
        }
        std::uint64_t sorted = 0;
        for (std::size_t order = 0; order < static_cast<std::size_t>(m.orders()); ++order) {
            const auto first =
                layer.energy.begin() + static_cast<std::ptrdiff_t>((order * channels + c) * cells);
            sorted = std::accumulate(first, first + static_cast<std::ptrdiff_t>(cells), sorted);
        }
        if (sorted != layer.escaped[c]) {
            return fmt::format("layer {}: the cells hold {} units, {} escaped", layer.number,
                               sorted, layer.escaped[c]);
        }
    }
    return {};
}

std::string energy_balance(const Measurement& m) {
    for (const Layer& layer : m.layers) {
        const std::string failure = energy_balance(m, layer);
        if (!failure.empty()) return failure;
    }
    return {};
}

/// Draws the layer as the thesis' R x R sky-map and counts.
std::string texture_failure(const Measurement& m, const Layer& layer, int resolution) {
    const auto side = static_cast<std::size_t>(resolution);
    std::vector<int> filled(side * side, 0);
    std::vector<std::uint64_t> texture(side * side, 0);
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const SkyMapPoint p = thesis_sky_map(m.detector.centre(static_cast<int>(cell)));
        const std::size_t texel = static_cast<std::size_t>(p.v * resolution) * side +
                                  static_cast<std::size_t>(p.u * resolution);
        if (texel >= texture.size()) return "a cell lies outside the texture";
        ++filled[texel];
        for (std::size_t order = 0; order < static_cast<std::size_t>(m.orders()); ++order) {
            texture[texel] += layer.energy[order * cells + cell];
        }
    }
    const auto horizon = static_cast<std::ptrdiff_t>(side * side / 2);
    const auto above = [](int count) { return count == 1; };
    const auto below = [](int count) { return count == 0; };
    if (!std::all_of(filled.begin(), filled.begin() + horizon, above) ||
        !std::all_of(filled.begin() + horizon, filled.end(), below)) {
        return fmt::format("the cells do not cover the upper {} x {} texels once", resolution,
                           resolution / 2);
    }
    const std::uint64_t up =
        std::accumulate(texture.begin(), texture.begin() + horizon, std::uint64_t{0});
    const std::uint64_t down =
        std::accumulate(texture.begin() + horizon, texture.end(), std::uint64_t{0});
    if (up == 0) return "the texture is empty";
    if (up != layer.escaped[0]) return "the texels do not hold the energy that escaped";
    if (down != 0) return "there is energy below the horizon";
    return energy_balance(m, layer);
}

/// A surface of one kind, small enough for a moment's work.
SurfaceSettings shape(const std::string& kind, double tilt_deg = 45) {
    SurfaceSettings settings;
    settings.kind = kind;
    settings.size = 64;
    settings.tilt_deg = tilt_deg;
    return settings;
}

Experiment small_experiment(int resolution, std::uint64_t rays) {
    Experiment experiment;
    experiment.detector.resolution = resolution;
    experiment.run.rays = rays;
    experiment.run.batches = 4;
    return experiment;
}

/// Everything a flat mirror reflects goes into the cell of the mirror direction, at once.
std::string flat_mirror_failure(Run& run) {
    Experiment experiment = small_experiment(64, 1024);
    // Off the edges of the cells.
    constexpr double kAzimuth = 10;
    experiment.illumination.phi_deg = {kAzimuth};
    const Measurement m = measure(make_surface(shape("flat"), run), experiment, run);
    for (const Layer& layer : m.layers) {
        const int cell = m.detector.cell_of(from_spherical(layer.theta_i, radians(kAzimuth + 180)));
        if (layer.energy[static_cast<std::size_t>(cell)] != layer.rays * kRayEnergy) {
            return fmt::format("layer {}: not all energy is in the mirror's cell", layer.number);
        }
    }
    return m.layers.size() == 15 ? std::string() : "there are not 15 layers";
}

/// 45 degree walls turn light that comes down into light along the ground, and that back up: two
/// reflections, and out the way it came.
std::string groove_failure(Run& run) {
    Experiment experiment = small_experiment(64, 4096);
    experiment.illumination.theta_deg = {0};
    const Measurement m = measure(make_surface(shape("vgroove"), run), experiment, run);
    const Layer& layer = m.layers.at(0);
    const std::uint64_t launched = layer.rays * kRayEnergy;
    if (layer.escaped_by_bounce.at(1) != launched) {
        return "not all energy leaves after two reflections";
    }
    const auto second = layer.energy.begin() + m.detector.cells();
    const std::uint64_t back =
        std::accumulate(second, second + m.detector.columns(), std::uint64_t{0});
    return back == launched ? std::string() : "not all energy goes straight back";
}

std::string balance_failure(const OpticsSettings& optics, int bounces, Run& run) {
    SurfaceSettings settings = shape("thesis");
    settings.roughness = 0.3;
    Experiment experiment = small_experiment(32, 4096);
    experiment.optics = optics;
    experiment.run.bounces = bounces;
    const Measurement m = measure(make_surface(settings, run), experiment, run);
    const bool cut = std::any_of(m.layers.begin(), m.layers.end(),
                                 [](const Layer& layer) { return layer.truncated[0] > 0; });
    if (bounces == 1 && !cut) return "nothing is truncated after one reflection";
    return energy_balance(m);
}

std::string threads_failure(const Run& run) {
    Experiment experiment = small_experiment(32, 4096);
    experiment.illumination.theta_deg = {20, 70};
    std::string first;
    for (int threads : {1, 2, 3}) {
        stop_here(run);
        Run some(threads);
        const Heightfield surface = make_surface(shape("thesis"), some);
        const std::string sum = io::checksum(measure(surface, experiment, some));
        if (first.empty()) first = sum;
        if (sum != first) {
            return fmt::format("checksum {} with {} threads, {} with one", sum, threads, first);
        }
    }
    return {};
}

}  // namespace

void check_thesis(Run& run, const CheckReport& report) {
    check_textures(run, report);
    check_models(run, report);
}

void check_textures(Run& run, const CheckReport& report) {
    const Heightfield surface = make_surface(shape("thesis"), run);
    for (int resolution : {32, 64, 128, 256, 512}) {
        const Experiment experiment = small_experiment(resolution, surface.cell_count());
        const Measurement m = measure(surface, experiment, run);
        for (int number = 15; number >= 1; --number) {
            const std::string name =
                fmt::format("Texture layer {}, {} x {}", number, resolution, resolution);
            run_check(run, report, name, [&]() -> std::string {
                const auto layer = std::find_if(m.layers.begin(), m.layers.end(),
                                                [&](const Layer& l) { return l.number == number; });
                if (layer == m.layers.end()) return "the layer is missing";
                return texture_failure(m, *layer, resolution);
            });
        }
    }
}

void check_surfaces(Run& run, const CheckReport& report) {
    const auto figures = [&](const SurfaceSettings& settings) {
        return statistics(make_surface(settings, run), run);
    };
    run_check(run, report, "Surface flat: no height, no slope", [&] {
        const SurfaceStatistics s = figures(shape("flat"));
        return first_of({expect_near("RMS height", s.rms_height, 0, 0),
                         expect_near("RMS gradient", s.rms_gradient, 0, 0),
                         expect_near("area ratio", s.area_ratio, 1, 0)});
    });
    run_check(run, report, "Surface vgroove 45: slopes +-1, area sqrt 2", [&] {
        const SurfaceStatistics s = figures(shape("vgroove"));
        return first_of({expect_near("RMS slope x", s.rms_slope_x, 1, 1e-6),
                         expect_near("RMS slope y", s.rms_slope_y, 0, 0),
                         expect_near("mean tilt", s.mean_tilt_deg, 45, 1e-5),
                         expect_near("area ratio", s.area_ratio, std::sqrt(2.0), 1e-6)});
    });
    run_check(run, report, "Surface pyramids 30: every facet tilts 30 degrees", [&] {
        const SurfaceStatistics s = figures(shape("pyramids", 30));
        return first_of({expect_near("mean tilt", s.mean_tilt_deg, 30, 1e-4),
                         expect_near("largest tilt", s.max_tilt_deg, 30, 1e-4),
                         expect_near("mean slope x", s.mean_slope_x, 0, 1e-9)});
    });
    run_check(run, report, "Surface gaussian: realised alpha is the asked one", [&] {
        SurfaceSettings settings = shape("gaussian");
        settings.size = 128;
        return expect_near("alpha", figures(settings).rms_gradient, settings.alpha_x, 1e-4);
    });
    run_check(run, report, "Surface thesis: heights within 0 and 10 x roughness", [&] {
        const SurfaceSettings settings = shape("thesis");
        const SurfaceStatistics s = figures(settings);
        const double top = 10 * settings.roughness;
        if (s.min_height < 0 || s.max_height > top) return std::string("a height lies outside");
        return first_of(
            {expect_near("mean height", s.mean_height, top / 2, 0.05 * top),
             expect_near("RMS height", s.rms_height, top / std::sqrt(12.0), 0.05 * top)});
    });
}

void check_light(Run& run, const CheckReport& report) {
    run_check(run, report, "Flat mirror: all energy in the mirror's cell, 15 layers",
              [&] { return flat_mirror_failure(run); });
    run_check(run, report, "Groove of 45 degrees: straight back after two reflections",
              [&] { return groove_failure(run); });
    run_check(run, report, "Energy, perfect mirrors: launched = escaped + absorbed + truncated",
              [&] { return balance_failure({}, 16, run); });
    run_check(run, report, "Energy, one reflection: launched = escaped + absorbed + truncated",
              [&] { return balance_failure({}, 1, run); });
    run_check(run, report, "Energy, gold: launched = escaped + absorbed + truncated, per channel",
              [&] {
                  OpticsSettings gold;
                  gold.fresnel = FresnelKind::Conductor;
                  gold.material = "Au";
                  return balance_failure(gold, 16, run);
              });
    run_check(run, report, "One checksum with 1, 2 and 3 threads",
              [&] { return threads_failure(run); });
}

}  // namespace asperity::checks

// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "progress.h"
#include "table.h"

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace asperity::cli {

namespace {

/// Mean over the channels of a figure of each.
double channel_mean(int channels, const std::function<double(int)>& figure) {
    double sum = 0;
    for (int c = 0; c < channels; ++c) sum += figure(c);
    return sum / channels;
}

/// A share of the launched energy in percent.
std::string percent(double share) {
    return fmt::format("{:.2f} %", 100 * share);
}

std::string angle(double theta) {
    return fmt::format("{:.4g}°", degrees(theta));
}

/// As many digits as the error has two of, five at least.
std::string with_error(double value, double error) {
    constexpr int kLeast = 5, kMost = 17;
    if (error == 0) return fmt::format("{:.{}f} exact", value, kLeast);
    const int digits =
        std::isfinite(error)
            ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), kLeast, kMost)
            : kLeast;
    return fmt::format("{:.{}f} ± {:.{}f}", value, digits, error, digits);
}

/// Four decimals, or what is left of a smaller figure.
std::string distance(double value) {
    return value > 0 && value < 5e-5 ? fmt::format("{:.1e}", value) : fmt::format("{:.4f}", value);
}

const LayerComparison* comparison_of(const Layer& layer, const Comparison& comparison) {
    const auto same = [&](const LayerComparison& c) {
        return c.theta_i == layer.theta_i && c.phi_i == layer.phi_i;
    };
    const auto found = std::find_if(comparison.layers.begin(), comparison.layers.end(), same);
    return found == comparison.layers.end() ? nullptr : &*found;
}

/// Up to three channels get an albedo column each; more are averaged.
constexpr int kChannelColumns = 3;

class LayerTable {
  public:
    LayerTable(const Measurement& measurement, const std::optional<Comparison>& comparison)
        : m_(measurement),
          comparison_(comparison),
          phi_(std::any_of(m_.layers.begin(), m_.layers.end(),
                           [](const Layer& layer) { return layer.phi_i != 0; })),
          edge_(std::any_of(m_.layers.begin(), m_.layers.end(), [](const Layer& layer) {
              return std::any_of(layer.edge.begin(), layer.edge.end(),
                                 [](auto e) { return e > 0; });
          })) {}

    std::string text() const {
        Table table(heads());
        for (const Layer& layer : m_.layers) table.add(row(layer));
        return table.text();
    }

  private:
    std::vector<std::string> heads() const {
        std::vector<std::string> heads = {"layer", "theta_i"};
        if (phi_) heads.push_back("phi_i");
        if (m_.channels() == 1 || m_.channels() > kChannelColumns) {
            heads.push_back("albedo ± std. error");
        } else {
            for (const std::string& name : m_.channel_names) heads.push_back("albedo " + name);
        }
        heads.insert(heads.end(), {"1 bounce", "2 bounces", "3+", "absorbed", "truncated"});
        if (edge_) heads.push_back("edge loss");
        if (comparison_) heads.insert(heads.end(), {"L1", "noise"});
        return heads;
    }

    std::vector<std::string> row(const Layer& layer) const {
        std::vector<std::string> cells = {std::to_string(layer.number), angle(layer.theta_i)};
        if (phi_) cells.push_back(angle(layer.phi_i));
        add_albedo(layer, cells);
        add_bounces(layer, cells);
        const auto share = [&](const std::vector<std::uint64_t>& energy) {
            return percent(channel_mean(m_.channels(), [&](int c) {
                return energy_fraction(energy[static_cast<std::size_t>(c)], layer.rays);
            }));
        };
        cells.push_back(share(layer.absorbed));
        cells.push_back(share(layer.truncated));
        if (edge_) cells.push_back(share(layer.edge));
        if (comparison_) {
            const LayerComparison* found = comparison_of(layer, *comparison_);
            cells.push_back(found ? distance(found->l1) : "-");
            cells.push_back(found ? distance(found->l1_noise) : "-");
        }
        return cells;
    }

    void add_albedo(const Layer& layer, std::vector<std::string>& cells) const {
        const auto albedo = [&](int c) { return m_.albedo(layer, c); };
        const auto error = [&](int c) { return layer.stderr_albedo[static_cast<std::size_t>(c)]; };
        if (m_.channels() > kChannelColumns) {
            // Channels share their paths, so errors may all have one sign: their mean bounds it.
            cells.push_back(with_error(channel_mean(m_.channels(), albedo),
                                       channel_mean(m_.channels(), error)));
        } else {
            for (int c = 0; c < m_.channels(); ++c) {
                cells.push_back(with_error(albedo(c), error(c)));
            }
        }
    }

    /// Shares of the energy that escapes after one, two, and more reflections.
    void add_bounces(const Layer& layer, std::vector<std::string>& cells) const {
        const auto order = [&](int k) {
            return k < m_.bounces()
                       ? channel_mean(m_.channels(), [&](int c) { return m_.albedo(layer, k, c); })
                       : 0.0;
        };
        double rest = 0;
        for (int k = 2; k < m_.bounces(); ++k) rest += order(k);
        const double all = order(0) + order(1) + rest;
        for (double part : {order(0), order(1), rest}) {
            cells.push_back(all > 0 ? percent(part / all) : "-");
        }
    }

    const Measurement& m_;
    const std::optional<Comparison>& comparison_;
    bool phi_, edge_;
};

}  // namespace

std::string kind_name(const SurfaceSettings& settings) {
    return settings.kind == kSurfaceFile ? settings.file : settings.kind;
}

std::string surface_line(const SurfaceSettings& settings, const SurfaceStatistics& statistics,
                         int nx, int ny) {
    std::string asked;
    if (surface_uses(settings.kind, "roughness")) {
        asked = fmt::format("roughness {} asked", settings.roughness);
    } else if (surface_uses(settings.kind, "alpha")) {
        asked = settings.alpha_x == settings.alpha_y
                    ? fmt::format("alpha {} asked", settings.alpha_x)
                    : fmt::format("alpha {} x {} asked", settings.alpha_x, settings.alpha_y);
    }
    // A GGX surface has no RMS slope of its own: its figure grows with the largest slope allowed.
    const char* realised = surface_uses(settings.kind, "max-slope") ? "RMS gradient" : "alpha";
    return fmt::format(
        "{}, {} x {} samples, {}{}{} {:.4g} realised (x {:.4g}, y {:.4g}), "
        "RMS height {:.4g}",
        kind_name(settings), nx, ny, asked, asked.empty() ? "" : ", ", realised,
        statistics.rms_gradient, statistics.alpha_x, statistics.alpha_y, statistics.rms_height);
}

std::string tiling_line(const SurfaceSettings& settings, const Heightfield& surface) {
    if (surface.tiling.empty()) return {};
    const bool is_default = settings.tiling == SurfaceSettings{}.tiling;
    return surface.tiling + (is_default ? " (the default of --tiling)" : " (--tiling)");
}

std::string layer_table(const Measurement& measurement,
                        const std::optional<Comparison>& comparison) {
    return LayerTable(measurement, comparison).text();
}

std::string closing_lines(const Measurement& m) {
    std::string text;
    if (m.channels() > 1) {
        text += m.channels() > kChannelColumns
                    ? fmt::format("all figures are means over {} channels\n", m.channels())
                    : "shares are means over the channels\n";
    }
    text += fmt::format("{} rays, {:.2f} s, {}rays/s, {} threads\n", launched_total(m),
                        m.trace_seconds, short_number(rays_per_second(m)), m.threads);
    for (const std::string& note : m.notes) text += "note: " + note + "\n";
    return text;
}

std::uint64_t launched_total(const Measurement& measurement) {
    std::uint64_t sum = 0;
    for (const Layer& layer : measurement.layers) sum += layer.rays;
    return sum;
}

double rays_per_second(const Measurement& measurement) {
    return measurement.trace_seconds > 0
               ? static_cast<double>(launched_total(measurement)) / measurement.trace_seconds
               : 0.0;
}

double mean_bounces(const Layer& layer) {
    return layer.rays == 0
               ? 0.0
               : static_cast<double>(layer.reflections) / static_cast<double>(layer.rays);
}

}  // namespace asperity::cli

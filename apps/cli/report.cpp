// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "progress.h"
#include "table.h"

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/gonio/noise_shares.h>
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
    return fmt::format("{:.2f}", 100 * share);
}

std::string angle(double theta) {
    return fmt::format("{:.4g}°", degrees(theta));
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

/// Up to three channels get a row each; more are averaged.
constexpr int kChannelRows = 3;

class LayerTable {
  public:
    LayerTable(const Measurement& measurement, const std::optional<Comparison>& comparison)
        : m_(measurement),
          comparison_(comparison),
          phi_(std::any_of(m_.layers.begin(), m_.layers.end(),
                           [](const Layer& layer) { return layer.phi_i != 0; })),
          edge_(std::any_of(m_.layers.begin(), m_.layers.end(),
                            [](const Layer& layer) {
                                return std::any_of(layer.edge.begin(), layer.edge.end(),
                                                   [](auto e) { return e > 0; });
                            })),
          bands_(m_.channels() > 1 && m_.channels() <= kChannelRows) {}

    bool has_edge_loss() const { return edge_; }

    std::string text() const {
        const std::vector<std::string> heads = this->heads();
        Table table(heads, std::size_t{2} + (phi_ ? 1 : 0) + (bands_ ? 1 : 0));
        for (const Layer& layer : m_.layers) {
            for (int c = 0; c < (bands_ ? m_.channels() : 1); ++c) {
                std::vector<std::string> cells = row(layer, c);
                cells.resize(heads.size());
                table.add(std::move(cells));
            }
        }
        return table.text();
    }

  private:
    std::vector<std::string> heads() const {
        std::vector<std::string> heads = {"layer", "theta"};
        if (phi_) heads.emplace_back("phi");
        if (bands_) heads.emplace_back("band");
        heads.insert(heads.end(),
                     {"albedo", "1 bounce", "2 bounces", "3+", "absorbed", "truncated"});
        if (edge_) heads.emplace_back("edge loss");
        if (comparison_) heads.insert(heads.end(), {"L1", "noise"});
        return heads;
    }

    /// Of a channel, or of the mean over all where they have no rows of their own.
    std::vector<std::string> row(const Layer& layer, int channel) const {
        std::vector<std::string> cells = {std::to_string(layer.number), angle(layer.theta_i)};
        if (phi_) cells.push_back(angle(layer.phi_i));
        if (bands_) cells.push_back(m_.channel_names[static_cast<std::size_t>(channel)]);
        const auto figure = [&](const std::function<double(int)>& of) {
            return bands_ ? of(channel) : channel_mean(m_.channels(), of);
        };
        // Channels share their paths, so errors may all have one sign: their mean bounds it.
        cells.push_back(with_error(
            figure([&](int c) { return m_.albedo(layer, c); }),
            figure([&](int c) { return layer.stderr_albedo[static_cast<std::size_t>(c)]; })));
        const auto order = [&](int k) {
            if (k >= m_.bounces()) return 0.0;
            return figure([&](int c) { return m_.albedo(layer, k, c); });
        };
        double rest = 0;
        for (int k = 2; k < m_.bounces(); ++k) rest += order(k);
        for (const double part : {order(0), order(1), rest}) cells.push_back(percent(part));
        const auto share = [&](const std::vector<std::uint64_t>& energy) {
            return percent(figure([&](int c) {
                return energy_fraction(energy[static_cast<std::size_t>(c)], layer.rays);
            }));
        };
        cells.push_back(share(layer.absorbed));
        cells.push_back(share(layer.truncated));
        if (edge_) cells.push_back(share(layer.edge));
        if (comparison_ && channel == 0) {
            const LayerComparison* found = comparison_of(layer, *comparison_);
            cells.push_back(found ? distance(found->l1) : "-");
            cells.push_back(found ? distance(found->l1_noise) : "-");
        }
        return cells;
    }

    const Measurement& m_;
    const std::optional<Comparison>& comparison_;
    bool phi_, edge_, bands_;
};

}  // namespace

std::string surfaces_line(const Measurement& m) {
    const auto shares = shares_of_rays(m.layers);
    if (!shares) return {};
    const auto [fewest, most] =
        std::minmax_element(m.layers.begin(), m.layers.end(),
                            [](const Layer& a, const Layer& b) { return a.batches < b.batches; });
    const bool exact = std::all_of(m.layers.begin(), m.layers.end(), [](const Layer& layer) {
        return std::all_of(layer.stderr_albedo.begin(), layer.stderr_albedo.end(),
                           [](double error) { return error == 0; });
    });
    return fmt::format(
        "{} surfaces; of the squared errors the rays make {}{:.0f} % in cells,\n"
        "the rest is between surfaces\n",
        fewest->batches == most->batches ? fmt::format("{}", most->batches)
                                         : fmt::format("{} to {}", fewest->batches, most->batches),
        exact ? "" : fmt::format("{:.0f} % in albedos and ", 100 * shares->albedo),
        100 * shares->cells);
}

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

std::string with_error(double value, double error) {
    constexpr int kLeast = 0, kMost = 17, kOfExact = 5;
    if (error == 0) return fmt::format("{:.{}f} exact", value, kOfExact);
    if (!std::isfinite(error)) return fmt::format("{:.{}f}(?)", value, kOfExact);
    // Two digits of the error, counted after it is rounded to them: 0.0996 is 0.10.
    const std::string rounded = fmt::format("{:.1e}", error);
    const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
    const int digits = std::clamp(1 - exponent, kLeast, kMost);
    return fmt::format("{:.{}f}({:.0f})", value, digits, error * std::pow(10, digits));
}

std::string layer_table(const Measurement& measurement,
                        const std::optional<Comparison>& comparison) {
    const LayerTable table(measurement, comparison);
    std::string text = table.text() + "1 bounce, 2 bounces, 3+, absorbed, truncated" +
                       (table.has_edge_loss() ? ", edge loss" : "") +
                       ": % of the light that\ncomes in, together all of it; (12): standard error "
                       "of the last digits\n";
    if (measurement.channels() > kChannelRows)
        text += fmt::format("all figures are means over {} channels\n", measurement.channels());
    else if (measurement.channels() > 1 && comparison)
        text += "L1 and noise are means over the bands\n";
    return text;
}

std::string closing_lines(const Measurement& m) {
    std::string text;
    text += fmt::format("{} rays, {:.2f} s, {}rays/s, {} threads\n", launched_total(m),
                        m.trace_seconds, short_number(rays_per_second(m)), m.threads);
    text += surfaces_line(m);
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

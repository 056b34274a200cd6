// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/fit/fit_data.h>
#include <asperity/fit/lobe_blocks.h>
#include <asperity/gonio/cell_errors.h>
#include <asperity/gonio/experiment.h>
#include <asperity/measured/compare.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace asperity {
namespace {

/// Rows whose middle lies above `last_theta`.
int rows_below(const Detector& detector, double last_theta) {
    int rows = 1;
    while (rows < detector.rows() && detector.theta_centre(rows) < last_theta) ++rows;
    return rows;
}

/// Of the variance that counting rays would have, the least that is believed.
constexpr double kLeastVariance = 0.1;

/// The share of a cell's variance that the light fitted to has. On one surface light of solved
/// facets, reflected once, is known: what is followed varies, and by the share of one reflection in
/// *it*. Between surfaces all varies.
class VaryingShare {
  public:
    VaryingShare(const Measurement& m, const Layer& layer, FitLight light)
        : m_(m),
          layer_(layer),
          all_(light == FitLight::All),
          solved_(m.experiment.run.surfaces <= 1 && !layer.spread.exact.empty()) {}

    double operator()(int channel, int cell) const {
        if (all_) return 1;
        const auto k = static_cast<std::size_t>(channel * m_.detector.cells() + cell);
        const double all = m_.energy(layer_, channel, cell);
        const double once = m_.energy(layer_, 0, channel, cell);
        const double known =
            solved_ ? std::min(once, energy_fraction(layer_.spread.exact[k], layer_.rays)) : 0;
        return all > known ? (once - known) / (all - known) : 0;
    }

  private:
    const Measurement& m_;
    const Layer& layer_;
    bool all_, solved_;
};

/// Energies and variances of a layer. Where each batch meets each facet, as at normal incidence,
/// batches agree to a rounding; such a layer would count for a million of the others.
detail::LayerEnergies energies_of(const Measurement& m, const Layer& layer, FitLight light) {
    detail::LayerEnergies values;
    const VaryingShare share(m, layer, light);
    const int cells = m.detector.cells();
    for (int channel = 0; channel < m.channels(); ++channel) {
        double sum = 0;
        for (int cell = 0; cell < cells; ++cell) sum += m.energy(layer, channel, cell);
        const double least =
            layer.rays > 0 ? kLeastVariance * sum / static_cast<double>(layer.rays) : 0.0;
        for (int cell = 0; cell < cells; ++cell) {
            const double energy = light == FitLight::All ? m.energy(layer, channel, cell)
                                                         : m.energy(layer, 0, channel, cell);
            values.energy.push_back(energy);
            if (layer.stderr_energy.empty()) continue;
            const double error = static_cast<double>(
                layer.stderr_energy[static_cast<std::size_t>(channel * cells + cell)]);
            const double variance = error * error * share(channel, cell);
            values.variance.push_back(error > 0 ? std::max(variance, least * energy) : variance);
        }
    }
    return values;
}

/// A layer whose batches agree to the last bit, beside others that do not: each batch met each
/// facet. The least variance that is believed stands for it.
void believe_least(detail::LayerEnergies& values, const Layer& layer, int channels) {
    const std::size_t cells = values.energy.size() / static_cast<std::size_t>(channels);
    for (std::size_t c = 0; c < values.energy.size(); c += cells) {
        double sum = 0;
        for (std::size_t k = c; k < c + cells; ++k) sum += values.energy[k];
        for (std::size_t k = c; k < c + cells; ++k)
            values.variance[k] =
                kLeastVariance * sum / static_cast<double>(layer.rays) * values.energy[k];
    }
}

/// What errors of all light are times for those of the light fitted to.
std::vector<double> error_share(const Measurement& m, const Layer& layer, FitLight light) {
    const VaryingShare varying(m, layer, light);
    std::vector<double> share;
    for (int channel = 0; light == FitLight::Single && channel < m.channels(); ++channel)
        for (int cell = 0; cell < m.detector.cells(); ++cell)
            share.push_back(std::sqrt(varying(channel, cell)));
    return share;
}

std::vector<int> cells_of(const FitBlock& block, int columns) {
    std::vector<int> cells;
    for (int row = block.row0; row < block.row1; ++row)
        for (int column = block.column0; column < block.column1; ++column)
            cells.push_back(row * columns + column);
    return cells;
}

/// Variance of blocks of several cells as their batches tell it, and as their cells would if they
/// knew nothing of each other; apart by the number of cells, to powers of two. One block has 16
/// groups of batches, too few to tell its own.
class DesignEffects {
  public:
    void add(const FitBlock& block, const Measurement& m, const Layer& layer,
             const CellErrors& errors) {
        if (block.cells() < 2) return;
        const std::vector<int> cells = cells_of(block, m.detector.columns());
        Sums& sums = sums_[size_class(block)];
        for (int c = 0; c < m.channels(); ++c) {
            const double error = errors.error_of_cells(static_cast<std::size_t>(c), cells);
            sums.found += error * error;
            for (const int cell : cells) {
                const double own = double{
                    layer.stderr_energy[static_cast<std::size_t>(c * m.detector.cells() + cell)]};
                sums.apart += own * own;
            }
        }
        ++sums.blocks;
    }

    double of(const FitBlock& block) const {
        return block.cells() < 2 ? 1.0 : ratio(sums_[size_class(block)]);
    }

  private:
    static constexpr int kFewest = 4;  ///< blocks, of 15 degrees of freedom each
    struct Sums {
        double found = 0, apart = 0;
        int blocks = 0;
    };
    static std::size_t size_class(const FitBlock& block) {
        return static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(block.cells())));
    }
    static double ratio(const Sums& sums) {
        const bool told = sums.blocks >= kFewest && sums.found > 0 && sums.apart > 0;
        return told && std::isfinite(sums.found) ? sums.found / sums.apart : 1.0;
    }

    std::array<Sums, 33> sums_{};
};

/// Takes variances of blocks of several cells from batches.
void tell_blocks_from_batches(FitData& data, const Measurement& m,
                              const std::vector<const Layer*>& layers) {
    const auto channels = static_cast<std::size_t>(data.channels);
    double before = 0, after = 0;
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const FitLayer& fitted = data.layers[l];
        const std::size_t end = fitted.first_block + fitted.blocks;
        DesignEffects effects;
        for (std::size_t b = fitted.first_block; b < end; ++b)
            effects.add(data.blocks[b], m, *layers[l], *fitted.errors);
        for (std::size_t b = fitted.first_block; b < end; ++b) {
            const double effect = effects.of(data.blocks[b]);
            const bool several = data.blocks[b].cells() > 1;
            for (std::size_t k = b * channels; k < (b + 1) * channels; ++k) {
                before += several ? data.spread[k] * data.energy[k] : 0.0;
                data.spread[k] *= effect;
                after += several ? data.spread[k] * data.energy[k] : 0.0;
            }
        }
    }
    if (before > 0) data.design_effect = after / before;
}

bool any(const std::vector<double>& values) {
    for (const double value : values)
        if (value > 0) return true;
    return false;
}

/// Errors of one surface are those of the rays: how it differs from others of its kind is no part
/// of them, and where there are many rays most of what a model of the kind does not meet.
std::string missing_in_errors(const Measurement& m) {
    const SurfaceSettings& surface = m.experiment.surface;
    const bool file = surface.kind == kSurfaceFile;
    if (m.experiment.run.surfaces > 1 || (!file && !only_surface(surface).empty())) return {};
    return std::string("one surface was measured: the errors are those of the rays, not of how ") +
           (file ? "other places of the sample" : "surfaces of this kind") +
           " differ, so chi2/dof above 1 may be its speckle" +
           (file ? "" : "; simulate --surfaces 16 or more has both in its errors");
}

void require_layers(const FitData& data) {
    if (data.layers.empty())
        throw Error(ErrorCode::InvalidInput, "has no layer to fit to at these angles", data.name);
}

}  // namespace

FitData fit_data(const Measurement& m, FitLight light, double last_theta) {
    FitData data;
    data.name = m.surface_name;
    data.detector = m.detector;
    data.channels = m.channels();
    data.turns_with_light = m.experiment.illumination.isotropic;
    data.optics = m.experiment.optics;
    data.knows_optics = true;
    if (light == FitLight::Single && m.orders() < 2 && m.bounces() > 1)
        throw Error(
            ErrorCode::InvalidInput,
            "its orders of bounces were not kept apart, so light reflected once is not known",
            data.name);
    bool errors = true, some = false;
    std::vector<detail::LayerEnergies> values;
    for (const Layer& layer : m.layers) {
        values.push_back(energies_of(m, layer, light));
        const bool here = any(values.back().variance);
        errors = errors && (here || (layer.batches > 1 && !values.back().variance.empty()));
        some = some || here;
        if (!here && errors) believe_least(values.back(), layer, data.channels);
    }
    errors = errors && some;
    const bool batches = errors && std::all_of(m.layers.begin(), m.layers.end(), CellErrors::known);
    std::vector<const Layer*> fitted;
    for (std::size_t k = 0; k < m.layers.size(); ++k) {
        const Layer& layer = m.layers[k];
        if (layer.theta_i >= last_theta || !any(values[k].energy)) continue;
        if (!errors) values[k].variance.clear();
        FitLayer added = {layer.theta_i, layer.phi_i, from_spherical(layer.theta_i, layer.phi_i)};
        if (batches) {
            added.errors = std::make_shared<const CellErrors>(m, layer);
            added.error_share = error_share(m, layer, light);
        }
        detail::append_blocks(data, added, values[k], rows_below(data.detector, last_theta));
        fitted.push_back(&layer);
    }
    if (batches) tell_blocks_from_batches(data, m, fitted);
    if (data.has_errors()) data.errors_lack = missing_in_errors(m);
    require_layers(data);
    return data;
}

FitData fit_data(const Bsdf& bsdf, const Experiment& experiment, double last_theta, int threads) {
    FitData data;
    data.name = bsdf.name();
    data.detector = Detector(experiment.detector);
    data.channels = bsdf.channels();
    data.turns_with_light = experiment.illumination.isotropic;
    for (const Incidence& light : incidences(experiment.illumination)) {
        if (light.theta >= last_theta) continue;
        CellAverages averages = average_over_cells(bsdf, data.detector, light.theta, light.phi,
                                                   data.turns_with_light, threads);
        if (!any(averages.energy)) continue;
        detail::append_blocks(
            data, {light.theta, light.phi, from_spherical(light.theta, light.phi), 0, 0},
            {std::move(averages.energy), {}}, rows_below(data.detector, last_theta));
    }
    require_layers(data);
    return data;
}

std::vector<double> predict(const FitData& data, const Bsdf& model, int threads) {
    const auto channels = static_cast<std::size_t>(data.channels);
    const auto own = static_cast<std::size_t>(model.channels());
    if (own != channels && own != 1 && channels != 1)
        throw Error(ErrorCode::Usage,
                    fmt::format("the data have {} channels, the model {}", channels, own),
                    model.name());
    std::vector<double> energy(data.blocks.size() * channels, 0.0);
    constexpr std::size_t kAtOnce = 32;
    const std::size_t pieces = (data.blocks.size() + kAtOnce - 1) / kAtOnce;
    parallel_for(pieces, threads, [&](std::size_t piece) {
        std::array<double, kMaxBsdfChannels> values{};
        const std::span<double> f = std::span(values).first(own);
        const std::size_t end = std::min(data.blocks.size(), (piece + 1) * kAtOnce);
        for (std::size_t b = piece * kAtOnce; b < end; ++b) {
            const FitBlock& block = data.blocks[b];
            double* const out = &energy[b * channels];
            for (std::size_t n = block.first_node; n < block.first_node + block.nodes; ++n) {
                const FitNode& node = data.nodes[n];
                model.eval(data.layers[block.layer].wi, node.wo, f);
                if (channels == 1)
                    for (const double value : f) out[0] += node.weight * value / double(own);
                else
                    for (std::size_t c = 0; c < channels; ++c)
                        out[c] += node.weight * f[own == 1 ? 0 : c];
            }
        }
    });
    return energy;
}

std::vector<double> over_cells(const FitData& data, const std::vector<double>& energy,
                               const FitLayer& layer) {
    std::vector<double> cells(static_cast<std::size_t>(data.detector.cells()),
                              std::numeric_limits<double>::quiet_NaN());
    const auto channels = static_cast<std::size_t>(data.channels);
    for (std::size_t b = layer.first_block; b < layer.first_block + layer.blocks; ++b) {
        const FitBlock& block = data.blocks[b];
        double mean = 0;
        for (std::size_t c = 0; c < channels; ++c)
            mean += energy[b * channels + c] / (data.channels * block.solid_angle);
        for (int row = block.row0; row < block.row1; ++row)
            for (int column = block.column0; column < block.column1; ++column)
                cells[static_cast<std::size_t>(row * data.detector.columns() + column)] = mean;
    }
    return cells;
}

double multiple_share(const Measurement& m) {
    double once = 0, all = 0;
    for (const Layer& layer : m.layers)
        for (int channel = 0; channel < m.channels(); ++channel) {
            once += m.albedo(layer, 0, channel);
            all += m.albedo(layer, channel);
        }
    return all > 0 ? 1 - once / all : 0;
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/gonio/cell_errors.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/tabulated.h>
#include <asperity/tracing/launch.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace asperity {
namespace {

/// One incident direction as both sides of a comparison give it.
struct Lobes {
    std::vector<double> energy;  ///< [channel * cells + cell], fraction of the launched energy
    std::vector<double> noise;   ///< its standard error, same shape; empty: exact
    std::vector<double> albedo;  ///< per channel
    bool exact = true;           ///< no measurement
    std::optional<CellErrors> errors;  ///< of a measurement that holds what they come from
};

Lobes lobes_of(const Measurement& m, const Layer& layer) {
    Lobes lobes;
    if (CellErrors::known(layer)) lobes.energy = lobes.errors.emplace(m, layer).energies();
    for (int channel = 0; channel < m.channels(); ++channel) {
        lobes.albedo.push_back(m.albedo(layer, channel));
        if (lobes.errors) continue;
        const std::vector<double> energies = m.energies(layer, channel);
        lobes.energy.insert(lobes.energy.end(), energies.begin(), energies.end());
    }
    lobes.noise.assign(layer.stderr_energy.begin(), layer.stderr_energy.end());
    lobes.exact = false;
    return lobes;
}

Lobes lobes_of(CellAverages averages) {
    return {std::move(averages.energy), {}, std::move(averages.albedo), true, {}};
}

[[noreturn]] void differ(std::string what) {
    throw Error(ErrorCode::InvalidInput, "cannot be compared: " + std::move(what));
}

void require_channels(int a, int b) {
    if (a != b && a != 1 && b != 1) differ(fmt::format("one has {} channels, the other {}", a, b));
}

/// By how much the figures of a comparison change with each energy of one side, to first order.
struct Slopes {
    std::vector<double> albedo, l1, rms;  ///< [channel * cells + cell]; empty: of no use

    explicit Slopes(const Lobes& side) {
        if (!side.errors) return;
        for (std::vector<double>* slopes : {&albedo, &l1, &rms}) slopes->resize(side.energy.size());
    }

    /// Of the cells from k on that differ by so much; `share` with the sign of the side.
    void add(std::size_t k, const std::vector<double>& differences, double share,
             double solid_angle) {
        if (l1.empty()) return;
        for (std::size_t n = 0; n < differences.size(); ++n) {
            const double difference = differences[n];
            const double sign = difference > 0 ? 1 : difference < 0 ? -1 : 0;
            albedo[k + n] += share;
            l1[k + n] += share * sign;
            rms[k + n] += share * difference / solid_angle;
        }
    }
};

/// Standard error of a figure that is about `value`, from those of both sides' energies; NaN where
/// one is not known. Batches of which each has all there is differ by the rounding of their sums.
double error_of(const Lobes& a, const Slopes& by_a, const Lobes& b, const Slopes& by_b,
                std::vector<double> Slopes::*figure, double value) {
    constexpr double kRounding = 1e-12;
    const auto of_side = [&](const Lobes& side, const Slopes& slopes) {
        if (side.exact) return 0.0;
        return side.errors ? side.errors->error(slopes.*figure)
                           : std::numeric_limits<double>::quiet_NaN();
    };
    const double error = std::hypot(of_side(a, by_a), of_side(b, by_b));
    return error < kRounding * value ? 0.0 : error;
}

/// Standard error of the difference of two energies.
double noise_of(const Lobes& a, std::size_t ka, const Lobes& b, std::size_t kb) {
    if (a.noise.empty()) return b.noise.empty() ? 0.0 : b.noise[kb];
    return b.noise.empty() ? a.noise[ka] : std::hypot(a.noise[ka], b.noise[kb]);
}

/// The distances of two lobes over the cells of `detector`, averaged over the channels; a side of
/// one channel serves all channels of the other.
LayerComparison compare_lobes(const Lobes& a, const Lobes& b, const Detector& detector) {
    const std::size_t cells = static_cast<std::size_t>(detector.cells());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t channels = std::max(a.albedo.size(), b.albedo.size());
    const double share = 1 / static_cast<double>(channels);
    const double noise_to_l1 = std::sqrt(2 / kPi);  // mean |x| of a normal x of unit variance

    LayerComparison result;
    Slopes by_a(a), by_b(b);
    std::vector<double> differences(columns);
    double squares = 0;
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::size_t ca = a.albedo.size() == 1 ? 0 : channel;
        const std::size_t cb = b.albedo.size() == 1 ? 0 : channel;
        result.albedo_a += share * a.albedo[ca];
        result.albedo_b += share * b.albedo[cb];
        for (std::size_t first = 0; first < cells; first += columns) {
            const std::size_t ka = ca * cells + first, kb = cb * cells + first;
            // f cos(theta) of a cell is its energy per solid angle.
            const double solid_angle = detector.solid_angle(static_cast<int>(first / columns));
            for (std::size_t k = 0; k < columns; ++k) {
                const double difference = a.energy[ka + k] - b.energy[kb + k];
                differences[k] = difference;
                result.l1 += share * std::abs(difference);
                squares += share * difference * difference / solid_angle;
                result.l1_noise += share * noise_to_l1 * noise_of(a, ka + k, b, kb + k);
            }
            by_a.add(ka, differences, share, solid_angle);
            by_b.add(kb, differences, -share, solid_angle);
        }
    }
    result.albedo_difference = result.albedo_a - result.albedo_b;
    result.rms = std::sqrt(squares / (2 * kPi));
    const auto error = [&](std::vector<double> Slopes::*figure, double value) {
        return error_of(a, by_a, b, by_b, figure, value);
    };
    result.albedo_difference_error = error(&Slopes::albedo, result.albedo_a);
    result.l1_error = error(&Slopes::l1, result.l1);
    const double rms_slope = 2 * kPi * result.rms;
    if (result.rms > 0) result.rms_error = error(&Slopes::rms, rms_slope * result.rms) / rms_slope;
    return result;
}

void add(Comparison& comparison, LayerComparison layer, int number, double theta_i, double phi_i) {
    layer.number = number;
    layer.theta_i = theta_i;
    layer.phi_i = phi_i;
    comparison.layers.push_back(layer);
}

void summarise(Comparison& c) {
    for (const LayerComparison& layer : c.layers) {
        c.mean_l1 += layer.l1;
        c.mean_rms += layer.rms;
        c.mean_l1_error = std::hypot(c.mean_l1_error, layer.l1_error);
        c.mean_rms_error = std::hypot(c.mean_rms_error, layer.rms_error);
        c.max_albedo_difference =
            std::max(c.max_albedo_difference, std::abs(layer.albedo_difference));
    }
    const double count = std::max(1.0, static_cast<double>(c.layers.size()));
    c.mean_l1 /= count;
    c.mean_rms /= count;
    c.mean_l1_error /= count;
    c.mean_rms_error /= count;
}

std::string unlike_detectors(const Detector& a, const Detector& b) {
    if (a.kind() != b.kind())
        return "one has a latitude-longitude detector, the other one of equal areas";
    if (a.rows() == b.rows() && a.columns() == b.columns()) return {};
    return fmt::format("one has {} x {} cells, the other {} x {}", a.rows(), a.columns(), b.rows(),
                       b.columns());
}

bool same_direction(const Layer& a, const Layer& b) {
    constexpr double kTolerance = 1e-9;
    return std::abs(a.theta_i - b.theta_i) < kTolerance &&
           std::abs(std::remainder(a.phi_i - b.phi_i, 2 * kPi)) < kTolerance;
}

/// The layer of `b` with the incidence of `layer`, or nullptr.
const Layer* partner(const Measurement& b, const Layer& layer) {
    for (const Layer& other : b.layers)
        if (same_direction(layer, other)) return &other;
    return nullptr;
}

}  // namespace

std::string unlike(const Measurement& a, const Measurement& b) {
    if (std::string why = unlike_detectors(a.detector, b.detector); !why.empty()) return why;
    if (a.experiment.illumination.isotropic != b.experiment.illumination.isotropic)
        return "one averages over the azimuth of the light, the other does not";
    if (a.layers.size() != b.layers.size())
        return fmt::format("one has {} layers, the other {}", a.layers.size(), b.layers.size());
    for (const Layer& layer : a.layers)
        if (partner(b, layer) == nullptr)
            return fmt::format("only one has a layer at theta {:.6g}, phi {:.6g} degrees",
                               degrees(layer.theta_i), degrees(layer.phi_i));
    return {};
}

Comparison compare(const Measurement& a, const Measurement& b) {
    require_channels(a.channels(), b.channels());
    if (std::string why = unlike(a, b); !why.empty()) differ(std::move(why));

    Comparison result{a.surface_name, b.surface_name, {}};
    for (const Layer& layer : a.layers)
        add(result, compare_lobes(lobes_of(a, layer), lobes_of(b, *partner(b, layer)), a.detector),
            layer.number, layer.theta_i, layer.phi_i);
    summarise(result);
    return result;
}

Comparison compare_between_layers(const Measurement& a, const Measurement& b, const Run& run) {
    require_channels(a.channels(), b.channels());
    Comparison result = compare(a, *make_tabulated_brdf(b, run), run.threads());
    result.name_b = b.surface_name;
    return result;
}

Comparison compare(const Measurement& a, const Bsdf& b, int threads) {
    require_channels(a.channels(), b.channels());
    Comparison result{a.surface_name, b.name(), {}};
    // Layers side by side, or what is in one where there are fewer of them than threads
    const bool apart = a.layers.size() >= static_cast<std::size_t>(std::max(1, threads));
    std::vector<LayerComparison> found(a.layers.size());
    parallel_for(found.size(), apart ? threads : 1, [&](std::size_t k) {
        const Layer& layer = a.layers[k];
        CellAverages model =
            average_over_cells(b, a.detector, layer.theta_i, layer.phi_i,
                               a.experiment.illumination.isotropic, apart ? 1 : threads);
        found[k] = compare_lobes(lobes_of(a, layer), lobes_of(std::move(model)), a.detector);
    });
    for (std::size_t k = 0; k < found.size(); ++k)
        add(result, found[k], a.layers[k].number, a.layers[k].theta_i, a.layers[k].phi_i);
    summarise(result);
    return result;
}

Comparison compare(const Bsdf& a, const Bsdf& b, const Experiment& experiment, int threads) {
    require_channels(a.channels(), b.channels());
    const Detector detector(experiment.detector);
    Comparison result{a.name(), b.name(), {}};
    for (const Incidence& light : incidences(experiment.illumination)) {
        const auto averages = [&](const Bsdf& brdf) {
            return lobes_of(average_over_cells(brdf, detector, light.theta, light.phi,
                                               experiment.illumination.isotropic, threads));
        };
        add(result, compare_lobes(averages(a), averages(b), detector), light.number, light.theta,
            light.phi);
    }
    summarise(result);
    return result;
}

}  // namespace asperity

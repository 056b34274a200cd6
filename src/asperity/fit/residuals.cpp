// SPDX-License-Identifier: Apache-2.0
#include <asperity/fit/residuals.h>
#include <asperity/gonio/cell_errors.h>

#include <algorithm>
#include <cmath>

namespace asperity::detail {
namespace {

/// Derivative of shown().
double shown_slope(FitMetric metric, double v) {
    switch (metric) {
        case FitMetric::Log:
            return 1 / (1 + v);
        case FitMetric::CubeRoot:
            return v > 0 ? 1 / (3 * std::cbrt(v * v)) : 0.0;
        case FitMetric::Auto:
        case FitMetric::Chi2:
        case FitMetric::L2:
            break;
    }
    return 1;
}

/// The least that is believed of what a model expects where rays of this weight brought `found`:
/// not much less than that, nor less than a ray.
double least_expected(double ray, double found) {
    return std::max(0.25 * found, ray);
}

double variance_of(double ray, double found, double expected) {
    return ray * std::max(expected, least_expected(ray, found));
}

/// Variance over energy in each layer, [block * channels + channel].
std::vector<double> mean_spread(const FitData& data) {
    if (!data.has_errors()) return {};
    const auto channels = static_cast<std::size_t>(data.channels);
    std::vector<double> energy(data.layers.size() * channels), variance(energy.size());
    for (std::size_t k = 0; k < data.energy.size(); ++k) {
        const std::size_t at = data.blocks[k / channels].layer * channels + k % channels;
        energy[at] += data.energy[k];
        variance[at] += data.spread[k] * data.energy[k];
    }
    std::vector<double> spread(data.energy.size());
    for (std::size_t k = 0; k < spread.size(); ++k) {
        const std::size_t at = data.blocks[k / channels].layer * channels + k % channels;
        spread[k] = energy[at] > 0 ? variance[at] / energy[at] : 0;
    }
    return spread;
}

double shown(FitMetric metric, double v) {
    switch (metric) {
        case FitMetric::Log:
            return std::log1p(v);
        case FitMetric::CubeRoot:
            return std::cbrt(v);
        case FitMetric::Auto:
        case FitMetric::Chi2:
        case FitMetric::L2:
            break;
    }
    return v;
}

}  // namespace

Residuals::Residuals(const FitData& data, const FreeModel& model, FitMetric metric, int threads)
    : data_(data), model_(model), metric_(metric), threads_(threads), ray_(mean_spread(data)) {
    weights_.assign(data.energy.size(), 0.0);
    const auto channels = static_cast<std::size_t>(data.channels);
    double total = 0;
    for (const FitBlock& block : data.blocks) total += block.solid_angle;
    for (std::size_t k = 0; k < weights_.size(); ++k) {
        const double solid_angle = data.blocks[k / channels].solid_angle;
        shown_.push_back(shown(metric, data.energy[k] / solid_angle));
        weights_[k] = std::sqrt(solid_angle / (total * data.channels));
    }
    counts_ = metric == FitMetric::Chi2;
}

void Residuals::expect(const std::vector<double>& energy) {
    if (metric_ != FitMetric::Chi2) return;
    counts_ = false;
    const auto channels = static_cast<std::size_t>(data_.channels);
    for (std::size_t k = 0; k < weights_.size(); ++k) {
        const double variance = variance_of(ray_[k], data_.energy[k], energy[k]) * data_.channels;
        weights_[k] =
            variance > 0 ? data_.blocks[k / channels].solid_angle / std::sqrt(variance) : 0;
    }
}

std::vector<double> Residuals::energy(const std::vector<double>& values) const {
    return predict(data_, *model_.make(values), threads_);
}

std::vector<double> Residuals::at(const std::vector<double>& values) const {
    return of_energy(energy(values));
}

std::vector<double> Residuals::of_energy(const std::vector<double>& energy) const {
    const auto channels = static_cast<std::size_t>(data_.channels);
    std::vector<double> residuals(energy.size());
    for (std::size_t k = 0; k < energy.size(); ++k) {
        if (counts_) {
            const double ray = ray_[k];
            if (!(ray > 0)) continue;
            const double n = data_.energy[k] / ray, m = energy[k] / ray;
            residuals[k] = (std::sqrt(4 * m + 1) - std::sqrt(n) - std::sqrt(n + 1)) /
                           std::sqrt(data_.channels);
            continue;
        }
        const double v = energy[k] / data_.blocks[k / channels].solid_angle;
        residuals[k] = weights_[k] * (shown(metric_, v) - shown_[k]);
    }
    return residuals;
}

std::vector<double> Residuals::slopes() const {
    const auto channels = static_cast<std::size_t>(data_.channels);
    std::vector<double> slopes(weights_.size());
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        const double solid_angle = data_.blocks[k / channels].solid_angle;
        slopes[k] = weights_[k] * shown_slope(metric_, data_.energy[k] / solid_angle) / solid_angle;
    }
    return slopes;
}

std::vector<double> Residuals::noise() const {
    std::vector<double> squares = slopes();
    for (std::size_t k = 0; k < squares.size(); ++k) {
        const double found = data_.energy[k];
        squares[k] *= squares[k] * variance_of(data_.spread[k], found, found) * data_.channels;
    }
    return squares;
}

std::vector<double> Residuals::growth(const std::vector<double>& energy) const {
    std::vector<double> growth(energy.size(), 1.0);
    for (std::size_t k = 0; metric_ == FitMetric::Chi2 && k < energy.size(); ++k)
        if (energy[k] > least_expected(ray_[k], data_.energy[k]))
            growth[k] = data_.energy[k] / energy[k];
    return growth;
}

std::vector<double> score_covariances(const Residuals& residuals,
                                      const std::vector<std::vector<double>>& jacobian) {
    const FitData& data = residuals.data();
    const std::vector<double> slopes = residuals.slopes();
    const auto channels = static_cast<std::size_t>(data.channels);
    const auto cells = static_cast<std::size_t>(data.detector.cells());
    const auto columns = static_cast<std::size_t>(data.detector.columns());
    std::vector<double> sum(jacobian.size() * jacobian.size());
    std::vector<std::vector<double>> weights(jacobian.size());
    for (const FitLayer& layer : data.layers) {
        for (std::vector<double>& w : weights) w.assign(channels * cells, 0.0);
        for (std::size_t b = layer.first_block; b < layer.first_block + layer.blocks; ++b) {
            const FitBlock& block = data.blocks[b];
            for (std::size_t c = 0; c < channels; ++c)
                for (int row = block.row0; row < block.row1; ++row)
                    for (int column = block.column0; column < block.column1; ++column) {
                        const std::size_t k = c * cells + static_cast<std::size_t>(row) * columns +
                                              static_cast<std::size_t>(column);
                        const double slope =
                            slopes[b * channels + c] *
                            (layer.error_share.empty() ? 1.0 : layer.error_share[k]);
                        for (std::size_t p = 0; p < weights.size(); ++p)
                            weights[p][k] = slope * jacobian[p][b * channels + c];
                    }
        }
        const std::vector<double> of_layer = layer.errors->covariances(weights);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += of_layer[k];
    }
    return sum;
}

double chi2_per_dof(const FitData& data, const std::vector<double>& energy, std::size_t params) {
    if (!data.has_errors() || data.blocks.size() <= params)
        return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (std::size_t k = 0; k < energy.size(); ++k) {
        const double variance = variance_of(data.spread[k], data.energy[k], energy[k]);
        const double difference = energy[k] - data.energy[k];
        if (variance > 0) sum += difference * difference / (variance * data.channels);
    }
    return sum / static_cast<double>(data.blocks.size() - params);
}

FitData every_fourth(const FitData& data) {
    FitData few = data;
    few.blocks.clear();
    few.energy.clear();
    few.spread.clear();
    const auto channels = static_cast<std::size_t>(data.channels);
    for (std::size_t b = 0; b < data.blocks.size(); b += 4) {
        few.blocks.push_back(data.blocks[b]);
        for (std::size_t c = 0; c < channels; ++c) {
            few.energy.push_back(data.energy[b * channels + c]);
            if (data.has_errors()) few.spread.push_back(data.spread[b * channels + c]);
        }
    }
    return few;
}

}  // namespace asperity::detail

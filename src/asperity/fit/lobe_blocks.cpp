// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/fit/lobe_blocks.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::detail {
namespace {

constexpr double kLargestBlock = 0.08;       ///< [sr]
constexpr double kLargestShare = 1.0 / 250;  ///< of a layer's energy, in a block of several cells
constexpr double kFewestRays = 120;          ///< E^2 / variance of a block that may be halved
constexpr double kEnoughRays = 1e4;          ///< from here on a spread is known to a percent
constexpr double kLargestPatch = 0.18;       ///< side of a patch of four nodes [rad]
constexpr int kMostPatches = 8;              ///< along a side

/// Sums over rectangles of cells, by a summed-area table a channel.
class CellSums {
  public:
    CellSums(const Detector& detector, std::span<const double> values)
        : columns_(static_cast<std::size_t>(detector.columns())),
          size_(static_cast<std::size_t>(detector.rows() + 1) * (columns_ + 1)) {
        const auto rows = static_cast<std::size_t>(detector.rows());
        const std::size_t channels = values.size() / (rows * columns_);
        table_.assign(channels * size_, 0.0);
        for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t k = 0; k < columns_; ++k)
                    at(c, r + 1, k + 1) = values[(c * rows + r) * columns_ + k] + at(c, r, k + 1) +
                                          at(c, r + 1, k) - at(c, r, k);
    }

    double sum(std::size_t channel, const FitBlock& b) const {
        const auto u = [](int i) { return static_cast<std::size_t>(i); };
        const double sum =
            at(channel, u(b.row1), u(b.column1)) - at(channel, u(b.row0), u(b.column1)) -
            at(channel, u(b.row1), u(b.column0)) + at(channel, u(b.row0), u(b.column0));
        return std::max(0.0, sum);
    }

  private:
    double& at(std::size_t c, std::size_t r, std::size_t k) {
        return table_[c * size_ + r * (columns_ + 1) + k];
    }
    double at(std::size_t c, std::size_t r, std::size_t k) const {
        return table_[c * size_ + r * (columns_ + 1) + k];
    }

    std::size_t columns_, size_;
    std::vector<double> table_;
};

class Cutter {
  public:
    Cutter(FitData& data, const LayerEnergies& values)
        : data_(data),
          channels_(static_cast<std::size_t>(data.channels)),
          energy_(data.detector, values.energy),
          errors_(!values.variance.empty()),
          variance_(data.detector, errors_ ? values.variance : values.energy) {}

    void cut_layer(std::size_t layer, int rows) {
        const FitBlock whole = {layer, 0, rows, 0, data_.detector.columns(), 0, 0, 0};
        total_ = energy_of(whole);
        cut(whole, spreads_of(whole, std::vector<double>(channels_, 0.0)));
    }

  private:
    double energy_of(const FitBlock& b) const {
        double sum = 0;
        for (std::size_t c = 0; c < channels_; ++c) sum += energy_.sum(c, b);
        return sum;
    }

    /// Energy^2 / variance of the channel that has the fewest; infinite without errors.
    double rays_of(const FitBlock& b) const {
        double fewest = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; errors_ && c < channels_; ++c) {
            const double e = energy_.sum(c, b), v = variance_.sum(c, b);
            fewest = std::min(fewest, v > 0 ? e * e / v : (e > 0 ? kEnoughRays : 0));
        }
        return fewest;
    }

    std::vector<double> spreads_of(const FitBlock& b, std::vector<double> spreads) const {
        for (std::size_t c = 0; errors_ && c < channels_; ++c) {
            const double e = energy_.sum(c, b), v = variance_.sum(c, b);
            const bool known = v > 0 && e * e >= kEnoughRays * v;
            if (e > 0 && (known || spreads[c] == 0)) spreads[c] = v / e;
        }
        return spreads;
    }

    double solid_angle(const FitBlock& b) const {
        double sum = 0;
        for (int row = b.row0; row < b.row1; ++row) sum += data_.detector.solid_angle(row);
        return sum * (b.column1 - b.column0);
    }

    double height(const FitBlock& b) const {
        return data_.detector.theta_edge(b.row1) - data_.detector.theta_edge(b.row0);
    }
    double width(const FitBlock& b) const {
        const double middle =
            0.5 * (data_.detector.theta_edge(b.row1) + data_.detector.theta_edge(b.row0));
        return std::sin(middle) *
               (data_.detector.phi_edge(b.column1) - data_.detector.phi_edge(b.column0));
    }

    void cut(FitBlock b, const std::vector<double>& spreads) {
        const int cells = b.cells();
        b.solid_angle = solid_angle(b);
        const bool bright = energy_of(b) > kLargestShare * total_ && rays_of(b) > kFewestRays;
        if (cells == 1 || (b.solid_angle <= kLargestBlock && !bright)) return keep(b, spreads);
        FitBlock first = b, second = b;
        const bool rows =
            b.column1 - b.column0 == 1 || (b.row1 - b.row0 > 1 && height(b) >= width(b));
        if (rows)
            first.row1 = second.row0 = (b.row0 + b.row1) / 2;
        else
            first.column1 = second.column0 = (b.column0 + b.column1) / 2;
        cut(first, spreads_of(first, spreads));
        cut(second, spreads_of(second, spreads));
    }

    void keep(FitBlock& b, const std::vector<double>& spreads) {
        b.first_node = data_.nodes.size();
        const int by_light = static_cast<int>(
            std::ceil(std::sqrt(energy_of(b) / (kLargestShare * std::max(total_, 1e-300)))));
        const auto pieces = [&](double side) {
            return std::clamp(std::max(by_light, static_cast<int>(std::ceil(side / kLargestPatch))),
                              1, kMostPatches);
        };
        add_nodes(b, pieces(height(b)), pieces(width(b)));
        b.nodes = data_.nodes.size() - b.first_node;
        data_.blocks.push_back(b);
        for (std::size_t c = 0; c < channels_; ++c) {
            data_.energy.push_back(energy_.sum(c, b));
            if (errors_) data_.spread.push_back(spreads[c]);
        }
    }

    /// Two by two points of Gauss and Legendre in sin^2(theta) and phi, a patch.
    void add_nodes(const FitBlock& b, int rows, int columns) {
        constexpr std::array kPlaces = {0.21132486540518712, 0.78867513459481288};
        const Detector& d = data_.detector;
        const double t0 = d.theta_edge(b.row0), dt = (d.theta_edge(b.row1) - t0) / rows;
        const double p0 = d.phi_edge(b.column0), dp = (d.phi_edge(b.column1) - p0) / columns;
        for (int r = 0; r < rows; ++r) {
            const double low = std::sin(t0 + r * dt), high = std::sin(t0 + (r + 1) * dt);
            const double s0 = low * low, ds = high * high - s0;
            for (int k = 0; k < columns; ++k)
                for (const double u : kPlaces)
                    for (const double v : kPlaces) {
                        const double s = s0 + u * ds, phi = p0 + (k + v) * dp;
                        const Vec3 wo = {std::sqrt(s) * std::cos(phi), std::sqrt(s) * std::sin(phi),
                                         std::sqrt(1 - s)};
                        data_.nodes.push_back({wo, ds * dp / 8});
                    }
        }
    }

    FitData& data_;
    std::size_t channels_;
    CellSums energy_;
    bool errors_;
    CellSums variance_;
    double total_ = 0;
};

}  // namespace

void append_blocks(FitData& data, const FitLayer& layer, const LayerEnergies& values, int rows) {
    FitLayer added = layer;
    added.first_block = data.blocks.size();
    Cutter(data, values).cut_layer(data.layers.size(), rows);
    added.blocks = data.blocks.size() - added.first_block;
    data.layers.push_back(added);
}

}  // namespace asperity::detail

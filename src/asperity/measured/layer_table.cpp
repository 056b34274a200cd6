// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/measured/layer_table.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr int kPasses = 6;  // leave 0.75^6 = 18 % of what misses most, light and dark cells in turn

/// A number u in [0, 1) as an index into shares that rise to 1, and where it stands within it.
struct Pick {
    std::size_t index;
    double inside;  ///< [0, 1)
};

Pick pick(std::span<const double> shares, double u) {
    const std::size_t last = shares.size() - 1;
    const auto found = std::upper_bound(shares.begin(), shares.end() - 1, u);
    const std::size_t index = std::min(static_cast<std::size_t>(found - shares.begin()), last);
    const double below = index == 0 ? 0.0 : shares[index - 1];
    const double inside = (u - below) / (shares[index] - below);
    return {index, std::clamp(inside, 0.0, std::nextafter(1.0, 0.0))};
}

double share_of(std::span<const double> shares, std::size_t index) {
    return shares[index] - (index == 0 ? 0.0 : shares[index - 1]);
}

/// Turns weights into shares that rise to exactly 1; nothing but zeros into `otherwise`.
void accumulate_shares(std::span<double> weights, std::span<const double> otherwise) {
    double total = 0;
    for (const double w : weights) total += w;
    if (!(total > 0)) {
        std::copy(otherwise.begin(), otherwise.end(), weights.begin());
        total = 0;
        for (const double w : weights) total += w;
    }
    double sum = 0;
    for (double& w : weights) {
        sum += w;
        w = sum / total;
    }
    weights.back() = 1;
}

/// Nodes of a row and what belongs to their cells.
struct NodeRow {
    std::size_t count;
    const double *mean, *found;  ///< measured, and what the interpolation comes to
    const double* doubt;         ///< by how much they may differ
    const double *shape, *nodes;
};

/// Raises nodes by what the means over their cells miss, beyond doubt.
void raise_nodes(const NodeRow& row, double* raised) {
    for (std::size_t k = 0; k < row.count; ++k) {
        const double missing = row.mean[k] - row.found[k];
        const double beyond = std::abs(missing) - row.doubt[k];
        const double certain = std::copysign(beyond > 0 ? beyond : 0, missing);
        const double value = row.nodes[k] + certain / row.shape[k];
        raised[k] = value > 0 ? value : 0;
    }
}

}  // namespace

CellGrid::CellGrid(const Detector& detector) : detector_(detector) {
    for (int row = 0; row < detector.rows(); ++row) {
        const double a = std::sin(detector.theta_edge(row));
        const double b = std::sin(detector.theta_edge(row + 1));
        theta_nodes_.push_back(std::asin(std::sqrt(0.5 * (a * a + b * b))));
    }
}

std::size_t CellGrid::row_below(double theta) const {
    const std::size_t last = theta_nodes_.size() - 1;
    const double share = detector_.kind() == DetectorKind::LatLong
                             ? theta / (0.5 * kPi)
                             : std::sin(theta) * std::sin(theta);
    // The nodes are the authority: the guess may be a row off.
    std::size_t row =
        std::min(static_cast<std::size_t>(share * static_cast<double>(last + 1)), last);
    while (row > 0 && theta < theta_nodes_[row]) --row;
    while (row < last && theta >= theta_nodes_[row + 1]) ++row;
    return row;
}

CellBlend CellGrid::blend(Vec3 wo) const {
    const std::size_t rows = static_cast<std::size_t>(detector_.rows());
    const std::size_t columns = static_cast<std::size_t>(detector_.columns());

    // The two columns round the azimuth.
    const double x = azimuth(wo) * static_cast<double>(columns) / (2 * kPi) + 0.5;
    const std::size_t right = static_cast<std::size_t>(x);
    const double t = x - static_cast<double>(right);
    const std::size_t column1 = right < columns ? right : right - columns;
    const std::size_t column0 = column1 == 0 ? columns - 1 : column1 - 1;

    // The two rows round the polar angle.
    const double theta = std::min(polar_angle(wo), 0.5 * kPi);
    if (theta < theta_nodes_[0]) {
        const double s = theta / theta_nodes_[0];
        const std::size_t pole = rows * columns;
        return {{pole, pole, column0, column1}, {1 - s, 0, s * (1 - t), s * t}};
    }
    const std::size_t row = row_below(theta);
    const std::size_t cell0 = row * columns + column0, cell1 = row * columns + column1;
    if (row + 1 == rows) return {{cell0, cell1, cell0, cell1}, {1 - t, t, 0, 0}};
    const double s = (theta - theta_nodes_[row]) / (theta_nodes_[row + 1] - theta_nodes_[row]);
    return {{cell0, cell1, cell0 + columns, cell1 + columns},
            {(1 - s) * (1 - t), (1 - s) * t, s * (1 - t), s * t}};
}

LayerTable::LayerTable(std::shared_ptr<const CellGrid> grid, const Measurement& measurement,
                       const Layer& layer, const LobeShape& shape)
    : grid_(std::move(grid)), channels_(static_cast<std::size_t>(measurement.channels())) {
    const Detector& detector = grid_->detector();
    const std::size_t rows = static_cast<std::size_t>(detector.rows());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cells = rows * columns;
    const CellWeights weights(detector, shape, layer.phi_i);
    f_.resize((cells + 1) * channels_);
    std::vector<double> all_channels(cells, 0.0), shapes(cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
        shapes[cell] = weights.mean_of_shape(cell / columns, cell % columns);
    for (std::size_t channel = 0; channel < channels_; ++channel) {
        const int c = static_cast<int>(channel);
        const std::vector<double> nodes = nodes_of(measurement, layer, c, weights, shapes);
        double pole = 0;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            f_[cell * channels_ + channel] = static_cast<float>(nodes[cell]);
            all_channels[cell] += nodes[cell];
            // At the pole all columns meet: their mean.
            if (cell < columns) pole += nodes[cell] / static_cast<double>(columns);
        }
        f_[cells * channels_ + channel] = static_cast<float>(pole);
        albedo_.push_back(measurement.albedo(layer, c));
    }
    build_distribution(weights, all_channels);
}

std::vector<double> LayerTable::nodes_of(const Measurement& measurement, const Layer& layer,
                                         int channel, const CellWeights& weights,
                                         const std::vector<double>& shapes) const {
    const Detector& detector = grid_->detector();
    const std::size_t rows = static_cast<std::size_t>(detector.rows());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cells = rows * columns;
    std::vector<double> nodes(cells), mean(cells), doubt(cells, 0.0);
    const std::vector<double> energies = measurement.energies(layer, channel);
    const float* const errors =
        layer.stderr_energy.empty()
            ? nullptr
            : layer.stderr_energy.data() + static_cast<std::size_t>(channel) * cells;
    for (std::size_t k = 0; k < cells; ++k) {
        const double size = detector.projected_solid_angle(static_cast<int>(k / columns));
        mean[k] = energies[k] / size;
        if (errors != nullptr) doubt[k] = 2 * (double{errors[k]} / size);
        nodes[k] = mean[k] / shapes[k];
    }
    std::vector<double> raised(cells), here(columns);
    for (int pass = 0; pass < kPasses; ++pass) {
        for (std::size_t row = 0; row < rows; ++row) {
            weights.means(nodes, row, here);
            raise_nodes(
                {columns, mean.data() + row * columns, here.data(), doubt.data() + row * columns,
                 shapes.data() + row * columns, nodes.data() + row * columns},
                raised.data() + row * columns);
        }
        nodes.swap(raised);
    }
    return nodes;
}

void LayerTable::build_distribution(const CellWeights& weights, const std::vector<double>& f) {
    const Detector& detector = grid_->detector();
    const std::size_t rows = static_cast<std::size_t>(detector.rows());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    // Where no light left, spread the samples as from a diffuse surface.
    const std::vector<double> even(columns, 1.0);
    std::vector<double> diffuse, means(columns);
    cells_.resize(rows * columns);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::span<double> part = std::span(cells_).subspan(row * columns, columns);
        const double size = detector.projected_solid_angle(static_cast<int>(row));
        double total = 0;
        weights.means(f, row, means);
        for (std::size_t column = 0; column < columns; ++column) {
            part[column] = means[column] * size;
            total += part[column];
        }
        rows_.push_back(total);
        diffuse.push_back(size);
        accumulate_shares(part, even);
    }
    accumulate_shares(rows_, diffuse);
}

void LayerTable::eval(Vec3 wo, std::span<double> f) const {
    const CellBlend blend = grid_->blend(wo);
    for (std::size_t channel = 0; channel < channels_; ++channel) {
        double sum = 0;
        for (std::size_t k = 0; k < blend.cell.size(); ++k)
            sum += blend.weight[k] * static_cast<double>(f_[blend.cell[k] * channels_ + channel]);
        f[channel] = sum;
    }
}

Vec3 LayerTable::sample(double u1, double u2) const {
    const Detector& detector = grid_->detector();
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const Pick row = pick(rows_, u1);
    const Pick column = pick(std::span(cells_).subspan(row.index * columns, columns), u2);

    const int r = static_cast<int>(row.index);
    const double a = std::sin(detector.theta_edge(r)), b = std::sin(detector.theta_edge(r + 1));
    const double sin2 = a * a + row.inside * (b * b - a * a);
    const double phi = 2 * kPi * (static_cast<double>(column.index) + column.inside) /
                       static_cast<double>(columns);
    return {std::sqrt(sin2) * std::cos(phi), std::sqrt(sin2) * std::sin(phi),
            std::sqrt(1 - std::min(1.0, sin2))};
}

double LayerTable::pdf(Vec3 wo) const {
    if (wo.z <= 0) return 0;
    const Detector& detector = grid_->detector();
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cell = static_cast<std::size_t>(detector.cell_of(wo));
    const std::size_t row = cell / columns;
    const double share =
        share_of(rows_, row) *
        share_of(std::span(cells_).subspan(row * columns, columns), cell % columns);
    return share * wo.z / detector.projected_solid_angle(static_cast<int>(row));
}

}  // namespace asperity

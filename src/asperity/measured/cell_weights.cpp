// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/measured/cell_weights.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {
namespace {

/// The weights of three nodes a cell apart at a place between the middle one's neighbours, -0.5 to
/// 0.5 cells from it.
std::array<double, 3> hats(double place) {
    return {std::max(0.0, -place), 1 - std::abs(place), std::max(0.0, place)};
}

/// What a shape is worth at some places of a cell: its least and its largest value, and the mean.
struct Looked {
    double least = std::numeric_limits<double>::infinity(), most = 0, mean = 0;
};

/// Sets the weights of nine nodes from the shape at `along` x `across` places of a cell, in its
/// polar angle and its azimuth.
Looked look(const Detector& detector, std::size_t row, std::size_t column, int along, int across,
            const LobeShape& shape, std::array<float, 9>& weights) {
    const double a = std::sin(detector.theta_edge(static_cast<int>(row)));
    const double b = std::sin(detector.theta_edge(static_cast<int>(row) + 1));
    const double turn = 2 * kPi / detector.columns();
    const double count = along * across;
    std::array<double, 9> sums{};
    Looked looked;
    for (int i = 0; i < along; ++i) {
        const double u = (i + 0.5) / along, sin2 = a * a + u * (b * b - a * a);
        const std::array<double, 3> up = hats(u - 0.5);
        for (int j = 0; j < across; ++j) {
            const double v = (j + 0.5) / across, phi = turn * (static_cast<double>(column) + v);
            const double sine = std::sqrt(sin2);
            const double value = shape(Vec3{sine * std::cos(phi), sine * std::sin(phi),
                                            std::sqrt(std::max(0.0, 1 - sin2))});
            looked.least = std::min(looked.least, value);
            looked.most = std::max(looked.most, value);
            looked.mean += value / count;
            const std::array<double, 3> round = hats(v - 0.5);
            for (std::size_t k = 0; k < 9; ++k) sums[k] += value * up[k / 3] * round[k % 3];
        }
    }
    for (std::size_t k = 0; k < 9; ++k) weights[k] = static_cast<float>(sums[k] / count);
    return looked;
}

/// Whether the plane of incidence of light from azimuth phi_i passes through a column, or the one
/// beside it, on the side of the mirror direction.
bool near_plane(const Detector& detector, std::size_t column, double phi_i) {
    const double turn = 2 * kPi / detector.columns();
    const double off = turn * (static_cast<double>(column) + 0.5) - phi_i - kPi;
    return std::abs(std::remainder(off, 2 * kPi)) <= 1.5 * turn;
}

}  // namespace

CellWeights::CellWeights(const Detector& detector)
    : rows_(static_cast<std::size_t>(detector.rows())),
      columns_(static_cast<std::size_t>(detector.columns())) {
    // Of a linear interpolation over the cell of its middle node, both ways
    constexpr std::array kLinear = {0.125f, 0.75f, 0.125f};
    Nine all{};
    for (std::size_t k = 0; k < 9; ++k) all[k] = kLinear[k / 3] * kLinear[k % 3];
    weights_ = {all};
}

CellWeights::CellWeights(const Detector& detector, const LobeShape& shape, double phi_i)
    : CellWeights(detector) {
    if (!shape) return;
    constexpr double kEven = 1.15;     // a shape that varies less needs no closer look
    constexpr double kSettled = 0.01;  // a mean that changes less is known
    constexpr int kFew = 2, kMany = 6, kMost = 6 * 4 * 4 * 4;
    weights_.resize(rows_ * columns_);
    for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) {
            Nine& nine = weights_[row * columns_ + column];
            Looked last = look(detector, row, column, kFew, kFew, shape, nine);
            // At grazing incidence the ridge of a lobe passes between any few places
            const bool ridge = near_plane(detector, column, phi_i);
            if (last.most <= kEven * last.least && !ridge) continue;
            last = look(detector, row, column, kMany, kMany, shape, nine);
            for (int across = 4 * kMany; ridge && across <= kMost; across *= 4) {
                const Looked closer = look(detector, row, column, kMany, across, shape, nine);
                const bool settled = std::abs(closer.mean - last.mean) <= kSettled * closer.mean;
                last = closer;
                if (settled) break;
            }
        }
    }
}

void CellWeights::means(const std::vector<double>& nodes, std::size_t row,
                        std::span<double> means) const {
    // The first and the last row are their own neighbours, columns run round.
    const std::array<const double*, 3> rows = {
        nodes.data() + (row == 0 ? row : row - 1) * columns_, nodes.data() + row * columns_,
        nodes.data() + (row + 1 == rows_ ? row : row + 1) * columns_};
    const auto sum_at = [&](const Nine& nine, std::size_t left, std::size_t column,
                            std::size_t right) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += static_cast<double>(nine[3 * k]) * rows[k][left];
            sum += static_cast<double>(nine[3 * k + 1]) * rows[k][column];
            sum += static_cast<double>(nine[3 * k + 2]) * rows[k][right];
        }
        return sum;
    };
    const std::size_t last = columns_ - 1;
    means[0] = sum_at(of(row, 0), last, 0, columns_ > 1 ? 1 : 0);
    if (last > 0) means[last] = sum_at(of(row, last), last - 1, last, 0);
    const Nine alike = weights_[0];
    if (weights_.size() == 1) {
        for (std::size_t c = 1; c < last; ++c) means[c] = sum_at(alike, c - 1, c, c + 1);
    } else {
        for (std::size_t c = 1; c < last; ++c) means[c] = sum_at(of(row, c), c - 1, c, c + 1);
    }
}

double CellWeights::mean_of_shape(std::size_t row, std::size_t column) const {
    double sum = 0;
    for (const float weight : of(row, column)) sum += static_cast<double>(weight);
    return sum;
}

}  // namespace asperity

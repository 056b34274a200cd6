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

/// Adds what the shape is worth at n x n places of a cell to the weights of nine nodes; returns
/// its least and its largest value.
template <typename Shape>
std::array<double, 2> add_places(const Detector& detector, std::size_t row, std::size_t column,
                                 int n, const Shape& shape, std::array<float, 9>& weights) {
    const double a = std::sin(detector.theta_edge(static_cast<int>(row)));
    const double b = std::sin(detector.theta_edge(static_cast<int>(row) + 1));
    const double turn = 2 * kPi / detector.columns();
    std::array<double, 9> sums{};
    std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < n; ++i) {
        const double u = (i + 0.5) / n, sin2 = a * a + u * (b * b - a * a);
        const std::array<double, 3> along = hats(u - 0.5);
        for (int j = 0; j < n; ++j) {
            const double v = (j + 0.5) / n, phi = turn * (static_cast<double>(column) + v);
            const double sine = std::sqrt(sin2);
            const double value = shape(Vec3{sine * std::cos(phi), sine * std::sin(phi),
                                            std::sqrt(std::max(0.0, 1 - sin2))});
            range = {std::min(range[0], value), std::max(range[1], value)};
            const std::array<double, 3> across = hats(v - 0.5);
            for (std::size_t k = 0; k < 9; ++k) sums[k] += value * along[k / 3] * across[k % 3];
        }
    }
    for (std::size_t k = 0; k < 9; ++k) weights[k] = static_cast<float>(sums[k] / (n * n));
    return range;
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

CellWeights::CellWeights(const Detector& detector, const LobeShape& shape) : CellWeights(detector) {
    if (!shape) return;
    constexpr double kEven = 1.15;  // a shape that varies less needs no closer look
    constexpr int kFew = 2, kMany = 6;
    weights_.resize(rows_ * columns_);
    for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) {
            Nine& nine = weights_[row * columns_ + column];
            const auto [least, most] = add_places(detector, row, column, kFew, shape, nine);
            if (most > kEven * least) add_places(detector, row, column, kMany, shape, nine);
        }
    }
}

double CellWeights::mean(const std::vector<double>& nodes, std::size_t row,
                         std::size_t column) const {
    // The first and the last row are their own neighbours, columns run round.
    const std::array<std::size_t, 3> rows = {row == 0 ? row : row - 1, row,
                                             row + 1 == rows_ ? row : row + 1};
    const std::array<std::size_t, 3> columns = {(column + columns_ - 1) % columns_, column,
                                                (column + 1) % columns_};
    const Nine& nine = of(row, column);
    double sum = 0;
    for (std::size_t k = 0; k < 9; ++k)
        sum += static_cast<double>(nine[k]) * nodes[rows[k / 3] * columns_ + columns[k % 3]];
    return sum;
}

double CellWeights::mean_of_shape(std::size_t row, std::size_t column) const {
    double sum = 0;
    for (const float weight : of(row, column)) sum += static_cast<double>(weight);
    return sum;
}

}  // namespace asperity

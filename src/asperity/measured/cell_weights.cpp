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

/// Azimuths in the columns of a detector, `across` of each.
struct Azimuths {
    std::vector<double> cosine, sine;

    Azimuths(const Detector& detector, int across, std::size_t first, std::size_t columns) {
        const double turn = 2 * kPi / detector.columns();
        for (std::size_t column = first; column < first + columns; ++column) {
            for (int j = 0; j < across; ++j) {
                const double v = (j + 0.5) / across;
                const double phi = turn * (static_cast<double>(column) + v);
                cosine.push_back(std::cos(phi));
                sine.push_back(std::sin(phi));
            }
        }
    }
};

/// Sets the weights of nine nodes from the shape at `along` x `across` places of a cell, in its
/// polar angle and its azimuth; `cosine` and `sine` are of the azimuths.
Looked look(const Detector& detector, std::size_t row, const double* cosine, const double* sine,
            int along, int across, const LobeShape& shape, std::array<float, 9>& weights) {
    const double a = std::sin(detector.theta_edge(static_cast<int>(row)));
    const double b = std::sin(detector.theta_edge(static_cast<int>(row) + 1));
    const double count = along * across;
    std::array<double, 9> sums{};
    Looked looked;
    for (int i = 0; i < along; ++i) {
        const double u = (i + 0.5) / along, sin2 = a * a + u * (b * b - a * a);
        const std::array<double, 3> up = hats(u - 0.5);
        const double r = std::sqrt(sin2), z = std::sqrt(std::max(0.0, 1 - sin2));
        for (int j = 0; j < across; ++j) {
            const double v = (j + 0.5) / across;
            const double value = shape(Vec3{r * cosine[j], r * sine[j], z});
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
    for (std::size_t k = 0; k < 9; ++k) alike_[k] = kLinear[k / 3] * kLinear[k % 3];
}

CellWeights::CellWeights(const Detector& detector, const LobeShape& shape, double phi_i)
    : CellWeights(detector) {
    if (!shape) return;
    constexpr double kEven = 1.15;     // a shape that varies less needs no closer look
    constexpr double kSettled = 0.01;  // a mean that changes less is known
    constexpr int kFew = 2, kMany = 6, kMost = 6 * 4 * 4 * 4;
    const Azimuths few(detector, kFew, 0, columns_), many(detector, kMany, 0, columns_);
    weights_.resize(9 * rows_ * columns_);
    for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) {
            Nine nine;
            const auto look_at = [&](const Azimuths& azimuths, std::size_t first, int along,
                                     int across) {
                return look(detector, row, azimuths.cosine.data() + first,
                            azimuths.sine.data() + first, along, across, shape, nine);
            };
            Looked last = look_at(few, column * kFew, kFew, kFew);
            // At grazing incidence the ridge of a lobe passes between any few places
            const bool ridge = near_plane(detector, column, phi_i);
            if (last.most > kEven * last.least || ridge)
                last = look_at(many, column * kMany, kMany, kMany);
            for (int across = 4 * kMany; ridge && across <= kMost; across *= 4) {
                const Looked closer =
                    look_at(Azimuths(detector, across, column, 1), 0, kMany, across);
                const bool settled = std::abs(closer.mean - last.mean) <= kSettled * closer.mean;
                last = closer;
                if (settled) break;
            }
            set(row, column, nine);
        }
    }
}

CellWeights::Nine CellWeights::of(std::size_t row, std::size_t column) const {
    if (weights_.empty()) return alike_;
    Nine nine;
    for (std::size_t k = 0; k < 9; ++k) nine[k] = weights_[(row * 9 + k) * columns_ + column];
    return nine;
}

void CellWeights::set(std::size_t row, std::size_t column, const Nine& weights) {
    for (std::size_t k = 0; k < 9; ++k) weights_[(row * 9 + k) * columns_ + column] = weights[k];
}

void CellWeights::means(const std::vector<double>& nodes, std::size_t row,
                        std::span<double> means) const {
    // The first and the last row are their own neighbours, columns run round.
    const std::array<const double*, 3> rows = {
        nodes.data() + (row == 0 ? row : row - 1) * columns_, nodes.data() + row * columns_,
        nodes.data() + (row + 1 == rows_ ? row : row + 1) * columns_};
    const auto sum_at = [&](std::size_t left, std::size_t column, std::size_t right) {
        const Nine nine = of(row, column);
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += static_cast<double>(nine[3 * k]) * rows[k][left];
            sum += static_cast<double>(nine[3 * k + 1]) * rows[k][column];
            sum += static_cast<double>(nine[3 * k + 2]) * rows[k][right];
        }
        return sum;
    };
    const std::size_t last = columns_ - 1;
    means[0] = sum_at(last, 0, columns_ > 1 ? 1 : 0);
    if (last > 0) means[last] = sum_at(last - 1, last, 0);
    double* const mean = means.data();
    // Of all columns between, weight(k, column) being of the k-th of the nine
    const auto sum_up = [&](const auto& weight) {
        const double *const a = rows[0], *const b = rows[1], *const c = rows[2];
        for (std::size_t n = 1; n < last; ++n) {
            double sum = weight(0, n) * a[n - 1];
            sum += weight(1, n) * a[n];
            sum += weight(2, n) * a[n + 1];
            sum += weight(3, n) * b[n - 1];
            sum += weight(4, n) * b[n];
            sum += weight(5, n) * b[n + 1];
            sum += weight(6, n) * c[n - 1];
            sum += weight(7, n) * c[n];
            sum += weight(8, n) * c[n + 1];
            mean[n] = sum;
        }
    };
    if (weights_.empty()) {
        const Nine nine = alike_;
        sum_up([&nine](std::size_t k, std::size_t) { return static_cast<double>(nine[k]); });
    } else {
        const float* const first = weights_.data() + row * 9 * columns_;
        sum_up([first, columns = columns_](std::size_t k, std::size_t n) {
            return static_cast<double>(first[k * columns + n]);
        });
    }
}

double CellWeights::mean_of_shape(std::size_t row, std::size_t column) const {
    double sum = 0;
    for (const float weight : of(row, column)) sum += static_cast<double>(weight);
    return sum;
}

}  // namespace asperity

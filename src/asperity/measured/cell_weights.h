// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/detector/detector.h>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace asperity {

/// How a layer's lobe is shaped at the direction wo, within and across its cells.
using LobeShape = std::function<double(Vec3 wo)>;

/// The mean over each cell of an interpolation between nodes, times a shape.
class CellWeights {
  public:
    /// Of the shape 1.
    explicit CellWeights(const Detector& detector);
    /// Of light from azimuth phi_i [rad], in whose plane of incidence a lobe may be a hundred times
    /// narrower than a cell: there columns are looked at until their means settle.
    CellWeights(const Detector& detector, const LobeShape& shape, double phi_i);

    /// Over the cells of a row, of all nodes, row by row.
    void means(const std::vector<double>& nodes, std::size_t row, std::span<double> means) const;
    /// Of the shape alone.
    double mean_of_shape(std::size_t row, std::size_t column) const;

  private:
    using Nine = std::array<float, 9>;  ///< of the node and its neighbours, row by row
    Nine of(std::size_t row, std::size_t column) const;
    void set(std::size_t row, std::size_t column, const Nine& weights);

    std::size_t rows_, columns_;
    Nine alike_{};                ///< of all cells, where `weights_` is empty
    std::vector<float> weights_;  ///< [(row * 9 + k) * columns + column]
};

}  // namespace asperity

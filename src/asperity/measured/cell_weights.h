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
    const Nine& of(std::size_t row, std::size_t column) const {
        return weights_.size() == 1 ? weights_[0] : weights_[row * columns_ + column];
    }

    std::size_t rows_, columns_;
    std::vector<Nine> weights_;  ///< of each cell, or of all alike
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Averages over whole rows of cells; inside this folder only.

#include <asperity/measured/patch_integrator.h>

#include <cstddef>
#include <span>
#include <vector>

namespace asperity::detail {

/// What a CellIntegrator gives for the cells of a row, side by side: directions at one polar angle
/// are asked for at once, and azimuths are those of all rows.
class RowIntegrator {
  public:
    /// Of the cells in `columns`; holds a reference to `cells`.
    RowIntegrator(const CellIntegrator& cells, const Detector& detector,
                  std::span<const int> columns);

    /// energy[k * channels + c] of columns[k].
    void integrate(int row, std::span<double> energy) const;

  private:
    /// Azimuths of one turn: of the middle, and of the two points of the second rule.
    struct Azimuths {
        std::vector<double> from, to;      ///< edges of the columns
        std::vector<double> cosine, sine;  ///< [rule point * columns + k]
    };

    void integrate_turn(std::size_t turn, double s0, double s1, std::span<double> energy) const;

    const CellIntegrator& cells_;
    const Detector& detector_;
    std::size_t channels_, columns_;
    std::vector<Azimuths> azimuths_;  ///< of the turns
};

}  // namespace asperity::detail

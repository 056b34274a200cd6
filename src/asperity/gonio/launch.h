// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/random.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/tracer.h>

#include <algorithm>
#include <cstdint>

namespace asperity {

/// One direction the light comes from.
struct Incidence {
    int number = 0;          ///< Layer::number
    double theta = 0;        ///< polar angle [rad]
    double phi = 0;          ///< azimuth the light comes from [rad]
    bool isotropic = false;  ///< every ray has an azimuth of its own instead
};

/// Incidences of an experiment in the order they are measured: from normal incidence down.
std::vector<Incidence> incidences(const IlluminationSettings& settings);

/// A ray at the start of its path and the azimuth its light came from.
struct Launch {
    Ray ray;
    double phi_i = 0;
};

/// Neighbouring launch points of a lattice: the same place (u, v) of the cells (i, j), (i + 1, j)
/// ... of a row, which goes on at its other end.
struct LaunchRow {
    std::int32_t i = 0, j = 0;
    double u = 0, v = 0;
    std::uint64_t count = 0;  ///< of points
};

/// Launch points of one batch: spread over the tile at the height of the highest point, which is
/// uniform in flux. Every pattern gives each point of the tile the same density, so the estimate is
/// free of bias; batches are independent of each other, so their spread shows its error.
///
/// The lattice of LowDiscrepancy consists of rows of points one cell apart, so that the rays of a
/// row cross the grid in step; rows are shifted against each other by the golden ratio of a cell.
class LaunchBatch {
  public:
    /// `index` and `rays` of this batch; `stream` separates the layers of a run. Throws nothing.
    LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                LaunchPattern pattern, std::uint64_t rays, std::uint64_t seed, std::uint32_t stream,
                std::uint32_t index);

    std::uint64_t rays() const { return rays_; }
    /// The k-th ray, k < rays(); neighbours in k start near each other, which the caches like.
    Launch launch(std::uint64_t k) const;
    /// Whether parallel rays start in rows.
    bool in_rows() const {
        return pattern_ == LaunchPattern::LowDiscrepancy && !incidence_.isotropic;
    }
    /// What is left from ray k on of the row it belongs to; LowDiscrepancy only.
    LaunchRow row(std::uint64_t k) const;
    /// The first ray beyond `count` rows, that of ray k being the first; at most rays().
    std::uint64_t end_of_rows(std::uint64_t k, std::uint64_t count) const {
        return row_begin(std::min(k * rows_ / rays_ + count, rows_));
    }
    const Incidence& incidence() const { return incidence_; }

  private:
    /// A point of the tile in units of 2^-64 of its sides.
    struct Point {
        std::uint64_t x = 0, y = 0;
    };
    /// The first ray of a row; rows are as long as each other but for one.
    std::uint64_t row_begin(std::uint64_t row) const { return (row * rays_ + rows_ - 1) / rows_; }
    Point stratified_point(std::uint64_t k) const;
    Point random_point(std::uint64_t k) const;

    Incidence incidence_;
    LaunchPattern pattern_;
    CounterRandom random_;
    std::uint64_t rays_, first_;
    std::uint64_t rows_;  ///< of points
    Point shift_;         ///< of the lattice
    std::uint32_t first_cell_ = 0;
    std::uint32_t cells_x_, cells_y_;
    double height_;
};

}  // namespace asperity

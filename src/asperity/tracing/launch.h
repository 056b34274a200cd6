// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/random.h>
#include <asperity/detector/illumination.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/ray.h>

#include <array>
#include <cstdint>

namespace asperity {

/// One batch of rays, independent of all others of its layer.
struct BatchRequest {
    LaunchPattern pattern = LaunchPattern::LowDiscrepancy;
    std::uint64_t rays = 0;
    std::uint64_t seed = 1;
    std::uint32_t stream = 0;  ///< tells the layers of a run apart
    std::uint32_t index = 0;   ///< of the batch in its layer
};

/// The random numbers of a batch: of its rays, and those that all of them share.
class BatchRandom {
  public:
    explicit BatchRandom(const BatchRequest& batch)
        : random_(batch.seed, batch.stream), first_(std::uint64_t{batch.index} << kBatchShift) {}

    /// Of a lattice; a batch may be made of several, the sweeps of light from all around.
    std::array<std::uint64_t, 2> shift(std::uint64_t sweep = 0) const {
        return random_.bits64(first_ + sweep, kShift);
    }
    std::array<std::uint64_t, 2> first_cell(std::uint64_t sweep = 0) const {
        return random_.bits64(first_ + sweep, kFirstCell);
    }
    std::array<std::uint64_t, 2> bits(std::uint64_t ray) const {
        return random_.bits64(first_ + ray, kPosition);
    }
    std::array<double, 2> position(std::uint64_t ray) const {
        return random_.uniform2(first_ + ray, kPosition);
    }
    double azimuth(std::uint64_t ray) const { return random_.uniform2(first_ + ray, kAzimuth)[0]; }

  private:
    /// What a random number is for: the fourth word of the counter.
    enum Dimension : std::uint32_t { kPosition, kAzimuth, kShift, kFirstCell };
    /// Batches are told apart in the upper bits of the counter's index; a batch has fewer rays.
    static constexpr int kBatchShift = 40;

    CounterRandom random_;
    std::uint64_t first_;
};

/// A coordinate on a torus, in units of 2^-64 of its length, and as a number in [0, 1).
struct TorusPoint {
    std::uint64_t x = 0, y = 0;
};
double to_unit(std::uint64_t fixed);
/// (sqrt(5) - 1) / 2 in these units.
inline constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15u;

/// Where a batch has fewer rays than one for so many cells, it leaves parts of the tile out: what
/// rays see of the surface is then still in the cache when the next ones come.
inline constexpr std::uint64_t kMostCellsPerRay = 4;

/// A ray at the start of its path and the azimuth its light came from.
struct Launch {
    Ray ray;
    double phi_i = 0, cos_phi_i = 1, sin_phi_i = 0;
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
/// The points of LowDiscrepancy form a lattice of rows of points a cell apart, which are shifted
/// against each other by the golden ratio of that distance. An engine may take another lattice as
/// even as that one.
class LaunchBatch {
  public:
    /// `height`: of the highest point. Throws nothing.
    LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                const BatchRequest& request);

    std::uint64_t rays() const { return rays_; }
    const Incidence& incidence() const { return incidence_; }

    /// The k-th ray, k < rays(); neighbours in k start near each other, which the caches like.
    Launch launch(std::uint64_t k) const;
    /// LowDiscrepancy: the r-th row, r < rows().
    LaunchRow row(std::uint64_t r) const;
    std::uint64_t rows() const { return rows_; }

  private:
    /// The first ray of a row; rows are as long as each other but for one.
    std::uint64_t row_begin(std::uint64_t row) const { return (row * rays_ + rows_ - 1) / rows_; }
    TorusPoint stratified_point(std::uint64_t k) const;
    TorusPoint random_point(std::uint64_t k) const;

    Incidence incidence_;
    LaunchPattern pattern_;
    BatchRandom random_;
    std::uint64_t rays_;
    std::uint64_t rows_ = 0;  ///< of points
    TorusPoint shift_;        ///< of the lattice
    std::uint32_t first_cell_ = 0;
    std::uint32_t cells_x_, cells_y_;
    double height_;
    double sin_theta_, cos_theta_, sin_phi_, cos_phi_;  ///< of the incidence
};

}  // namespace asperity

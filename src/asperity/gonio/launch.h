// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/random.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/tracer.h>

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

/// Launch points of one batch: spread over the tile at the height of the highest point, which is
/// uniform in flux. Every pattern gives each point of the tile the same density, so the estimate is
/// free of bias; batches are independent of each other, so their spread shows its error.
class LaunchBatch {
  public:
    /// `index` and `rays` of this batch; `stream` separates the layers of a run. Throws nothing.
    LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                LaunchPattern pattern, std::uint64_t rays, std::uint64_t seed, std::uint32_t stream,
                std::uint32_t index);

    std::uint64_t rays() const { return rays_; }
    /// The k-th ray, k < rays(); neighbours in k start near each other, which the caches like.
    Launch launch(std::uint64_t k) const;

  private:
    /// A point of the tile in units of 2^-64 of its sides.
    struct Point {
        std::uint64_t x = 0, y = 0;
    };
    Point lattice_point(std::uint64_t k) const;
    Point stratified_point(std::uint64_t k) const;
    Point random_point(std::uint64_t k) const;

    Incidence incidence_;
    LaunchPattern pattern_;
    CounterRandom random_;
    std::uint64_t rays_, first_;
    std::uint64_t rows_;  ///< of points, so that their spacing is alike in x and y
    Point step_, shift_;  ///< of the lattice
    std::uint32_t cells_x_, cells_y_;
    double height_;
};

}  // namespace asperity

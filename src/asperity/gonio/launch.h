// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/random.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>
#include <asperity/tracing/engines/plain/tracer.h>
#include <asperity/tracing/engines/wide/wide_launch.h>

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
/// The points of LowDiscrepancy form a lattice. Where parallel light comes in at an angle onto a
/// periodic surface, it consists of lines along the light, a cell beside each other: rays of a line
/// share their way (tracing/engines/wide/launch_line.h). Else it consists of rows of points a cell
/// apart. Lines, or rows, are shifted against each other by the golden ratio of the distance of
/// their points.
class LaunchBatch {
  public:
    /// `index` and `rays` of this batch; `stream` separates the layers of a run. Throws nothing.
    LaunchBatch(const Heightfield& surface, double height, const Incidence& incidence,
                LaunchPattern pattern, std::uint64_t rays, std::uint64_t seed, std::uint32_t stream,
                std::uint32_t index);

    std::uint64_t rays() const { return rays_; }
    const Incidence& incidence() const { return incidence_; }
    /// How rays start: one by one, or so that they can be followed together.
    enum class Order { Single, Rows, Lines };
    Order order() const { return order_; }

    /// Single, Rows: the k-th ray, k < rays(); neighbours in k start near each other, which the
    /// caches like.
    Launch launch(std::uint64_t k) const;
    /// Rows: the r-th row, r < rows().
    LaunchRow row(std::uint64_t r) const;
    std::uint64_t rows() const { return rows_; }
    /// Lines: the s-th stripe of them, s < stripes(), in the frame of a WideTracer, whether that is
    /// mirrored or not. They go over the tile in passes. Few rays leave parts of it out, elsewhere
    /// in each batch.
    LaunchStripe stripe(std::uint64_t s) const;
    std::uint64_t stripes() const { return passes_ * stripes_of_pass_; }
    /// Where the lines of a stripe start in their cells, as WideTracer::start wants it: the same
    /// place in all stripes of a pass.
    double offset(std::uint64_t s) const;
    /// Whether stripe s is the first one of a pass.
    bool begins_pass(std::uint64_t s) const { return s % stripes_of_pass_ == 0; }

  private:
    /// A point of the tile in units of 2^-64 of its sides.
    struct Point {
        std::uint64_t x = 0, y = 0;
    };
    /// The first ray of a row; rows are as long as each other but for one.
    std::uint64_t row_begin(std::uint64_t row) const { return (row * rays_ + rows_ - 1) / rows_; }
    void lay_out_lines(const Heightfield& surface);
    /// Rays of the lines before this one.
    std::uint64_t line_begin(std::uint64_t line) const;
    Point stratified_point(std::uint64_t k) const;
    Point random_point(std::uint64_t k) const;

    Incidence incidence_;
    LaunchPattern pattern_;
    CounterRandom random_;
    std::uint64_t rays_, first_;
    Order order_ = Order::Single;
    std::uint64_t rows_ = 0;  ///< of points
    Point shift_;             ///< of the lattice
    std::uint32_t first_cell_ = 0;
    std::uint32_t cells_x_, cells_y_;
    double height_;
    double sin_theta_, cos_theta_, sin_phi_, cos_phi_;  ///< of the incidence
    // Of lines
    std::uint64_t passes_ = 0, stripes_of_pass_ = 0, lines_of_pass_ = 0;
    /// Of a ray, in units of 2^-64, that the lines before the first one have left over.
    std::uint64_t first_share_ = 0;
    std::uint32_t cells_across_ = 0;
    double fall_ = 0;  ///< height by which light sinks along a line
};

}  // namespace asperity

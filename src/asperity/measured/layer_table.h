// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/measured/cell_weights.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace asperity {

/// Where a direction lies between the centres of a detector's cells: up to four cells and their
/// weights, which sum to 1. Cell Detector::cells() stands for the pole.
struct CellBlend {
    std::array<std::size_t, 4> cell{};
    std::array<double, 4> weight{};
};

/// The cells of a detector as the nodes of an interpolation.
///
/// A cell's BRDF is its cosine-weighted mean, so its node stands in the middle of its sin^2(theta),
/// where a linear function has its mean. Between nodes: linear in theta and phi, phi running round.
/// The pole is a node of its own; from the last row's node to the horizon nothing changes, so a
/// lobe does not darken there.
class CellGrid {
  public:
    explicit CellGrid(const Detector& detector);

    const Detector& detector() const { return detector_; }
    /// `wo` may lie below the horizon: it is taken to be on it.
    CellBlend blend(Vec3 wo) const;

  private:
    /// The last row whose node is not beyond `theta`; the first node is not.
    std::size_t row_below(double theta) const;

    Detector detector_;
    std::vector<double> theta_nodes_;  ///< of the rows
};

/// The BRDF of one layer of a measurement over a shape that is known beforehand (1, without): the
/// quotient is interpolated, and sampled by its energy.
///
/// The nodes are not the measured means themselves: a linear interpolation between those would
/// flatten every peak. They are raised where the surface is curved, so that the mean of the
/// interpolation, times the shape, over a cell comes back to what was measured; only as far as the
/// curvature stands out of the error bars, so noise is not raised.
class LayerTable {
  public:
    LayerTable(std::shared_ptr<const CellGrid> grid, const Measurement& measurement,
               const Layer& layer, const LobeShape& shape = nullptr);

    std::size_t channels() const { return channels_; }
    /// Interpolated f / shape [1/sr] per channel.
    void eval(Vec3 wo, std::span<double> f) const;
    double albedo(std::size_t channel) const { return albedo_[channel]; }

    /// Draws a cell by the energy of the interpolation in it (all channels together) and a
    /// direction in it, uniform in projected solid angle.
    Vec3 sample(double u1, double u2) const;
    /// Density of sample() [1/sr].
    double pdf(Vec3 wo) const;

  private:
    /// The nodes of one channel, the pole not among them; `shapes`: the means of the shape.
    std::vector<double> nodes_of(const Measurement& measurement, const Layer& layer, int channel,
                                 const CellWeights& weights,
                                 const std::vector<double>& shapes) const;
    void build_distribution(const CellWeights& weights, const std::vector<double>& f);

    std::shared_ptr<const CellGrid> grid_;
    std::size_t channels_;
    std::vector<float> f_;        ///< [cell * channels + channel], the pole last
    std::vector<double> albedo_;  ///< per channel
    std::vector<double> rows_;    ///< share of the rows up to and with this one
    std::vector<double> cells_;   ///< likewise of the cells within their row
};

}  // namespace asperity

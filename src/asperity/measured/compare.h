// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>

#include <string>
#include <vector>

namespace asperity {

/// A BRDF averaged over the cells of a detector, for one incident direction: what a perfect
/// gonioreflectometer would have measured. energy[channel * cells + cell] = integral of f
/// cos(theta_o) over the cell. With `isotropic`, also averaged over the incident azimuth with the
/// outgoing azimuth relative to it (only matters for anisotropic models).
struct CellAverages {
    std::vector<double> energy;
    std::vector<double> albedo;  ///< per channel: sum over the cells
};
CellAverages average_over_cells(const Bsdf& brdf, const Detector& detector, double theta_i,
                                double phi_i, bool isotropic, int threads);

/// Distance of two sets of lobes for one incident direction; channels averaged.
///
/// Standard errors are those of independent measurements, to first order in their energies, from
/// CellErrors; NaN where a result does not hold what they come from, 0 between models. Where L1 and
/// RMS are hardly more than noise, they are raised by it (l1_noise), and vary less than their
/// errors say.
struct LayerComparison {
    int number = 0;
    double theta_i = 0, phi_i = 0;
    double albedo_a = 0, albedo_b = 0;
    double albedo_difference = 0;  ///< a - b
    double albedo_difference_error = 0, l1_error = 0, rms_error = 0;
    double l1 = 0;        ///< integral of |fa - fb| cos theta_o dwo over cell means, 0 .. 2
    double rms = 0;       ///< root mean square of (fa - fb) cos theta_o over the hemisphere [1/sr]
    double l1_noise = 0;  ///< what l1 would be from the error bars alone: sum sqrt(2/pi) stderr
};

struct Comparison {
    std::string name_a, name_b;
    std::vector<LayerComparison> layers;
    double mean_l1 = 0, mean_rms = 0, max_albedo_difference = 0;
    double mean_l1_error = 0, mean_rms_error = 0;  ///< of layers that are measured apart
};

/// Compares measurement with measurement (same detector, incidences and number of channels, or one
/// of them with one channel; else Error(InvalidInput) says which differs) or with an analytic
/// model averaged over the same cells.
Comparison compare(const Measurement& a, const Measurement& b);
Comparison compare(const Measurement& a, const Bsdf& b, int threads);
/// Why `compare(a, b)` would refuse two measurements by their cells or incident directions, as a
/// sentence: "one has 15 layers, the other 3"; empty where it would not.
std::string unlike(const Measurement& a, const Measurement& b);
/// The same for measurements that are unlike: `b` is evaluated between its layers, see
/// make_tabulated_brdf, over the cells and incidences of `a`. Its error bars are not propagated:
/// noise and errors are those of `a` alone. Throws Error(InvalidInput), Error(Stopped) when the run
/// is.
Comparison compare_between_layers(const Measurement& a, const Measurement& b, const Run& run);
/// Two models over the cells and incidences of an experiment.
Comparison compare(const Bsdf& a, const Bsdf& b, const Experiment& experiment, int threads);

}  // namespace asperity

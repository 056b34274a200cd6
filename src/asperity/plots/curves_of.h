// SPDX-License-Identifier: Apache-2.0
// What is measured and modelled, as curves. The studio's plots and those of files are made of them.
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/plots/plot_axis.h>
#include <asperity/plots/plot_curves.h>

#include <memory>
#include <string>
#include <vector>

namespace asperity::plots {

/// Sets without curves yet, their quantities named.
CurveSet lobe_set(std::string title);     ///< f over theta_o
CurveSet albedo_set(std::string title);   ///< over theta_i
CurveSet normals_set(std::string title);  ///< D over theta_m

/// "Layer 8, θᵢ = 45°".
std::string layer_title(const Layer& layer);
/// A model's curve in a plot: dashed, the short name in read-outs. `quantity` names its column.
PlotCurve model_curve(const std::string& name, const std::string& brief,
                      const std::string& quantity, PlotInk ink, std::vector<double> x,
                      std::vector<double> y);

/// The slice as a curve with errors and cells.
PlotCurve lobe_curve(const LobeSlice& slice, const std::string& name, const std::string& column,
                     PlotInk ink);
/// f cos(theta_o) of a slice and its errors, for the table; `whose` begins the headers.
std::vector<PlotTable::Column> cosine_columns(const LobeSlice& slice, const std::string& whose);

/// Albedo of layers, in order of theta_i, as dots: of all light and, with `orders` > 0, of the
/// first orders of reflection, the last with all higher ones. Of one channel or, for -1, the mean.
std::vector<PlotCurve> albedo_curves(const Measurement& measurement,
                                     const std::vector<const Layer*>& layers, int channel,
                                     int orders);

/// D over the middles of bins that cut 0 .. 90 degrees evenly.
PlotCurve normals_curve(const std::vector<double>& density, const std::string& name,
                        const std::string& column, PlotInk ink);

PlotAxis lobe_angles(const std::string& plane);  ///< -90 .. 90 degrees
PlotAxis incidence_angles();                     ///< 0 .. 90 degrees
/// 0 up to the steepest facet of all curves.
PlotAxis normal_angles(const CurveSet& set);

/// Upward from 0, or over `decades` of a log axis, to what the set has to show.
PlotAxis value_axis(const CurveSet& set, bool log, double decades, const std::string& label);

/// The lobes between straight axes, light and mirror direction as lines where `theta_i_deg` has
/// them.
std::shared_ptr<const Plot> lobe_plot(CurveSet set, PlotAxis values, const std::string& plane,
                                      const std::vector<double>& theta_i_deg);

}  // namespace asperity::plots

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>

#include <memory>

namespace asperity {

/// The BRDF of a Measurement: evaluated between its layers and sampled with a matching density.
///
/// Between layers (theta_i, and phi_i when several were measured, which runs round): for wi and wo,
/// every neighbouring layer is asked for the direction into which the facet that mirrors wi to wo
/// sends the layer's own light. There its lobe has the same place, so lobes move with the light
/// instead of fading one into another; f over what all layers share is blended (lobe_guide.h):
/// where a layer is within 11 degrees of the normal and shows facets of alpha below 0.25, over
/// D(wm) / (sigma(wi) sigma(wo)), which keeps lobes that are narrower than the cells; elsewhere f
/// times both cosines, clamped away from zero. Where a layer's direction falls below the horizon
/// the other layers count. A factor found for incident directions 1.5 degrees apart, less towards
/// the horizon, then makes the albedo the blend of the layers' albedos. Light sent straight back
/// (grooves) does not follow the mirror: between layers it may double.
///
/// Within a layer: linear between the cells, the pole a node of its own, constant from the last
/// row's middle to the horizon; peaks are kept as far as they stand out of the error bars.
///
/// Beyond the last layer (and before the first) the nearest layer's lobe moves on with the light,
/// with that layer's albedo. Measured with one azimuth only, outgoing azimuths count from the
/// light, as if the surface were isotropic. Sampling draws from the layers' energies, one in ten
/// samples from a cosine. Channels are the measurement's.
///
/// Throws Error(InvalidInput) when the measurement has no layers, a layer without rays, or layers
/// that do not form a grid of theta_i x phi_i. Keeps its own copy of the tables: 4 bytes a cell and
/// channel, 8 a cell. Takes about a second of one thread to make for one azimuth, several for many;
/// the same bits for any number of threads. Throws Error(Stopped) when the run is stopped.
std::unique_ptr<Bsdf> make_tabulated_brdf(const Measurement& measurement, const Run& run);
/// The same on all threads of the machine.
std::unique_ptr<Bsdf> make_tabulated_brdf(const Measurement& measurement);

}  // namespace asperity

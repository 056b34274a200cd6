// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/gonio/measurement.h>

#include <span>
#include <vector>

namespace asperity {

/// A share of the incident energy and its standard error.
struct AlbedoShare {
    double value = 0, error = 0;
};

/// The albedo of a layer, and what of it left after one reflection, after two, ...
struct AlbedoByBounce {
    double theta_i = 0, phi_i = 0;  ///< where the light comes from [rad]
    AlbedoShare total;
    std::vector<AlbedoShare> order;  ///< the last one holds all higher orders too
};

/// The albedo of a layer by `orders` >= 1 groups of bounce orders, of one channel or, for -1, the
/// mean of all. Channels, and the orders of the last group, share their rays: their errors are
/// added as wholly dependent and so never too small. Errors are 0 for a layer without error bars.
/// Throws Error(Usage, "channel").
AlbedoByBounce albedo_by_bounce(const Measurement& measurement, const Layer& layer, int orders,
                                int channel);

/// Directional albedo of a model at `theta_i` and azimuth 0, of one channel or the mean of all.
/// Throws Error(Usage, "channel").
double albedo_at(const Bsdf& brdf, double theta_i, int channel);

}  // namespace asperity

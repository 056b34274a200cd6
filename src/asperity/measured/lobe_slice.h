// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/gonio/measurement.h>

#include <vector>

namespace asperity {

/// A lobe seen in one direction of the plane of incidence. Means over a few cells beside the plane.
struct LobeSample {
    double theta_o = 0;          ///< polar angle [rad], negative on the side the light comes from
    int cell = 0;                ///< of the detector, the one the plane runs through
    double f = 0, f_stderr = 0;  ///< cosine-weighted mean of the BRDF [1/sr]
    double f_cos = 0, f_cos_stderr = 0;  ///< mean of f cos(theta_o) [1/sr]
};

/// Where a lobe is cut.
struct LobeCut {
    double azimuth = 0;  ///< of the plane, from the plane of incidence, counter-clockwise [rad]
    double columns = 1;  ///< half the width of the strip, in columns at the horizon; > 0
};

/// The lobe in a plane through the normal, that of incidence unless cut elsewhere: one sample per
/// row of the detector on either side of the normal, in order of theta_o from -pi/2 to pi/2.
///
/// A sample is the mean over a strip of constant width about the plane: the columns of its row less
/// than LobeCut::columns columns' width at the horizon, 2 pi / columns, away from the plane, and on
/// its side of the normal, cells partly in the strip counting in part. By default these are the two
/// columns that touch the plane at the horizon; near the pole, where cells are slivers that few
/// rays hit, they are many.
struct LobeSlice {
    double theta_i = 0, phi_i = 0;  ///< where the light comes from [rad]
    std::vector<LobeSample> samples;
};

/// The slice of a layer, of one channel or, for -1, the mean of all. Standard errors take cells as
/// independent of each other and channels, which share their rays, as wholly dependent: they are
/// never too small. 0 for a layer without error bars, infinite after a single batch.
/// Throws Error(Usage, "channel").
LobeSlice lobe_slice(const Measurement& measurement, const Layer& layer, int channel,
                     const LobeCut& cut = {});

/// What an instrument without noise would measure of `brdf` in place of `layer`: the same means
/// over the same cells, so the two may be compared point by point however sharp the lobe.
LobeSlice lobe_slice(const Bsdf& brdf, const Measurement& measurement, const Layer& layer,
                     int channel, const LobeCut& cut = {});

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace asperity {

/// Where the light comes from.
struct IlluminationSettings {
    /// Thesis layers: layer k of `layers` stands at elevation 90 k / layers degrees; the last one
    /// is normal incidence. Used when theta_deg is empty. 0: as the lobe of the surface asks, see
    /// with_angles() (gonio/angles_of_lobe.h), which measure() calls.
    int layers = 15;
    std::vector<double> theta_deg;  ///< fixed polar angles, 0 <= . < 90
    std::vector<double> phi_deg = {
        0.0};                ///< azimuths the light comes from; every theta x every phi
    bool isotropic = false;  ///< averaged over the azimuths, outgoing ones relative to it
};

/// How launch points are spread over the tile.
enum class LaunchPattern {
    LowDiscrepancy,  ///< a sheared lattice, shifted at random once a batch
    Stratified,      ///< one jittered point per stratum (thesis eq. 3.3)
    Random,          ///< independent points
};

/// One direction the light comes from.
struct Incidence {
    int number = 0;          ///< Layer::number
    double theta = 0;        ///< polar angle [rad]
    double phi = 0;          ///< azimuth the light comes from [rad]
    bool isotropic = false;  ///< from all azimuths alike instead
};

/// Below this polar angle [rad] light comes straight down: over any surface that check_scale() lets
/// pass it moves aside by less than a ten-thousandth of a cell.
inline constexpr double kStraightDown = 1e-12;

/// Incidences of an experiment in the order they are measured: from normal incidence down. Throws
/// Error(Usage, "layers") where they are left to the lobe of a surface and theta_deg is empty.
std::vector<Incidence> incidences(const IlluminationSettings& settings);

}  // namespace asperity

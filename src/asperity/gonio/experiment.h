// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>
#include <asperity/surface/surface_settings.h>

#include <cstdint>
#include <vector>

namespace asperity {

/// Where the light comes from.
struct IlluminationSettings {
    /// Thesis layers: layer k of `layers` stands at elevation 90 k / layers degrees; the last one
    /// is normal incidence. Used when theta_deg is empty.
    int layers = 15;
    std::vector<double> theta_deg;  ///< fixed polar angles, 0 <= . < 90
    std::vector<double> phi_deg = {
        0.0};                ///< azimuths the light comes from; every theta x every phi
    bool isotropic = false;  ///< azimuth random per ray, outgoing azimuth relative to it
};

/// How the hemisphere is cut into cells; see Detector.
enum class DetectorKind {
    LatLong,    ///< rows equal in theta: the upper half of the thesis' sky-map (eq. 4.5)
    EqualArea,  ///< rows equal in sin^2 theta: every cell the same projected solid angle
};

struct DetectorSettings {
    DetectorKind kind = DetectorKind::LatLong;
    int resolution = 256;  ///< Texture Resolution R: R columns, R / 2 rows
    int orders =
        4;  ///< bounce orders kept apart per cell; the last one holds all higher orders too
};

/// How launch points are spread over the tile.
enum class LaunchPattern {
    LowDiscrepancy,  ///< a sheared lattice, shifted at random once a batch
    Stratified,      ///< one jittered point per stratum (thesis eq. 3.3)
    Random,          ///< independent points
};

struct RunSettings {
    /// Camera Jitter J: launch points per surface cell and layer; see default_jitter().
    double jitter = 16;
    std::uint64_t rays = 0;      ///< per layer; 0: jitter x cells
    double until = 0;            ///< relative error of the albedo to reach, 0: none. See measure()
    double until_cells = 0;      ///< and of the cells; 0: the same as until
    std::uint64_t max_rays = 0;  ///< per layer, for `until`; 0: 256 times the first estimate
    int bounces = 16;            ///< Ray Bounces B: reflections a ray may make, >= 1
    LaunchPattern launch = LaunchPattern::LowDiscrepancy;
    int batches = 16;  ///< independent batches a layer, >= 2, from which errors are estimated
    std::uint64_t seed = 1;
};

/// Launch points per cell of a surface of so many where nobody asks for another number. 16 on small
/// ones: on one of the default size that makes 128 a cell of the default detector, a tenth of noise
/// if all are alike. On more than 2^22 cells fewer, so that a layer has no more than 2^26 rays, or
/// one a cell.
double default_jitter(std::uint64_t cells);

/// One experiment: all that decides the numbers of a Measurement.
struct Experiment {
    SurfaceSettings surface;
    OpticsSettings optics;
    IlluminationSettings illumination;
    DetectorSettings detector;
    RunSettings run;
};

/// Throws Error(Usage, "name of the setting") for the first value outside its range. Surface and
/// optics are checked by make_surface and Fresnel.
void validate(const Experiment& experiment);

}  // namespace asperity

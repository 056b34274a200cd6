// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/detector.h>
#include <asperity/detector/illumination.h>
#include <asperity/optics/optics_settings.h>
#include <asperity/surface/surface_settings.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace asperity {

struct RunSettings {
    /// Realisations of the surface a layer is measured on, see surfaces_of(); 0:
    /// surfaces_of_rays().
    std::uint64_t surfaces = 1;
    /// Camera Jitter J: launch points per surface cell and layer; 0: as jitter_of() says. All
    /// surfaces share them.
    double jitter = 0;
    std::uint64_t rays = 0;      ///< per layer; 0: jitter x cells
    double until = 0;            ///< relative error of the albedo to reach, 0: none. See measure()
    double until_cells = 0;      ///< and of the cells; 0: the same as until
    std::uint64_t max_rays = 0;  ///< per layer, for `until`; 0: 256 times the first estimate
    int bounces = 16;            ///< Ray Bounces B: reflections a ray may make, >= 1
    LaunchPattern launch = LaunchPattern::LowDiscrepancy;
    std::string engine = "wide";  ///< as tracing/engine.h lists them
    /// Independent batches a layer, >= 2, from which errors are estimated; each of several surfaces
    /// is one, whatever this says.
    int batches = 16;
    std::uint64_t seed = 1;
};

/// Launch points per cell of a surface of so many where nobody asks for another number. 16 on small
/// ones: on one of the default size that makes 128 a cell of the default detector, a tenth of noise
/// if all are alike. On more than 2^22 cells fewer, so that a layer has no more than 2^26 rays, or
/// one a cell.
double default_jitter(std::uint64_t cells);

/// The launch points per cell of a run: its `jitter`, or where it names none default_jitter(), 16
/// with a number of `rays` of its own. The one place that says so, for library, programs and
/// studio: measure() and head_of() write it into the experiment of their results.
double jitter_of(const RunSettings& run, std::uint64_t cells);

/// Rays of a layer that a run asks for, in a first estimate.
double rays_wanted(const RunSettings& run, std::uint64_t cells);

/// The number of surfaces that so many rays of a layer are best shared out to: a ray for every cell
/// of a surface, at most 2^20 on each, and 16 to 4096 surfaces. docs/performance.md, "The class of
/// surfaces", says why.
std::uint64_t surfaces_of_rays(double rays, std::uint64_t cells);

/// The surfaces of a run: its `surfaces`, or as many as its rays are best shared out to. With more
/// than one, what is measured is the class: the mean over surfaces of surface seeds S, S + 1 ...,
/// as many rays on each, and errors that hold both the chance of the surfaces and that of the rays.
/// A run that refines (`until`) takes further surfaces, S + surfaces and so on, with its further
/// rays: more rays on the same ones would not bring it nearer to the class.
std::uint64_t surfaces_of(const RunSettings& run, std::uint64_t cells);

/// Why there is no more than one surface of such settings, a sentence; empty when there are many:
/// kinds that are made from a surface-seed.
std::string only_surface(const SurfaceSettings& surface);

/// One experiment: all that decides the numbers of a Measurement.
struct Experiment {
    SurfaceSettings surface;
    OpticsSettings optics;
    IlluminationSettings illumination;
    DetectorSettings detector;
    RunSettings run;
};

/// Layers of an experiment at most: polar angles times azimuths.
inline constexpr std::size_t kMostLayers = 100000;

/// Throws Error(Usage, "name of the setting") for the first value outside its range. Surface and
/// optics are checked by make_surface and Fresnel.
void validate(const Experiment& experiment);

}  // namespace asperity

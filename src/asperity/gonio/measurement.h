// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/detector.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/statistics.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// Sums over all cells and channels of a layer of the squared standard errors of their energy.
struct CellNoise {
    double rays = 0;  ///< those that the rays make
    double both = 0;  ///< those of rays and surfaces
};

/// What the errors of a layer come from, so that more batches can be added to it: sums of squares
/// over batches, see LayerSums. Index order as in the Layer's arrays.
struct LayerSpread {
    BatchSet done;                                 ///< the batches in the layer
    std::uint64_t largest_batch = 0;               ///< rays
    std::vector<LayerSums::Wide> squares;          ///< like stderr_energy; empty: not known
    std::vector<std::uint64_t> stretched;          ///< likewise, or empty
    std::vector<std::uint64_t> exact;              ///< likewise, or empty
    std::vector<std::uint32_t> reached;            ///< likewise
    std::vector<LayerSums::Spread> bounces;        ///< like escaped_by_bounce
    std::vector<LayerSums::Spread> albedo;         ///< like stderr_albedo
    std::vector<LayerSums::Spread> albedo_by_age;  ///< [age * values + value], see LayerSums
    LayerSums::Halves halves;  ///< like squares and albedo; empty for one surface
    GroupSums groups;
    std::optional<CellNoise> cell_noise;  ///< in place of cells that were not read: io::load_head
};

/// Light that left the surface for one incident direction, sorted by outgoing direction.
///
/// Energies are integers in units of 2^-32 of a launched ray (core/energy.h). Index order of
/// `energy`: [((side * orders + order) * values + value) * cells + cell], value = channel *
/// elements
/// + element; side 0 is what is reflected, element 0 the energy, and today there are no others.
/// Order 0 = left after one reflection; the last order holds all higher ones too. Per channel
///     rays * 2^32 = escaped + absorbed + truncated + edge,   escaped = sum of `energy`.
struct Layer {
    int number = 0;                 ///< thesis layer, 1 .. N; counts up from 1 for fixed angles
    double theta_i = 0;             ///< incident polar angle [rad], 0 = along the normal
    double phi_i = 0;               ///< azimuth the light comes from [rad]; 0 when isotropic
    std::uint64_t rays = 0;         ///< launched
    std::uint64_t segments = 0;     ///< ray segments traced
    std::uint64_t reflections = 0;  ///< of all rays together, the truncated ones' B each included
    std::uint64_t stuck = 0;        ///< rays whose energy counts as truncated: RayEnd::Stuck
    int batches = 0;

    std::vector<std::uint64_t> energy;     ///< orders x channels x cells
    std::vector<std::uint64_t> escaped;    ///< per channel
    std::vector<std::uint64_t> absorbed;   ///< per channel
    std::vector<std::uint64_t> truncated;  ///< per channel: would need reflection B + 1, and stuck
    std::vector<std::uint64_t> edge;       ///< per channel: left through the side of a patch
    std::vector<std::uint64_t> escaped_by_bounce;  ///< [channel * B + order], B = Ray Bounces

    std::vector<float> stderr_energy;   ///< [channel * cells + cell], fraction of launched energy
    std::vector<double> stderr_albedo;  ///< per channel
    std::vector<double> stderr_albedo_by_bounce;  ///< like escaped_by_bounce
    LayerSpread spread;
};

/// The result of a run: an experiment and what came out of it.
struct Measurement {
    Experiment experiment;
    Detector detector;
    std::vector<std::string> channel_names;  ///< as Fresnel::channel_names
    SurfaceStatistics surface;               ///< of the surface as traced
    std::string surface_name;
    int surface_nx = 0, surface_ny = 0;
    double surface_dx = 1, surface_dy = 1;
    bool surface_isotropic = false;
    std::vector<Layer> layers;       ///< in the order they were filled: from normal incidence down
    bool stopped = false;            ///< the user stopped the run: the layers hold the batches done
    std::vector<std::string> notes;  ///< what a reader should know, one sentence each

    // How it was run; no part of the checksum.
    std::string surface_digest;       ///< of the heights, asperity::digest
    std::uint64_t surface_cells = 0;  ///< on which the plan of the batches depends
    int part = 1, parts = 1;          ///< more than one: a share of the batches, see MeasureScope
    double trace_seconds = 0;         ///< wall-clock time of tracing, without pauses
    int threads = 0;
    std::string version;

    int channels() const { return static_cast<int>(channel_names.size()); }
    int orders() const;  ///< bounce orders kept apart per cell
    int bounces() const { return experiment.run.bounces; }
    SumShape shape() const;

    /// Energy of one cell over all orders, as a fraction of the launched energy.
    double energy(const Layer& layer, int channel, int cell) const;
    double energy(const Layer& layer, int order, int channel, int cell) const;
    /// The same of all cells of a channel, over all orders.
    std::vector<double> energies(const Layer& layer, int channel) const;
    /// BRDF of a cell [1/sr]: the cosine-weighted mean of f_r over the cell,
    /// energy / projected solid angle. No cosine included.
    double brdf(const Layer& layer, int channel, int cell) const;
    double brdf_stderr(const Layer& layer, int channel, int cell) const;
    double albedo(const Layer& layer, int channel) const;
    double albedo(const Layer& layer, int order, int channel) const;  ///< order 0 .. B - 1
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/gonio/measurement.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace asperity {

class CellErrors;

/// Which light of a measurement a model is fitted to.
enum class FitLight {
    All,     ///< all that left the surface
    Single,  ///< what left after one reflection: microfacet models know no other
};

/// Cells side by side, taken as one value: rows row0 .. row1 - 1, columns column0 .. column1 - 1.
struct FitBlock {
    std::size_t layer = 0;
    int row0 = 0, row1 = 0, column0 = 0, column1 = 0;
    double solid_angle = 0;  ///< [sr]
    std::size_t first_node = 0, nodes = 0;

    int cells() const { return (row1 - row0) * (column1 - column0); }
};

/// A direction in a block and the projected solid angle it stands for [sr].
struct FitNode {
    Vec3 wo;
    double weight = 0;
};

struct FitLayer {
    double theta_i = 0, phi_i = 0;
    Vec3 wi;
    std::size_t first_block = 0, blocks = 0;

    /// Errors of what is told from several cells; nullptr where they are not known.
    std::shared_ptr<const CellErrors> errors = nullptr;
    /// By how much an error of all light is one of the light fitted to, [channel * cells + cell];
    /// empty: it is the same.
    std::vector<double> error_share = {};
};

/// What models are fitted to: energies of blocks of cells, with their errors.
///
/// A block is a single cell where much of the light goes and up to 0.08 sr where little does, so
/// that each holds enough rays to count as normally distributed and to be integrated with few
/// points. Index order: [block * channels + channel]; energies are fractions of the incident
/// energy, integral of f cos(theta_o) over the block.
struct FitData {
    std::string name;
    Detector detector;
    int channels = 1;
    bool turns_with_light =
        false;              ///< averaged over the azimuth of the light: isotropic models only
    OpticsSettings optics;  ///< of the facets, if `knows_optics`
    bool knows_optics = false;
    std::vector<FitLayer> layers;
    std::vector<FitBlock> blocks;
    std::vector<FitNode> nodes;
    std::vector<double> energy;
    /// Variance over energy around each block, which for rays of one weight is that weight: times
    /// what a model expects there it is the variance of the block. Empty: errors are not known.
    /// Of blocks of several cells from batches, where layers tell: `design_effect` is their
    /// variance over what it were if cells knew nothing of each other, in the mean over these
    /// blocks.
    std::vector<double> spread;
    double design_effect = 1;

    /// What the errors do not hold, a sentence; empty where they hold all.
    std::string errors_lack;

    /// Errors of what is told from many blocks are known, from batches.
    bool has_batches() const {
        return has_errors() && std::all_of(layers.begin(), layers.end(), [](const FitLayer& layer) {
                   return layer.errors != nullptr;
               });
    }
    bool has_errors() const { return !spread.empty(); }
};

/// The layers with theta_i below `last_theta` [rad] and the cells with theta_o below it, at least
/// one row. Layers without any light are left out. Throws Error(InvalidInput, name) when none is
/// left, or when Single is asked for and the bounce orders were not kept.
FitData fit_data(const Measurement& measurement, FitLight light, double last_theta);

/// A BSDF without error bars, averaged over the cells and incidences of `experiment`.
FitData fit_data(const Bsdf& bsdf, const Experiment& experiment, double last_theta, int threads);

/// Energies of the blocks by a model, as FitData::energy. A model of one channel counts for all of
/// the data's; data of one channel get the mean of the model's. Throws Error(Usage, model's name)
/// for other numbers of channels.
std::vector<double> predict(const FitData& data, const Bsdf& model, int threads);

/// Mean of f cos(theta_o) [1/sr] over the block that a cell belongs to, channels averaged, a value
/// a cell of the detector; NaN outside all blocks. `energy`: as FitData::energy.
std::vector<double> over_cells(const FitData& data, const std::vector<double>& energy,
                               const FitLayer& layer);

/// Share of the light of `measurement`, all layers together, that was reflected more than once.
double multiple_share(const Measurement& measurement);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// For the command line and the studio: pictures know nothing of fits, nor fits of pictures.
#pragma once

#include <asperity/fit/fit.h>
#include <asperity/fit/fit_data.h>
#include <asperity/pictures/residual_sheet.h>

#include <fmt/format.h>

#include <string>
#include <vector>

namespace asperity {

/// A PNG of data, fit and their difference, layer by layer. Throws Error(InputOutput, path).
inline void write_residuals(const FitData& data, const Fit& fit, const std::string& path) {
    std::vector<io::ResidualTile> tiles;
    for (std::size_t k = 0; k < data.layers.size(); ++k) {
        const FitLayer& layer = data.layers[k];
        tiles.push_back({layer.theta_i, layer.phi_i, over_cells(data, data.energy, layer),
                         over_cells(data, fit.energy, layer),
                         fmt::format("L1 {:.3g} %", 100 * fit.layers[k].l1)});
    }
    io::write_residual_sheet(
        data.detector, tiles, fit.spec,
        fmt::format("fitted to {}: L1 of f cos {:.3g} %", data.name, 100 * fit.mean_l1), path);
}

}  // namespace asperity

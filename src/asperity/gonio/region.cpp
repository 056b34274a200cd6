// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/region.h>

#include <asperity/core/error.h>
#include <asperity/core/index.h>
#include <asperity/gonio/cell_errors.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace asperity {

namespace {

constexpr double kFewRays = 10;

}  // namespace

std::vector<int> cells_in(const Detector& detector, const Region& r) {
    constexpr double kRounding = 1e-9;
    if (!(r.theta_from >= 0 && r.theta_from < r.theta_to && r.theta_to <= 0.5 * kPi + kRounding &&
          r.phi_from < r.phi_to && r.phi_to - r.phi_from <= 2 * kPi + kRounding &&
          std::abs(r.phi_from) <= 4 * kPi))
        throw Error(ErrorCode::Usage,
                    fmt::format("{:g}:{:g},{:g}:{:g} degrees are no part of the hemisphere: polar "
                                "angles grow within 0 to 90, azimuths by 360 at most",
                                degrees(r.theta_from), degrees(r.theta_to), degrees(r.phi_from),
                                degrees(r.phi_to)),
                    "region");
    std::vector<int> cells;
    for (int row = 0; row < detector.rows(); ++row) {
        const double theta = detector.theta_centre(row);
        if (theta < r.theta_from || theta >= r.theta_to) continue;
        for (int column = 0; column < detector.columns(); ++column) {
            const double turns = (detector.phi_centre(column) - r.phi_from) / (2 * kPi);
            if (2 * kPi * (turns - std::floor(turns)) < r.phi_to - r.phi_from)
                cells.push_back(row * detector.columns() + column);
        }
    }
    return cells;
}

EnergyOfCells energy_of_cells(const Measurement& m, const Layer& layer, int channel,
                              std::span<const int> cells) {
    EnergyOfCells sum;
    for (const int cell : cells) sum.energy += m.energy(layer, channel, cell);
    sum.few_rays = sum.energy * static_cast<double>(layer.rays) < kFewRays;
    if (cells.size() == 1)
        sum.error = double{
            layer.stderr_energy[index(channel) * index(m.detector.cells()) + index(cells.front())]};
    else if (!CellErrors::known(layer))
        sum.error = std::numeric_limits<double>::quiet_NaN();
    else if (!cells.empty())
        sum.error = CellErrors(m, layer).error_of_cells(index(channel), cells);
    return sum;
}

}  // namespace asperity

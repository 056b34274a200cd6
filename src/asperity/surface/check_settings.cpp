// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/check_settings.h>

#include <asperity/core/error.h>
#include <asperity/surface/surface_params.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity {

CellSize cell_size(const SurfaceSettings& s) {
    return {s.cell_x.value_or(s.cell_y.value_or(1)), s.cell_y.value_or(s.cell_x.value_or(1))};
}

void check_settings(const SurfaceSettings& s) {
    check_all(surface_params(), s);
    const CellSize cell = cell_size(s);
    if (cell.y > 100 * cell.x || cell.x > 100 * cell.y)
        throw Error(ErrorCode::Usage,
                    fmt::format("sides of {} and {} differ by more than 100 times", cell.x, cell.y),
                    "cell-size");
    if (std::abs(s.height_scale) < 1e-9)
        throw Error(ErrorCode::Usage,
                    fmt::format("the magnitude of {} is below 1e-09", s.height_scale),
                    "height-scale");
}

}  // namespace asperity

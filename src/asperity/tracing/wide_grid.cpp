// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/wide_grid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity {

namespace {

/// The middle of `cells`, on the border between two blocks of the horizon.
int middle_of(int cells) {
    return cells / 2 & ~3;
}

}  // namespace

WideGrid::WideGrid(const PaddedHeights& h, const Horizon& free)
    : middle(h.origin()),
      pitch(h.pitch()),
      middle_x(middle_of(h.cells_x())),
      middle_y(middle_of(h.cells_y())),
      cells_x(h.cells_x()),
      cells_y(h.cells_y()),
      periodic(h.periodic()),
      per_x(static_cast<float>(1 / h.dx())),
      per_y(static_cast<float>(1 / h.dy())),
      max_height(h.max_height()),
      horizon(free.bytes()),
      horizon_pitch(free.pitch()),
      pool_shift(free.pool_shift()) {
    middle += static_cast<std::ptrdiff_t>(middle_y) * pitch + middle_x;
    horizon += (static_cast<std::ptrdiff_t>(middle_y >> pool_shift) * horizon_pitch +
                (middle_x >> pool_shift)) *
               Horizon::kSectors;
    const double range = double{h.max_height()} - double{h.min_height()};
    steepest = static_cast<float>(1.0001 * range * std::hypot(1 / h.dx(), 1 / h.dy()));
    // A path that leaves the patch must still be near it, where the lanes can tell
    longest_leap = periodic ? 0.5f * static_cast<float>(std::min(cells_x, cells_y)) -
                                  static_cast<float>(PaddedHeights::kMargin) / 4
                            : static_cast<float>(PaddedHeights::kMargin) / 2;
}

}  // namespace asperity

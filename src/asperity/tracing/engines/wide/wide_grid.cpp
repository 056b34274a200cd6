// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/wide_grid.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace asperity {

namespace {

constexpr int kProbes = 64;
constexpr double kOutside = double{PaddedHeights::kFarBelow};

/// Cell number `k` of kProbes, spread over `cells`.
int probe(int k, int cells) {
    return static_cast<int>(std::int64_t{k} * cells / kProbes);
}

/// The middle of `cells`, on the border between two blocks of the horizon.
int middle_of(int cells) {
    return cells / 2 & ~3;
}

/// Share of the paths, spread over the hemisphere like Lambert's cosine, that climb above the
/// horizon of their cell: the mean of 1 / (1 + slope^2). From some thousand cells.
double share_above(const PaddedHeights& h, const Horizon& horizon) {
    double sum = 0;
    for (int a = 0; a < kProbes; ++a)
        for (int b = 0; b < kProbes; ++b)
            for (int sector = 0; sector < Horizon::kSectors; ++sector) {
                const double slope = double{Horizon::slope_of(
                    horizon.byte(probe(a, h.cells_x()), probe(b, h.cells_y()), sector))};
                sum += 1 / (1 + slope * slope);
            }
    return sum / (kProbes * kProbes * Horizon::kSectors);
}

/// How much slopes change from cell to cell: mean square of the second difference of heights over
/// that of the first; 3 for independent heights, towards 0 for smooth ones.
double roughness_of_slopes(const PaddedHeights& h) {
    double first = 0, second = 0;
    for (int a = 0; a < kProbes; ++a)
        for (int b = 0; b < kProbes; ++b) {
            const int i = probe(a, h.cells_x() - 1), j = probe(b, h.cells_y());
            const double left = double{h.at(i, j)}, middle = double{h.at(i + 1, j)},
                         right = double{h.at(i + 2, j)};
            if (left == kOutside || right == kOutside) continue;
            first += (middle - left) * (middle - left);
            second += (right - 2 * middle + left) * (right - 2 * middle + left);
        }
    return first > 0 ? second / first : 0.0;
}

/// Whether the azimuths of some thousand slopes come together in a few narrow sectors: their
/// shares, squared, add up to five times that of an even spread.
bool crowded_azimuths(const PaddedHeights& h) {
    constexpr int kSectors = 64;
    constexpr double kCrowded = 5.0 / kSectors;
    std::array<double, kSectors> counts{};
    double all = 0;
    const auto add = [&](float along_x, float along_y) {
        const double x = double{along_x} / h.dx(), y = double{along_y} / h.dy();
        if (x == 0 && y == 0) return;  // a level facet looks nowhere
        const double turns = std::atan2(y, x) / (2 * kPi) + 1;
        ++counts[static_cast<std::size_t>(turns * kSectors + 0.5) % kSectors];
        ++all;
    };
    for (int a = 0; a < kProbes; ++a)
        for (int b = 0; b < kProbes; ++b) {
            // Not all in step with what repeats in both directions
            const int i = (probe(a, h.cells_x()) + 7 * b) % h.cells_x(),
                      j = (probe(b, h.cells_y()) + 5 * a) % h.cells_y();
            const float h00 = h.at(i, j), h10 = h.at(i + 1, j), h01 = h.at(i, j + 1),
                        h11 = h.at(i + 1, j + 1);
            add(h10 - h00, h01 - h00);
            add(h11 - h01, h11 - h10);
        }
    double squares = 0;
    for (const double count : counts) squares += count * count;
    return squares > kCrowded * all * all;
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
    horizon_pays = share_above(h, free) > 0.1;
    leaps_pay = roughness_of_slopes(h) < 1;
    few_azimuths = crowded_azimuths(h);
    steepest = static_cast<float>(1.0001 * range * std::hypot(1 / h.dx(), 1 / h.dy()));
    // A path that leaves the patch must still be near it, where the lanes can tell
    longest_leap = periodic ? 0.5f * static_cast<float>(std::min(cells_x, cells_y)) -
                                  static_cast<float>(PaddedHeights::kMargin) / 4
                            : static_cast<float>(PaddedHeights::kMargin) / 2;
}

}  // namespace asperity

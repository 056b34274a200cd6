// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace asperity::detail {

/// Where the horizon looks how closely, as seen from a cell. The surface out there is cut into
/// nested square frames ("rings" of cells around the cell); every frame is looked at more coarsely
/// than the one inside it. Lengths here are in cells.
struct HorizonReach {
    /// Rings up to here: single samples, their heights taken both as they are (tight on white
    /// noise) and above the mean plane through the cell (tight on smooth surfaces): the lesser
    /// slope counts.
    static constexpr int kPlane = 5;
    /// Rings up to here: single samples.
    static constexpr int kNear = 10;
    /// Up to kWindows: the highest points of squares of kWindow x kWindow cells.
    static constexpr int kWindow = 3, kWindowFrames = 5;
    static constexpr int kWindows = kNear + kWindow * kWindowFrames;
    /// Then tiles of 8 x 8 cells seen from blocks of 8 x 8 cells, as far as kTiles tiles ...
    static constexpr int kTile = 8, kTiles = 11, kTilesInside = 2;
    /// ... and tiles of 32 x 32 cells seen from blocks of as many, as far as kWideTiles tiles.
    static constexpr int kWideTile = 32, kWideTiles = 16, kWideTilesInside = 2;

    // Squares of kWindow fill the near part, and each level begins where the last one ends.
    static_assert((2 * kNear + 1) % kWindow == 0);
    static_assert(kWindows >= kTile * (kTilesInside + 1) - 1);
    static_assert(kTile * kTiles >= kWideTile * (kWideTilesInside + 1) - kTile);
};

/// One piece of the surface that a sector looks at: its height above the viewer, times `inverse`,
/// is the slope it needs.
struct HorizonTerm {
    std::int32_t offset;  ///< of its height from the viewer's in some array
    float inverse;        ///< 1 / distance
};
using HorizonTerms = std::vector<HorizonTerm>;

/// A corner of the compass and all that can be seen in it. Lengths are in units of dx.
///
/// Let u be the sector's middle and v the corners of the cell P. Terms called `front` measure the
/// distance of a sample w along u from the corner of P furthest along u; those called `blunt` the
/// shortest distance from any point of P to any point of a cell Q, in all directions.
struct HorizonSector {
    /// u . (v_front - v) >= 0 for the corners (0,0), (1,0), (0,1), (1,1) of P.
    float back[4];
    HorizonTerms plane;                     ///< samples of rings <= kPlane above the plane
    HorizonTerms close_front, close_blunt;  ///< the same samples as they are
    HorizonTerms front, blunt;              ///< samples of the rings up to kNear
    HorizonTerms window_front, window_blunt;
    HorizonTerms tiles, wide_tiles;
};

/// All the distances and directions the horizon needs, which depend only on the shape of a cell.
struct HorizonGeometry {
    /// The five directions that bound the four sectors of a quadrant, from x to y, |d| = 1.
    static constexpr int kEdges = 5;
    float edge_x[kEdges], edge_y[kEdges];
    float secant;  ///< 1 / cos of half a sector's width: over the values at its two edges
    float aspect;  ///< dy / dx
    HorizonSector sectors[16];
    /// 1 / distance of what no tile holds, from any viewer.
    float beyond;

    /// Samples from row to row in the arrays that the terms' offsets are for.
    struct Pitches {
        int plane, samples, tiles, wide_tiles;
    };
    HorizonGeometry(double dx, double dy, const Pitches& pitches);

    /// Index of the k-th sector from x to y of quadrant (bit 0: x < 0, bit 1: y < 0).
    static int sector(int quadrant, int k) {
        return quadrant | (k >= 2 ? 4 : 0) | (k == 1 || k == 2 ? 8 : 0);
    }
};

}  // namespace asperity::detail

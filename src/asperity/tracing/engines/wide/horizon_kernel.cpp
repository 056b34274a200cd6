// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/horizon.h>
#include <asperity/tracing/engines/wide/horizon_block.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/tracing/engines/wide/horizon_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Reach = HorizonReach;
using Block = HorizonBlock;

/// Neighbouring cells of a row side by side. No result depends on how many, and nothing is fused:
/// every instruction set gives the same bytes.
using Tag = hn::CappedTag<float, 16>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kTag));

/// Four vectors at a time: constants are loaded once for all of them.
constexpr int kVectors = 4;
constexpr int kWide = kVectors * kLanes;
static_assert(Block::kCells % kWide == 0);
/// No array: it would be kept in memory.
struct Wide {
    V v0, v1, v2, v3;
};

HWY_INLINE Wide fill(float value) {
    const V v = hn::Set(kTag, value);
    return {v, v, v, v};
}
HWY_INLINE Wide load(const float* from) {
    return {hn::LoadU(kTag, from), hn::LoadU(kTag, from + kLanes),
            hn::LoadU(kTag, from + 2 * kLanes), hn::LoadU(kTag, from + 3 * kLanes)};
}
HWY_INLINE void store(const Wide& x, float* to) {
    hn::StoreU(x.v0, kTag, to);
    hn::StoreU(x.v1, kTag, to + kLanes);
    hn::StoreU(x.v2, kTag, to + 2 * kLanes);
    hn::StoreU(x.v3, kTag, to + 3 * kLanes);
}
HWY_INLINE Wide operator+(const Wide& a, const Wide& b) {
    return {hn::Add(a.v0, b.v0), hn::Add(a.v1, b.v1), hn::Add(a.v2, b.v2), hn::Add(a.v3, b.v3)};
}
HWY_INLINE Wide operator-(const Wide& a, const Wide& b) {
    return {hn::Sub(a.v0, b.v0), hn::Sub(a.v1, b.v1), hn::Sub(a.v2, b.v2), hn::Sub(a.v3, b.v3)};
}
HWY_INLINE Wide operator*(const Wide& a, const Wide& b) {
    return {hn::Mul(a.v0, b.v0), hn::Mul(a.v1, b.v1), hn::Mul(a.v2, b.v2), hn::Mul(a.v3, b.v3)};
}
HWY_INLINE Wide operator*(const Wide& a, float b) {
    return a * fill(b);
}
HWY_INLINE Wide max(const Wide& a, const Wide& b) {
    return {hn::Max(a.v0, b.v0), hn::Max(a.v1, b.v1), hn::Max(a.v2, b.v2), hn::Max(a.v3, b.v3)};
}
HWY_INLINE Wide min(const Wide& a, const Wide& b) {
    return {hn::Min(a.v0, b.v0), hn::Min(a.v1, b.v1), hn::Min(a.v2, b.v2), hn::Min(a.v3, b.v3)};
}

/// The largest of `least` and the slopes from `viewer` to all the terms, whose offsets are in units
/// of kStride.
template <int kStride>
HWY_INLINE Wide steepest(const HorizonTerms& terms, const float* from, const Wide& viewer,
                         Wide least) {
    for (const HorizonTerm& term : terms)
        least = max(least, (load(from + term.offset * kStride) - viewer) * term.inverse);
    return least;
}

/// The highest points of all windows that some viewer looks at.
void find_windows(Block& block) {
    constexpr int kSize = Reach::kWindow, kHalo = Reach::kWindows;
    for (int j = -kHalo; j + kSize <= Block::kCells + kHalo; ++j) {
        for (int i = -kHalo; i <= Block::kCells + kHalo; i += kLanes) {
            const float* from = block.samples.data() + Block::at(i, j);
            V highest = hn::LoadU(kTag, from);
            for (int k = 1; k <= kSize; ++k)
                highest = hn::Max(highest, hn::LoadU(kTag, from + k * Block::kPitch));
            hn::StoreU(highest, kTag, block.scratch.data() + i + kHalo);
        }
        for (int i = -kHalo; i <= Block::kCells + kHalo; i += kLanes) {
            const float* from = block.scratch.data() + i + kHalo;
            V highest = hn::LoadU(kTag, from);
            for (int k = 1; k <= kSize; ++k) highest = hn::Max(highest, hn::LoadU(kTag, from + k));
            hn::StoreU(highest, kTag, block.windows.data() + Block::at(i, j));
        }
    }
}

/// The highest points of the tiles around.
void find_tiles(Block& block) {
    constexpr int kSize = Reach::kTile;
    const HorizonLevel& level = block.near_tiles;
    float* tiles = block.near_tiles.tiles.data();
    for (int b = 0; b < level.pitch; ++b) {
        const float* row = block.samples.data() + b * kSize * Block::kPitch;
        for (int i = 0; i < Block::kSide; i += kLanes) {
            V highest = hn::LoadU(kTag, row + i);
            for (int k = 1; k <= kSize; ++k)
                highest = hn::Max(highest, hn::LoadU(kTag, row + k * Block::kPitch + i));
            hn::StoreU(highest, kTag, block.scratch.data() + i);
        }
        for (int a = 0; a < level.pitch; ++a) {
            const float* from = block.scratch.data() + a * kSize;
            tiles[b * level.pitch + a] = *std::max_element(from, from + kSize + 1);
        }
    }
}

/// The lowest and highest viewers of every square of the level.
void find_viewers(const Block& block, int size, HorizonLevel& level) {
    for (int b = 0; b < level.viewers; ++b) {
        for (int a = 0; a < level.viewers; ++a) {
            // A cell's viewer is its lowest corner, so at most as high as its first
            float low = 0, high = PaddedHeights::kFarBelow;
            const int i1 = std::min((a + 1) * size, block.cells_x);
            const int j1 = std::min((b + 1) * size, block.cells_y);
            for (int j = b * size; j <= j1; ++j) {
                for (int i = a * size; i <= i1; ++i) {
                    const float height = block.samples.data()[Block::at(i, j)];
                    low = std::min(low, height);
                    if (i < i1 && j < j1) high = std::max(high, height);
                }
            }
            level.lowest.data()[b * HorizonLevel::kRow + a] = low;
            level.highest.data()[b * HorizonLevel::kRow + a] = std::max(low, high);
        }
    }
}

/// Slopes from the viewers of a row of the level, all at heights `viewers`, to the tiles of a
/// sector: raises `slopes`.
void climb_row(const HorizonTerms& terms, const float* tiles, const float* viewers, float* slopes) {
    for (int a = 0; a < HorizonLevel::kRow; a += kLanes) {
        const V viewer = hn::LoadU(kTag, viewers + a);
        V slope = hn::LoadU(kTag, slopes + a);
        for (const HorizonTerm& term : terms) {
            const V above = hn::Sub(hn::LoadU(kTag, tiles + a + term.offset), viewer);
            slope = hn::Max(slope, hn::Mul(above, hn::Set(kTag, term.inverse)));
        }
        hn::StoreU(slope, kTag, slopes + a);
    }
}

/// Makes the chords of a level. `beyond(row, column, sector, height)` is the slope needed for what
/// lies outside its tiles.
template <class Beyond>
void climb(HorizonLevel& level, const HorizonSector* sectors, HorizonTerms HorizonSector::*terms,
           const Beyond& beyond) {
    constexpr int kRow = HorizonLevel::kRow;
    for (int b = 0; b < level.viewers; ++b) {
        const float* low = level.lowest.data() + b * kRow;
        const float* high = level.highest.data() + b * kRow;
        const float* tiles = level.origin() + b * level.pitch;
        for (int s = 0; s < Block::kSectors; ++s) {
            float* at_low = level.at_lowest.data() + (b * Block::kSectors + s) * kRow;
            float* rise = level.rise.data() + (b * Block::kSectors + s) * kRow;
            float at_high[kRow] = {};
            for (int a = 0; a < level.viewers; ++a) {
                at_low[a] = beyond(b, a, s, low[a]);
                at_high[a] = beyond(b, a, s, high[a]);
            }
            climb_row(sectors[s].*terms, tiles, low, at_low);
            climb_row(sectors[s].*terms, tiles, high, at_high);
            for (int a = 0; a < level.viewers; ++a)
                rise[a] = high[a] > low[a] ? (at_high[a] - at_low[a]) / (high[a] - low[a]) : 0;
        }
    }
}

void climb_far(const HorizonGeometry& geometry, Block& block) {
    constexpr int kRow = HorizonLevel::kRow;
    HorizonLevel &near = block.near_tiles, &wide = block.wide_tiles;
    find_viewers(block, Reach::kTile, near);
    find_viewers(block, Reach::kWideTile, wide);
    // The highest point of all has height 0
    climb(wide, geometry.sectors, &HorizonSector::wide_tiles,
          [&](int, int, int, float height) { return -height * geometry.beyond; });
    constexpr int kRatio = Reach::kWideTile / Reach::kTile;
    climb(near, geometry.sectors, &HorizonSector::tiles, [&](int b, int a, int s, float height) {
        const int row = b / kRatio, column = a / kRatio;
        const int at = (row * Block::kSectors + s) * kRow + column;
        return std::max(
            0.0f, wide.at_lowest.data()[at] +
                      wide.rise.data()[at] * (height - wide.lowest.data()[row * kRow + column]));
    });
}

/// The slopes needed for the tiles, spread to all cells of a row.
struct FarSlopes {
    float lowest[Block::kCells];
    float at_lowest[Block::kSectors][Block::kCells];
    float rise[Block::kSectors][Block::kCells];

    void spread(const HorizonLevel& level, int row) {
        constexpr int kSize = Reach::kTile;
        for (int i = 0; i < Block::kCells; ++i)
            lowest[i] = level.lowest.data()[row * HorizonLevel::kRow + i / kSize];
        for (int s = 0; s < Block::kSectors; ++s) {
            const int at = (row * Block::kSectors + s) * HorizonLevel::kRow;
            for (int i = 0; i < Block::kCells; ++i) {
                at_lowest[s][i] = level.at_lowest.data()[at + i / kSize];
                rise[s][i] = level.rise.data()[at + i / kSize];
            }
        }
    }
};

/// kWide neighbouring cells of a row, and their horizons.
class Viewers {
  public:
    Viewers(const HorizonGeometry& geometry, const Block& block, int i, int j)
        : geometry_(geometry),
          samples_(block.samples.data() + Block::at(i, j)),
          windows_(block.windows.data() + Block::at(i, j)) {
        for (int k = 0; k < 4; ++k) corner_[k] = load(samples_ + k / 2 * Block::kPitch + k % 2);
        lowest_ = min(min(corner_[0], corner_[1]), min(corner_[2], corner_[3]));
        take_facets();
        take_plane();
    }
    const Wide& lowest() const { return lowest_; }

    /// Directional slopes at the five edges of a quadrant: of the steepest facet met in the cells
    /// next to these, and of their own mean planes.
    struct Edges {
        Wide steepest[HorizonGeometry::kEdges], plane[HorizonGeometry::kEdges];
    };
    Edges edges(int quadrant) const {
        const int step_x = quadrant & 1 ? -1 : 1, step_y = quadrant & 2 ? -1 : 1;
        Edges result;
        for (int e = 0; e < HorizonGeometry::kEdges; ++e) {
            const float x = geometry_.edge_x[e] * static_cast<float>(step_x);
            const float y = geometry_.edge_y[e] * static_cast<float>(step_y);
            result.plane[e] = plane_x_ * x + plane_y_ * y;
            Wide most = fill(-INFINITY);
            for (int k = 0; k < 4; ++k) {
                const int a = 1 + k % 2 * step_x, b = 1 + k / 2 * step_y;
                most = max(most, load(rise_x_[b][a]) * x + load(rise_y_[b][a]) * y);
                most = max(most, load(rise_x_[b + 1][a]) * x + load(rise_y_[b][a + 1]) * y);
            }
            result.steepest[e] = most;
        }
        return result;
    }

    /// Slope that nothing in the k-th sector of the quadrant exceeds, but for what FarSlopes knows.
    Wide bound(const Edges& edges, int k, const HorizonSector& sector) const {
        // By the mean value theorem, no slope within the nearest cells exceeds the steepest facet's
        const Wide least = max(fill(0), between(edges.steepest[k], edges.steepest[k + 1]));
        const Wide plane = between(edges.plane[k], edges.plane[k + 1]);
        // A path at least as steep as `least`, from wherever it starts, passes above this height
        // where it leaves the cell
        Wide viewer = corner_[0] + least * sector.back[0];
        for (int v = 1; v < 4; ++v) viewer = min(viewer, corner_[v] + least * sector.back[v]);
        const Wide tilted = plane + steepest<kWide>(sector.plane, above_plane_, fill(0), fill(0));
        Wide level = steepest<1>(sector.close_front, samples_, viewer, least);
        level = steepest<1>(sector.close_blunt, samples_, lowest_, level);

        Wide slope = max(least, min(tilted, level));
        slope = steepest<1>(sector.front, samples_, viewer, slope);
        slope = steepest<1>(sector.window_front, windows_, viewer, slope);
        slope = steepest<1>(sector.blunt, samples_, lowest_, slope);
        return steepest<1>(sector.window_blunt, windows_, lowest_, slope);
    }

  private:
    /// A bound of g . d between two edges of a sector, given its values there.
    Wide between(const Wide& a, const Wide& b) const {
        const Wide most = max(a, b);
        return max(most, most * geometry_.secant);
    }

    void take_facets() {
        const float per_y = 1 / geometry_.aspect;
        const auto sample = [&](int a, int b) HWY_ATTR {
            return load(samples_ + (b - 1) * Block::kPitch + a - 1);
        };
        for (int b = 0; b < 4; ++b) {
            for (int a = 0; a < 4; ++a) {
                const Wide here = sample(a, b);
                if (a < 3) store(sample(a + 1, b) - here, rise_x_[b][a]);
                if (b < 3) store((sample(a, b + 1) - here) * per_y, rise_y_[b][a]);
            }
        }
    }

    void take_plane() {
        constexpr int kReach = Reach::kPlane;
        plane_x_ = ((corner_[1] - corner_[0]) + (corner_[3] - corner_[2])) * 0.5f;
        const Wide step_y = ((corner_[2] - corner_[0]) + (corner_[3] - corner_[1])) * 0.5f;
        plane_y_ = step_y * (1 / geometry_.aspect);
        const Wide deepest = min(min(corner_[0], corner_[1] - plane_x_),
                                 min(corner_[2], corner_[3] - plane_x_) - step_y);
        float* out = above_plane_;
        for (int b = -kReach; b <= kReach + 1; ++b) {
            const Wide row = step_y * static_cast<float>(b) + deepest;
            for (int a = -kReach; a <= kReach + 1; ++a, out += kWide) {
                const Wide height = load(samples_ + b * Block::kPitch + a);
                store((height - plane_x_ * static_cast<float>(a)) - row, out);
            }
        }
    }

    const HorizonGeometry& geometry_;
    const float *samples_, *windows_;
    Wide corner_[4], lowest_, plane_x_, plane_y_;
    /// Slopes along x and y of the edges of the 3 x 3 cells around.
    alignas(64) float rise_x_[4][4][kWide];
    alignas(64) float rise_y_[4][4][kWide];
    /// Heights above the lowest parallel to the mean plane through the cell.
    alignas(64) float above_plane_[(2 * Reach::kPlane + 2) * (2 * Reach::kPlane + 2) * kWide];
};

/// The smallest bytes that stand for no less than these slopes.
HWY_INLINE void store_bytes(const Wide& slope, float margin, std::uint8_t* out) {
    constexpr float kRelative = 1 + 1e-5f;
    const Wide safe = max(slope * kRelative + fill(margin), fill(0)) * (1 / Horizon::kStep);
    const hn::Rebind<std::int32_t, Tag> integers;
    const hn::Rebind<std::uint8_t, Tag> bytes;
    const auto store_one = [&](V steps, int n) HWY_ATTR {
        const V whole = hn::Min(hn::Ceil(hn::Sqrt(steps)), hn::Set(kTag, 255.0f));
        hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(integers, whole)), bytes, out + n * kLanes);
    };
    store_one(safe.v0, 0);
    store_one(safe.v1, 1);
    store_one(safe.v2, 2);
    store_one(safe.v3, 3);
}

}  // namespace

void bound_block(const HorizonGeometry& geometry, float margin, Block& block) {
    find_windows(block);
    find_tiles(block);
    climb_far(geometry, block);
    FarSlopes far;
    for (int j = 0; j < block.cells_y; ++j) {
        if (j % Reach::kTile == 0) far.spread(block.near_tiles, j / Reach::kTile);
        for (int i = 0; i < block.cells_x; i += kWide) {
            const Viewers viewers(geometry, block, i, j);
            const Wide height = viewers.lowest() - load(far.lowest + i);
            for (int quadrant = 0; quadrant < 4; ++quadrant) {
                const auto edges = viewers.edges(quadrant);
                for (int k = 0; k < HorizonGeometry::kEdges - 1; ++k) {
                    const int s = HorizonGeometry::sector(quadrant, k);
                    const Wide beyond = load(far.at_lowest[s] + i) + load(far.rise[s] + i) * height;
                    const Wide slope = viewers.bound(edges, k, geometry.sectors[s]);
                    store_bytes(max(slope, beyond), margin,
                                block.bytes.data() + (j * Block::kSectors + s) * Block::kCells + i);
                }
            }
        }
    }
}

}  // namespace asperity::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity::detail {

HWY_EXPORT(bound_block);

void bound_horizon(const HorizonGeometry& geometry, float margin, HorizonBlock& block) {
    HWY_DYNAMIC_DISPATCH(bound_block)(geometry, margin, block);
}

}  // namespace asperity::detail
#endif

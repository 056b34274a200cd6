// SPDX-License-Identifier: Apache-2.0
//
// The first hits of parallel light: no gathers, the way is known (launch_line.h), and one step
// along a line serves all its rays. docs/performance.md, "Light in lines".

#if defined(ASPERITY_WIDE_LAUNCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LAUNCH_INL_H
#undef ASPERITY_WIDE_LAUNCH_INL_H
#else
#define ASPERITY_WIDE_LAUNCH_INL_H
#endif

#include <asperity/tracing/engines/wide/wide_land-inl.h>

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// Vectors of lines that lie side by side.
constexpr int kVectors = kLaunchGroup / static_cast<int>(kLanes);

/// By edge of the round and line: rays that enter the round no higher than this have met the
/// surface before the edge or there. Grows from edge to edge.
using Shade = Floats[LaunchLine::kEdges][kVectors];
constexpr int kLastEdge = LaunchLine::kEdges - 1;

/// Goes along the edges of a round from `begin` on; `at` points to the first line's first vertex.
HWY_INLINE void find_shade(const LaunchLine::Round& round, int begin, const float* at,
                           const float* before, Shade& shade) {
    Floats highest[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k) highest[k] = hn::Load(kFloat, before + k * kLanes);
    for (int n = begin; n < LaunchLine::kEdges; ++n) {
        const LaunchLine::Edge& edge = round.edges[n];
        const Floats of_left = all(edge.share_left), of_right = all(edge.share_right),
                     sunk = all(edge.sunk);
        const float* left = at + edge.left;
        const float* right = at + edge.right;
        for (std::size_t k = 0; k < kVectors; ++k) {
            const Floats height = hn::Add(hn::Mul(hn::LoadU(kFloat, left + k * kLanes), of_left),
                                          hn::Mul(hn::LoadU(kFloat, right + k * kLanes), of_right));
            highest[k] = hn::Max(highest[k], hn::Add(height, sunk));
            shade[n][k] = highest[k];
        }
    }
}

/// The samples that a round of all lines may ask for, with x and y exchanged.
struct SwappedHeights {
    static constexpr int kRows = LaunchLine::kReach + 1;
    static constexpr int kPitch = LaunchLine::kSwappedPitch;
    static_assert(kPitch >= kLaunchGroup + LaunchLine::kReach && kPitch % kLanes == 0);
    static_assert(kPitch <= PaddedHeights::kMargin);
    alignas(64) float values[(kRows + 3) * kPitch];

    /// Of the rows from `begin` to `end`; `from` points to the sample of least x and y.
    HWY_INLINE SwappedHeights(const float* from, std::ptrdiff_t pitch, int begin, int end) {
        const hn::CappedTag<float, 4> four;
        for (std::ptrdiff_t y = 0; y < kPitch; y += kLanes)
            for (std::ptrdiff_t x = begin; x < end; x += 4) {
                const float* corner = from + y * pitch + x;
                const Fields f = fields_of([&](std::size_t lane) HWY_ATTR {
                    return hn::LoadU(four, corner + static_cast<std::ptrdiff_t>(lane) * pitch);
                });
                float* to = values + x * kPitch + y;
                hn::Store(f.a, kFloat, to);
                hn::Store(f.b, kFloat, to + kPitch);
                hn::Store(f.c, kFloat, to + 2 * kPitch);
                hn::Store(f.d, kFloat, to + 3 * kPitch);
            }
    }
};

/// Remainder that is never negative; mostly there is nothing to do.
HWY_INLINE int wrapped(int index, int count) {
    if (index >= 0 && index < count) return index;
    const int rest = index % count;
    return rest < 0 ? rest + count : rest;
}

/// A stripe of lines of rays on its way down.
class Descent {
  public:
    HWY_INLINE Descent(const WideGrid& grid, const PaddedHeights& heights, LaunchLine& line,
                       LaunchStripe& stripe, const CountedFacets& known)
        : grid_(grid),
          heights_(heights),
          line_(line),
          stripe_(stripe),
          known_(known),
          cells_across_(line.swapped() ? heights.cells_y() : heights.cells_x()),
          cells_along_(line.swapped() ? heights.cells_x() : heights.cells_y()) {}

    /// Goes on until all rays have landed, or the line ends: true, or until `room` of them have.
    HWY_INLINE bool go(std::size_t room, LaunchHits& hits, std::size_t& counted) {
        Known known = known_of(line_.round(stripe_.round));
        for (Known next; flies() && stripe_.round < LaunchLine::kMostRounds;
             ++stripe_.round, known = next) {
            if (known_.cells) fetch_known(line_.round(stripe_.round + 2));
            next = known_of(line_.round(stripe_.round + 1));
            if (!next.all) fetch(line_.round(stripe_.round + 1));
            const LaunchLine::Round& round = line_.round(stripe_.round);
            const Place place = place_of(round);
            Shade shade;
            if (known.all) {
                look_at(round, place, kLastEdge, shade);
                counted += count(round, shade[kLastEdge]);
            } else {
                look_at(round, place, 0, shade);
                if (!land(round, place, shade, known, room, hits, counted)) return false;
            }
            // Rays enter the next round lower down
            for (std::size_t k = 0; k < kVectors; ++k)
                hn::Store(hn::Sub(shade[kLastEdge][k], all(round.sunk)), kFloat,
                          stripe_.shade + k * kLanes);
        }
        return true;
    }

  private:
    /// Where a round lies on the tile, in the frame of the line: its lowest vertex, and where the
    /// first line's start would be if its way led there without leaving the tile.
    struct Place {
        int lowest_x, lowest_y, x, y;
    };
    HWY_INLINE Place place_of(const LaunchLine::Round& round) const {
        const int x = wrapped(stripe_.first + round.lowest_x, cells_across_);
        const int y = wrapped(round.lowest_y, cells_along_);
        return {x, y, x - round.lowest_x, y - round.lowest_y};
    }

    HWY_INLINE bool flies() const {
        bool any = false;
        for (std::size_t k = 0; k < kVectors; ++k)
            any = any || !hn::AllFalse(kFloat, left(k, hn::Load(kInt, stripe_.next + k * kLanes)));
        return any;
    }
    /// Lines of a vector that hold a ray of this number.
    HWY_INLINE Mask left(std::size_t k, Ints number) const {
        return hn::RebindMask(kFloat, hn::Lt(number, hn::Load(kInt, stripe_.rays + k * kLanes)));
    }

    /// Brings into the cache what a round, and the paths that go on from it, will look at first:
    /// the far end of it, as the rounds before have brought the rest.
    HWY_INLINE void fetch(const LaunchLine::Round& round) const {
        constexpr int kFloatsOfLine = 16, kBlocksOfLine = 4;
        constexpr int kAcross = kLaunchGroup + LaunchLine::kReach;
        const Place place = place_of(round);
        const int far = place.lowest_y + (line_.goes_up() ? LaunchLine::kReach : 0);
        // Every so many columns and rows
        const auto each = [&](int column, int row, auto fetch_at) HWY_ATTR {
            if (line_.swapped())
                for (int y = place.lowest_x; y <= place.lowest_x + kAcross; y += row)
                    fetch_at(far, y);
            else
                for (int y = place.lowest_y; y <= place.lowest_y + LaunchLine::kReach; y += row)
                    for (int x = place.lowest_x; x < place.lowest_x + kAcross + column; x += column)
                        fetch_at(x, y);
        };
        each(kFloatsOfLine, 1, [&](int x, int y) HWY_ATTR {
            __builtin_prefetch(heights_.origin() + std::ptrdiff_t{y} * heights_.pitch() + x);
        });
        if (!grid_.horizon_pays) return;
        const int shift = grid_.pool_shift;
        each(kBlocksOfLine << shift, 1 << shift, [&](int x, int y) HWY_ATTR {
            const std::ptrdiff_t row = (y - grid_.middle_y) >> shift,
                                 block = (x - grid_.middle_x) >> shift;
            __builtin_prefetch(grid_.horizon +
                               (row * grid_.horizon_pitch + block) * Horizon::kSectors);
        });
    }
    /// The same of the counted facets.
    HWY_INLINE void fetch_known(const LaunchLine::Round& round) const {
        const Place place = place_of(round);
        for (int row = place.lowest_y; row <= place.lowest_y + LaunchLine::kReach; ++row)
            __builtin_prefetch(known_row(row) + place.lowest_x);
    }
    /// From within the tile on; beyond its end it begins again.
    HWY_INLINE const std::uint8_t* known_row(int row) const {
        return known_.cells +
               std::ptrdiff_t{row < cells_along_ ? row : row - cells_along_} * known_.pitch;
    }

    /// Which of the triangles of a round are counted ones: bit n of a line is set if the one before
    /// edge n is.
    struct Known {
        Ints bits[kVectors];
        bool all = false;  ///< of all lines
    };
    HWY_INLINE Known known_of(const LaunchLine::Round& round) const {
        static_assert(LaunchLine::kEdges < 32);
        constexpr std::int32_t kAll = (1 << LaunchLine::kEdges) - 1;
        Known known;
        for (Ints& bits : known.bits) bits = hn::Zero(kInt);
        if (!known_.cells) return known;
        const Place place = place_of(round);
        const hn::Rebind<std::uint8_t, IntTag> bytes;
        for (int n = 0; n < LaunchLine::kEdges; ++n) {
            const LaunchLine::Cell& cell = round.cells[n];
            const std::uint8_t* at = known_row(place.lowest_y + cell.y) + (place.lowest_x + cell.x);
            const Ints bit = all(cell.upper ? CountedFacets::kUpper : CountedFacets::kLower);
            for (std::size_t k = 0; k < kVectors; ++k) {
                const Ints facets = hn::PromoteTo(kInt, hn::LoadU(bytes, at + k * kLanes));
                known.bits[k] =
                    hn::Or(known.bits[k],
                           hn::IfThenElseZero(hn::TestBit(facets, bit), all(std::int32_t{1} << n)));
            }
        }
        known.all = true;
        for (const Ints& bits : known.bits)
            known.all = known.all && hn::AllTrue(kInt, hn::Eq(bits, all(kAll)));
        return known;
    }

    /// Finds the shade of the edges from `begin` on.
    HWY_INLINE void look_at(const LaunchLine::Round& round, const Place& place, int begin,
                            Shade& shade) const {
        const std::ptrdiff_t pitch = heights_.pitch();
        const int right = round.first_x - round.lowest_x, up = round.first_y - round.lowest_y;
        if (line_.swapped()) {
            // The last edge alone asks for two rows at most
            const LaunchLine::Edge& last = round.edges[kLastEdge];
            const int row = up + floor_rows(std::min(last.left, last.right) + right);
            const SwappedHeights part(heights_.origin() + place.lowest_x * pitch + place.lowest_y,
                                      pitch, begin == kLastEdge ? row : 0,
                                      begin == kLastEdge ? row + 2 : SwappedHeights::kRows);
            find_shade(round, begin, part.values + up * SwappedHeights::kPitch + right,
                       stripe_.shade, shade);
        } else {
            const float* lowest = heights_.origin() + place.lowest_y * pitch + place.lowest_x;
            find_shade(round, begin, lowest + up * pitch + right, stripe_.shade, shade);
        }
    }
    /// The row of a sample, seen from the row of the lowest one.
    HWY_INLINE static int floor_rows(int sample) {
        constexpr int kPitch = SwappedHeights::kPitch;
        return sample >= 0 ? sample / kPitch : -((kPitch - 1 - sample) / kPitch);
    }

    /// Counts the rays that land in a round; they need not be told apart.
    HWY_INLINE std::size_t count(const LaunchLine::Round& round, const Floats (&shade)[kVectors]) {
        const hn::Half<FloatTag> half;
        const hn::Rebind<double, decltype(half)> wide;
        const hn::Rebind<std::int32_t, decltype(half)> number;
        alignas(64) float highest[kLaunchGroup];
        for (std::size_t k = 0; k < kVectors; ++k)
            hn::Store(shade[k], kFloat, highest + k * kLanes);
        auto sum = hn::Zero(number);
        for (std::size_t k = 0; k < kLaunchGroup; k += hn::Lanes(half)) {
            const auto next = hn::Load(number, stripe_.next + k);
            const auto above =
                hn::Sub(hn::PromoteTo(wide, hn::Load(half, highest + k)), hn::Set(wide, round.z));
            const auto last = hn::Sub(hn::Mul(above, hn::Load(wide, stripe_.per_spacing + k)),
                                      hn::Load(wide, stripe_.phase + k));
            const auto end =
                hn::Min(hn::Max(hn::Add(last, hn::Set(wide, 1.0)), hn::PromoteTo(wide, next)),
                        hn::PromoteTo(wide, hn::Load(number, stripe_.rays + k)));
            const auto behind = hn::DemoteTo(number, end);
            sum = hn::Add(sum, hn::Sub(behind, next));
            hn::Store(behind, number, stripe_.next + k);
        }
        return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(number, sum)));
    }

    /// Next rays of the lines: the height at which they enter a round, or infinity where all have
    /// landed, and by how much the one behind enters higher.
    struct Rays {
        Floats height[kVectors], step[kVectors];
    };
    HWY_INLINE void enter(const LaunchLine::Round& round, Rays& rays) const {
        const hn::Half<FloatTag> half;
        const hn::Rebind<double, decltype(half)> wide;
        const hn::Rebind<std::int32_t, decltype(half)> number;
        alignas(64) float height[kLaunchGroup], step[kLaunchGroup];
        for (std::size_t k = 0; k < kLaunchGroup; k += hn::Lanes(half)) {
            const auto n = hn::PromoteTo(wide, hn::Load(number, stripe_.next + k));
            const auto spacing = hn::Load(wide, stripe_.spacing + k);
            const auto above = hn::Mul(hn::Add(hn::Load(wide, stripe_.phase + k), n), spacing);
            hn::Store(hn::DemoteTo(half, hn::Add(above, hn::Set(wide, round.z))), half, height + k);
            hn::Store(hn::DemoteTo(half, spacing), half, step + k);
        }
        for (std::size_t k = 0; k < kVectors; ++k) {
            rays.height[k] = select(left(k, hn::Load(kInt, stripe_.next + k * kLanes)),
                                    hn::Load(kFloat, height + k * kLanes), none());
            rays.step[k] = hn::Load(kFloat, step + k * kLanes);
        }
    }
    HWY_INLINE static Floats none() { return all(std::numeric_limits<float>::infinity()); }

    /// Lands rays, one of each line at a time, as long as any meets the surface in the round: true,
    /// or until there is no room.
    HWY_INLINE bool land(const LaunchLine::Round& round, const Place& place, const Shade& shade,
                         const Known& known, std::size_t room, LaunchHits& hits,
                         std::size_t& counted) {
        Rays rays;
        enter(round, rays);
        const bool swapped = line_.swapped();
        const Ints first_cell =
            all(swapped ? pack_vertex(place.y - grid_.middle_x, place.x - grid_.middle_y)
                        : pack_vertex(place.x - grid_.middle_x, place.y - grid_.middle_y));
        const Ints first_triangle =
            all(static_cast<std::int32_t>(stripe_.round) * LaunchLine::kEdges);
        for (bool landing = true; landing;) {
            if (hits.count + kLaunchGroup > room) return false;
            landing = false;
            for (std::size_t k = 0; k < kVectors; ++k) {
                const Mask low = hn::Le(rays.height[k], shade[kLastEdge][k]);
                if (hn::AllFalse(kFloat, low)) continue;
                landing = true;
                const Ints edge = first_edge(shade, k, rays.height[k]);
                const Mask sure = hn::And(
                    low, hn::RebindMask(kFloat, hn::TestBit(hn::Shr(known.bits[k], edge), all(1))));
                counted += hn::CountTrue(kFloat, sure);
                const Packer pack(hn::AndNot(sure, low));
                const Ints lane = counting_from(static_cast<std::int32_t>(k * kLanes));
                pack(hn::Add(first_triangle, edge), hits.triangle, hits.count);
                pack(
                    swapped ? hn::Add(first_cell, hn::ShiftLeft<16>(lane)) : plus(first_cell, lane),
                    hits.cell, hits.count);
                pack(rays.height[k], hits.z, hits.count);
                hits.count += pack.count;

                // The rays behind them come next
                std::int32_t* next = stripe_.next + k * kLanes;
                const Ints behind = hn::Add(hn::Load(kInt, next), only(low, all(1)));
                hn::Store(behind, kInt, next);
                rays.height[k] = select(
                    low, select(left(k, behind), hn::Add(rays.height[k], rays.step[k]), none()),
                    rays.height[k]);
            }
        }
        return true;
    }

    /// The first edge, or the last, at which rays that enter at these heights are below the
    /// surface.
    HWY_INLINE static Ints first_edge(const Shade& shade, std::size_t k, Floats height) {
        Ints edge = hn::Zero(kInt);
        for (int n = 0; n < kLastEdge; ++n)
            edge = select(hn::Gt(height, shade[n][k]), hn::Add(edge, all(1)), edge);
        return edge;
    }

    const WideGrid& grid_;
    const PaddedHeights& heights_;
    LaunchLine& line_;
    LaunchStripe& stripe_;
    const CountedFacets& known_;
    const int cells_across_, cells_along_;
};

bool LaunchInLines(const WideGrid& grid, const PaddedHeights& heights, LaunchLine& line,
                   LaunchStripe& stripe, const CountedFacets& known, std::size_t room,
                   LaunchHits& hits, std::size_t& counted) {
    static_assert(kLaunchGroup + LaunchLine::kReach <= PaddedHeights::kMargin);
    return Descent(grid, heights, line, stripe, known).go(room, hits, counted);
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

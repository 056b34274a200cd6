// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace asperity {

/// What light is sorted into.
///
/// A *place* is a cell of the detector on one side of the surface: place = side * cells + cell. A
/// *value* is one element of one channel: value = channel * elements + element. Element 0 is the
/// energy; further ones, of polarised light, are signed and follow the same units.
struct SumShape {
    std::size_t cells = 1;     ///< of the detector, on one side
    std::size_t sides = 1;     ///< 1: what is reflected; 2: and what is transmitted
    std::size_t channels = 1;  ///< wavelengths or colours
    std::size_t elements = 1;  ///< 1: energy; 16: Mueller matrices
    std::size_t orders = 1;    ///< bounce orders kept apart by cell
    std::size_t bounces = 1;   ///< bounce orders kept apart in the sums over all cells
    std::size_t columns = 1;   ///< cells are rows of so many, one after the other

    std::size_t places() const { return sides * cells; }
    std::size_t values() const { return channels * elements; }
    bool operator==(const SumShape&) const = default;
};

/// Where each ray of a kind sends its energy in the mean, for engines that know it.
struct SpreadLight {
    /// Energy[k * values + value] goes to places[k], in ascending order; what is missing to a whole
    /// ray is absorbed.
    SpreadLight(const SumShape& shape, std::vector<std::uint32_t> places,
                std::vector<std::uint64_t> energy);

    std::vector<std::uint32_t> places;
    std::vector<std::uint64_t> energy;
    std::vector<std::uint64_t> reflected;  ///< sum over the places: [side * values + value]
};

/// Where the energy of one batch of rays of one layer went, in integers (core/energy.h): what an
/// engine fills, and the working memory of one thread. Sums of integers do not depend on the order
/// of the calls, so batches come out the same whoever traces them.
///
/// Weights of paths are in [0, 1] for element 0 and in [-1, 1] for others, one array a value,
/// indexed by path; none for perfect mirrors, whose rays keep all their energy. At most 2^20 rays.
class BatchSums {
  public:
    using Weights = std::span<const float* const>;  ///< [value], by path

    explicit BatchSums(const SumShape& shape);

    const SumShape& shape() const { return shape_; }

    /// `count` paths left to `side` into cells[k] after `order` >= 1 reflections; paths[k] says
    /// which of the weights is theirs.
    void escape(std::size_t side, int order, const std::int32_t* cells, const std::int32_t* paths,
                std::size_t count, Weights weights);
    /// `count` rays left after one reflection, each spread as `light` says: the same of all batches
    /// of a layer. They cost nothing by place until their layer is settled.
    void escape_spread(std::uint64_t count, std::shared_ptr<const SpreadLight> light);
    /// `count` paths would have needed one reflection too many, or never ended.
    void truncate(const std::int32_t* paths, std::size_t count, Weights weights) {
        settle(truncated_, paths, count, weights);
    }
    /// `count` rays never met a facet.
    void truncate_launched(std::uint64_t count);
    /// `count` paths left through the side of a finite patch.
    void lose_at_edge(const std::int32_t* paths, std::size_t count, Weights weights) {
        settle(edge_, paths, count, weights);
    }
    /// Shares what paths have brought to `columns` places, one row after the other, out among them:
    /// where the light does not tell one azimuth from another. Once, when all paths have left.
    void share_rows(std::size_t columns);
    /// Adds what other rays of the same surface and light have brought, where both together are at
    /// most 2^20.
    BatchSums& operator+=(const BatchSums& other);
    /// Adds to totals[place * values + value] what came there over all orders, spread light
    /// included, or takes it away.
    void add_to(std::vector<std::uint64_t>& totals) const { for_totals(totals, 1); }
    void take_from(std::vector<std::uint64_t>& totals) const { for_totals(totals, -1); }
    /// Energy that left to all places: [side * values + value].
    std::vector<std::uint64_t> escaped() const;
    /// Forgets everything; cost: the cells touched, and their neighbours.
    void clear();

    std::uint64_t rays = 0, segments = 0, reflections = 0, stuck = 0;

  private:
    friend struct LayerSums;
    static constexpr std::size_t kBlock = 16;  ///< places
    /// A block that holds energy of an order has that bit; from the last one on they share it.
    static std::uint8_t bit_of(std::size_t order) {
        return static_cast<std::uint8_t>(1u << std::min<std::size_t>(order, 7));
    }
    /// Calls work(begin, end, bits) for blocks that hold energy, with indices of a place's first
    /// value.
    template <class Work>
    void for_touched(Work work) const;
    void for_totals(std::vector<std::uint64_t>& totals, int sign) const;
    /// From numbers of paths to their energies.
    void weigh();
    /// Books the paths' energy under `account` and the rest of it as absorbed.
    void settle(std::vector<std::uint64_t>& account, const std::int32_t* paths, std::size_t count,
                Weights weights);
    /// What paths have in common that leave together.
    struct Leaving {
        std::size_t side, bounce;
        const std::int32_t *cells, *paths;
        std::size_t count;
        Weights weights;
    };
    /// Books their energy, in `kCount` values from `first` on, by cell, `sums`, and by bounce.
    template <std::size_t kCount>
    void escape_weighted(const Leaving& leaving, std::size_t first, std::uint64_t* sums);
    std::uint64_t& by_bounce(std::size_t side, std::size_t value, std::size_t bounce) {
        return escaped_by_bounce_[(side * shape_.values() + value) * shape_.bounces + bounce];
    }

    SumShape shape_;
    // Made when they are first needed, and one of them is used at a time: energies of paths that
    // have weights, [(order * places + place) * values + value], or numbers of those that have lost
    // nothing
    std::vector<std::uint64_t> energy_;
    std::vector<std::uint32_t> count_;
    bool counted_ = true;       ///< in numbers, as long as no energy has come
    std::uint64_t spread_ = 0;  ///< rays of escape_spread, which are not in these
    std::shared_ptr<const SpreadLight> spread_light_;
    std::vector<std::uint8_t> touched_;  ///< by block: bits of the orders of which it holds energy
    std::vector<std::uint64_t> escaped_by_bounce_;  ///< [(side * values + value) * bounces + order]
    std::vector<std::uint64_t> absorbed_, truncated_, edge_;  ///< [channel]
};

/// Shares the sum of every `stride`-th of `count` values out among them: all alike, the first ones
/// a unit more if they must.
void share_evenly(std::uint64_t* values, std::size_t count, std::size_t stride);

template <class Work>
void BatchSums::for_touched(Work work) const {
    const std::size_t values = shape_.values(), places = shape_.places();
    for (std::size_t block = 0; block < touched_.size(); ++block)
        if (touched_[block])
            work(block * kBlock * values, std::min((block + 1) * kBlock, places) * values,
                 touched_[block]);
}

}  // namespace asperity

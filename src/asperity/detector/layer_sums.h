// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/batch_set.h>
#include <asperity/detector/batch_sums.h>
#include <asperity/detector/group_sums.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace asperity {

/// What batches of one layer add up to: sums of their energies, and sums of their squares, from
/// which the standard errors follow. A value: batches, and sums of other batches of the same layer,
/// may be added in any order, to the same bits, each batch once.
///
/// A batch may have fewer rays than the largest one; for the errors it is scaled to that one's.
/// Energies of elements above 0 are signed, in two's complement.
struct LayerSums {
    __extension__ using Wide = unsigned __int128;
    /// A sum over batches and the sum of its squares, each batch scaled to the largest one's rays.
    struct Spread {
        std::uint64_t sum = 0;
        Wide squares = 0;
        bool operator==(const Spread&) const = default;
    };

    LayerSums() = default;
    /// No batch yet; `largest` rays are in the largest one.
    LayerSums(const SumShape& shape, std::uint64_t largest);

    SumShape shape;
    std::uint64_t largest_batch = 0;  ///< rays
    BatchSet done;                    ///< the batches in here
    std::uint64_t rays = 0, segments = 0, reflections = 0, stuck = 0;
    std::vector<std::uint64_t> energy;             ///< [(order * places + place) * values + value]
    std::vector<std::uint64_t> escaped_by_bounce;  ///< [(side * values + value) * bounces + order]
    std::vector<std::uint64_t> absorbed, truncated, edge;  ///< [channel]

    /// Squares of what goes into each place over all orders: [place * values + value].
    std::vector<Wide> squares;
    /// What scaling adds to the sums over all orders, likewise; empty while all batches have as
    /// many rays as the largest one.
    std::vector<std::uint64_t> stretched;
    /// What of the energy over all orders was spread (BatchSums::escape_spread) and not brought by
    /// paths, likewise; empty while nothing was.
    std::vector<std::uint64_t> exact;
    std::vector<std::uint32_t> reached;  ///< batches with paths into the place, likewise
    std::vector<Spread> bounces;         ///< of escaped_by_bounce
    std::vector<Spread> albedo;          ///< of the sum over its orders: [side * values + value]
    /// The same by the age of batches, which is that of batch 0, 1, 2 to 3, 4 to 7 and so on:
    /// [(age * sides + side) * values + value]. So any first 2^k batches are known by themselves.
    std::vector<Spread> albedo_by_age;
    GroupSums groups;

    static constexpr std::size_t kAges = 33;

    /// Squares of the difference between the halves of each batch, like `squares` and `albedo`:
    /// that of their rays alone, where batches have surfaces of their own. Empty without halves.
    struct Halves {
        std::vector<Wide> cells, albedo;
        bool operator==(const Halves&) const = default;
    };
    Halves halves;

    std::uint64_t batches() const { return done.count(); }

    /// Throws Error(Usage) if the batch of this number is in here already.
    void add(std::uint64_t number, const BatchSums& batch);
    /// The same for a batch of two halves of as many rays each on one surface; `first` holds both
    /// afterwards.
    void add_halves(std::uint64_t number, BatchSums& first, const BatchSums& second);
    /// Settles both. Throws Error(Usage) if the shapes or the largest batches differ, as they are
    /// not of one layer, or if both have a batch in common: then nothing is added.
    LayerSums& operator+=(const LayerSums& other);
    /// Of settled sums.
    bool operator==(const LayerSums&) const = default;

    /// Adds what batches spread (BatchSums::escape_spread), which waits until someone asks: so a
    /// batch costs only the places that its paths reached. Whenever it is called, the bits are the
    /// same. Until then `energy`, `squares` and what is told from them lack it.
    void settle();
    bool settled() const { return waiting_.count == 0; }

    /// Mean over the batches as a fraction of the launched energy, and its standard error; infinite
    /// for a single batch.
    struct Estimate {
        double mean = 0, error = 0;
        double relative() const { return mean > 0 ? error / mean : 0.0; }
    };
    Estimate estimate(const Spread& spread) const { return estimate(spread, batches()); }
    Estimate estimate(const Spread& spread, std::uint64_t of_batches) const;
    /// Of place k / values, value k % values, over all orders, by its batches alone: results have
    /// the errors of cell_estimates(). Of settled sums.
    Estimate cell(std::size_t k) const;
    /// Energy that paths brought there, in any order. Of settled sums.
    std::uint64_t followed(std::size_t k) const {
        return over_all_orders(k) - (exact.empty() ? 0 : exact[k]);
    }
    /// Relative standard errors of energies: the worst channel's albedo; and the largest one among
    /// the cells that, strongest first, carry 90 % of it. Of settled sums.
    struct Errors {
        double albedo = 0, cells = 0;
    };
    Errors relative_errors() const;
    /// What the first 2^k batches alone, all of which are in here, tell of relative_errors().albedo
    /// with so many batches as there are.
    double relative_error_told_by_first(unsigned k) const;

  private:
    std::uint64_t scaled(std::uint64_t energy, std::uint64_t of_rays) const;
    std::uint64_t over_all_orders(std::size_t k) const;
    void add_spreads(std::uint64_t number, const BatchSums& batch);
    /// Adds the batch's sums by place; `paths` in units of so much energy.
    template <std::uint64_t kUnit, class Value>
    void add_places(std::size_t group, const BatchSums& batch, const std::vector<Value>& paths);
    /// The same for a batch with fewer rays than the largest one, and what it spreads at once, as
    /// both are scaled together.
    template <std::uint64_t kUnit, class Value>
    void add_scaled_places(std::size_t group, const BatchSums& batch,
                           const std::vector<Value>& paths);

    /// n rays spread f each into a place where e came by paths, and over batches the sum of
    /// (e + f n)^2 = e^2 + 2 f e n + f^2 n^2, all exact.
    struct Waiting {
        std::shared_ptr<const SpreadLight> light;
        std::uint64_t count = 0;              ///< sum of n
        Wide squares = 0;                     ///< sum of n^2
        std::vector<Wide> products;           ///< sum of e n, like LayerSums::squares
        std::vector<std::uint64_t> of_group;  ///< sums of n, [group]
        bool operator==(const Waiting&) const = default;
    };
    Waiting waiting_;
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/energy.h>
#include <asperity/gonio/measurement.h>
#include <asperity/tracing/engines/wide/wide.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// Where the energy of rays goes that are only counted (gonio/known_facets.h): the same for each.
class CountedLight {
  public:
    CountedLight() = default;
    /// From how much goes into each cell, [cell * channels + channel], of `total` in each channel.
    CountedLight(const std::vector<std::uint64_t>& sums, std::size_t channels, std::uint64_t total);

    /// Cells that take a share, in order.
    const std::vector<std::uint32_t>& cells() const { return cells_; }
    /// Energy of a ray that goes into cells()[k].
    std::uint64_t energy(std::size_t k, std::size_t channel) const {
        return energy_[k * reflected_.size() + channel];
    }
    /// Energy of a ray that goes into all cells together; the rest of it is absorbed.
    std::uint64_t reflected(std::size_t channel) const { return reflected_[channel]; }

  private:
    std::vector<std::uint32_t> cells_;
    std::vector<std::uint64_t> energy_;     ///< [k * channels + channel]
    std::vector<std::uint64_t> reflected_;  ///< per channel
};

/// Where the energy of one batch of rays went, in integers; the working memory of one thread.
class BatchSums {
  public:
    BatchSums(int cells, int channels, int orders, int bounces);

    /// Weights of paths: [channel], by path; none for perfect mirrors, whose rays keep all energy.
    using Weights = std::vector<PerPath<float>>;

    /// `count` paths left into cells[k] after `order` >= 1 reflections.
    void escape(const PerPath<std::int32_t>& cells, const PerPath<std::int32_t>& paths,
                std::size_t count, int order, const Weights& weights);
    /// `count` rays left as `light` says, after one reflection.
    void escape_counted(std::uint64_t count, const CountedLight& light);
    void truncate(const PerPath<std::int32_t>& paths, std::size_t count, const Weights& weights) {
        settle(truncated_, paths, count, weights);
    }
    /// `count` rays never met a facet.
    void truncate_launched(std::uint64_t count) {
        for (std::uint64_t& energy : truncated_) energy += count * kRayEnergy;
        stuck += count;
    }
    void lose_at_edge(const PerPath<std::int32_t>& paths, std::size_t count,
                      const Weights& weights) {
        settle(edge_, paths, count, weights);
    }
    /// Forgets everything; cost: the cells touched, and their neighbours.
    void clear();

    std::uint64_t rays = 0, segments = 0, reflections = 0, stuck = 0;

  private:
    friend class LayerSums;
    static constexpr std::size_t kBlock = 16;  ///< cells
    /// A block that holds energy of an order has that bit; from the last one on they share it.
    static std::uint8_t bit_of(std::size_t order) {
        return static_cast<std::uint8_t>(1u << std::min<std::size_t>(order, 7));
    }
    /// Calls work(begin, end, bits) for blocks of cells that hold energy, with places of a cell's
    /// first channel.
    template <class Work>
    void for_touched(Work work) const;
    /// Books the paths' energy under `account` and the rest of it as absorbed.
    void settle(std::vector<std::uint64_t>& account, const PerPath<std::int32_t>& paths,
                std::size_t count, const Weights& weights);
    /// Books the energy of paths that left, in `kCount` channels from `first` on, by cell, `sums`,
    /// and by bounce.
    template <std::size_t kCount>
    void escape_weighted(const PerPath<std::int32_t>& cells, const PerPath<std::int32_t>& paths,
                         std::size_t count, std::size_t bounce, const Weights& weights,
                         std::size_t first, std::uint64_t* sums);

    std::size_t cells_, channels_, orders_, bounces_;
    // One of these, made when it is first needed: energies of paths that have weights, [(order *
    // cells + cell) * channels + channel], or numbers of those that have lost nothing
    std::vector<std::uint64_t> energy_;
    std::vector<std::uint32_t> count_;
    std::vector<std::uint8_t> touched_;  ///< by block: bits of the orders of which it holds energy
    std::uint64_t counted_ = 0;          ///< rays of escape_counted, which are not in there
    std::vector<std::uint64_t> escaped_by_bounce_;  ///< [channel * bounces + order]
    std::vector<std::uint64_t> absorbed_, truncated_, edge_;
};

/// The sums of all batches of a layer, and from their spread the standard errors. All integers:
/// batches may be added in any order.
class LayerSums {
  public:
    /// `light` is that of the batches' counted rays and outlives the sums; null: there are none.
    LayerSums(int cells, int channels, int orders, int bounces, std::uint64_t largest_batch,
              const CountedLight* light = nullptr);

    void add(const BatchSums& batch);
    int batches() const { return batches_; }
    std::uint64_t rays() const { return rays_; }

    /// Writes sums and standard errors into `layer`. Throws std::logic_error if a single unit of
    /// energy is unaccounted for.
    void write(Layer& layer) const;
    /// Relative standard errors: the worst channel's albedo; and the largest one among the cells
    /// that, strongest first, carry 90 % of the energy.
    struct Errors {
        double albedo = 0, cells = 0;
    };
    Errors relative_errors() const;

  private:
    __extension__ using Wide = unsigned __int128;
    /// A sum over batches and the sum of its squares, each batch scaled to the largest one's rays.
    struct Spread {
        std::uint64_t sum = 0;
        Wide squares = 0;
        void add(std::uint64_t scaled) {
            sum += scaled;
            squares += Wide{scaled} * scaled;
        }
    };
    /// For what goes into each cell and channel beside the counted rays, sums of squares and of
    /// products with their number: [cell * channels + channel].
    struct CellSpreads {
        std::vector<Wide> squares;
        /// What scaling adds to the sums, which are those of the energy; none if all batches have
        /// as many rays as the largest one.
        std::vector<std::uint64_t> stretched;
        std::vector<Wide> by_counted;  ///< none if there are no counted rays
    };
    /// Mean over the batches as a fraction of the launched energy, and its standard error.
    struct Estimate {
        double mean = 0, error = 0;
        double relative() const { return mean > 0 ? error / mean : 0.0; }
    };
    Estimate estimate(const Spread& spread) const;
    /// Of place k of the spreads, with the sum of its energies, and with the counted rays' share of
    /// it, `each` of them; `of_counted` is the excess of their number.
    Estimate estimate(std::size_t k, std::uint64_t sum, std::uint64_t each,
                      double of_counted) const;
    /// From a sum over the K batches and its excess K sum e^2 - (sum e)^2.
    Estimate estimate(double sum, double excess) const;
    /// K times a sum of products less the product of the sums.
    double excess(Wide products, std::uint64_t a, std::uint64_t b) const;
    double excess(const Spread& spread) const {
        return excess(spread.squares, spread.sum, spread.sum);
    }
    std::uint64_t scaled(std::uint64_t energy, std::uint64_t rays) const;
    /// Adds the batch's `values` by cell, each in units of so much energy; `counted` rays of it
    /// were only counted, scaled.
    template <std::uint64_t kUnit, class Value>
    void add_cells(const BatchSums& batch, const std::vector<Value>& values, std::uint64_t counted);
    /// Calls work(cell, k) for each cell, where k tells its place in light_->cells(), or -1.
    template <class Work>
    void for_cells(Work work) const;
    std::uint64_t counted_energy(std::ptrdiff_t k, std::size_t channel) const {
        return k < 0 ? 0 : light_->energy(static_cast<std::size_t>(k), channel);
    }

    std::size_t cells_, channels_, orders_, bounces_;
    std::uint64_t largest_batch_;
    int batches_ = 0;
    std::uint64_t rays_ = 0, segments_ = 0, reflections_ = 0, stuck_ = 0;
    std::vector<std::uint64_t> energy_;  ///< [(order * cells + cell) * channels + channel]
    std::vector<std::uint64_t> escaped_by_bounce_, absorbed_, truncated_, edge_;
    CellSpreads cell_spread_;
    std::vector<Spread> bounce_spread_;  ///< [channel * bounces + order]
    std::vector<Spread> albedo_spread_;  ///< per channel
    const CountedLight* light_;
    std::uint64_t counted_ = 0;  ///< rays
    Spread counted_spread_;      ///< of their number, in units of 2^-kCountShift
};

}  // namespace asperity

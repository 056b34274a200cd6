// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/tracing/wide.h>

#include <cstdint>
#include <vector>

namespace asperity {

/// Where the energy of one batch of rays went, in integers; the working memory of one thread.
class BatchSums {
  public:
    BatchSums(int cells, int channels, int orders, int bounces);

    /// Weights of paths: [channel], by path; none for perfect mirrors, whose rays keep all energy.
    using Weights = std::vector<PerPath<float>>;

    /// `count` paths left into cells[k] after `order` >= 1 reflections.
    void escape(const PerPath<std::int32_t>& cells, const PerPath<std::int32_t>& paths,
                std::size_t count, int order, const Weights& weights);
    void truncate(const PerPath<std::int32_t>& paths, std::size_t count, const Weights& weights) {
        settle(truncated_, paths, count, weights);
    }
    void lose_at_edge(const PerPath<std::int32_t>& paths, std::size_t count,
                      const Weights& weights) {
        settle(edge_, paths, count, weights);
    }
    /// Forgets everything; cost: the cells touched.
    void clear();

    std::uint64_t rays = 0, segments = 0, reflections = 0, stuck = 0;

  private:
    friend class LayerSums;
    /// Remembers that a cell holds energy.
    void touch(std::size_t cell);
    /// Books the paths' energy under `account` and the rest of it as absorbed.
    void settle(std::vector<std::uint64_t>& account, const PerPath<std::int32_t>& paths,
                std::size_t count, const Weights& weights);

    std::size_t cells_, channels_, orders_, bounces_;
    std::vector<std::uint64_t> energy_;   ///< [(cell * orders + order) * channels + channel]
    std::vector<std::uint32_t> touched_;  ///< cells that hold energy
    std::vector<std::uint8_t> is_touched_;
    std::vector<std::uint64_t> escaped_by_bounce_;  ///< [channel * bounces + order]
    std::vector<std::uint64_t> absorbed_, truncated_, edge_;
};

/// The sums of all batches of a layer, and from their spread the standard errors. All integers:
/// batches may be added in any order.
class LayerSums {
  public:
    LayerSums(int cells, int channels, int orders, int bounces, std::uint64_t largest_batch);

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
    /// Standard error of the mean over batches, as a fraction of the launched energy.
    double standard_error(const Spread& spread) const;
    double relative_error(const Spread& spread) const;
    std::uint64_t scaled(std::uint64_t energy, std::uint64_t rays) const;

    std::size_t cells_, channels_, orders_, bounces_;
    std::uint64_t largest_batch_;
    int batches_ = 0;
    std::uint64_t rays_ = 0, segments_ = 0, reflections_ = 0, stuck_ = 0;
    std::vector<std::uint64_t> energy_;  ///< as in BatchSums
    std::vector<std::uint64_t> escaped_by_bounce_, absorbed_, truncated_, edge_;
    std::vector<Spread> cell_spread_;    ///< [cell * channels + channel]
    std::vector<Spread> bounce_spread_;  ///< [channel * bounces + order]
    std::vector<Spread> albedo_spread_;  ///< per channel
};

}  // namespace asperity

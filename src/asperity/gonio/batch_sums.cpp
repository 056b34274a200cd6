// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_sums.h>

#include <asperity/core/energy.h>
#include <asperity/optics/fresnel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace asperity {

namespace {

std::size_t index(int a) {
    return static_cast<std::size_t>(a);
}

/// Cells are fetched so many paths ahead.
constexpr std::size_t kAhead = 48;

/// Numbers of counted rays are summed in units of 2^-kCountShift, as batches are scaled.
constexpr int kCountShift = 16;

void add_to(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& more) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
}

}  // namespace

CountedLight::CountedLight(const std::vector<std::uint64_t>& sums, std::size_t channels,
                           std::uint64_t total)
    : reflected_(channels) {
    // The sums so far are rounded, not each by itself, so that nothing is lost
    std::vector<std::uint64_t> so_far(channels);
    for (std::size_t cell = 0; cell < sums.size() / channels; ++cell) {
        const std::uint64_t* sum = &sums[cell * channels];
        if (std::all_of(sum, sum + channels, [](std::uint64_t x) { return x == 0; })) continue;
        cells_.push_back(static_cast<std::uint32_t>(cell));
        for (std::size_t c = 0; c < channels; ++c) {
            so_far[c] += sum[c];
            const double share = static_cast<double>(so_far[c]) / static_cast<double>(total);
            const std::uint64_t rounded = to_energy(share);
            energy_.push_back(rounded - reflected_[c]);
            reflected_[c] = rounded;
        }
    }
}

BatchSums::BatchSums(int cells, int channels, int orders, int bounces)
    : cells_(index(cells)),
      channels_(index(channels)),
      orders_(index(orders)),
      bounces_(index(bounces)),
      touched_((cells_ + kBlock - 1) / kBlock),
      escaped_by_bounce_(channels_ * bounces_),
      absorbed_(channels_),
      truncated_(channels_),
      edge_(channels_) {}

void BatchSums::escape(const PerPath<std::int32_t>& cells, const PerPath<std::int32_t>& paths,
                       std::size_t count, int order, const Weights& weights) {
    const std::size_t bounce = index(order - 1), kept = std::min(bounce, orders_ - 1);
    const std::uint8_t bit = bit_of(kept);
    std::uint8_t* touched = touched_.data();
    if (!weights.empty()) {
        for (std::size_t k = 0; k < count; ++k) touched[index(cells[k]) / kBlock] |= bit;
        energy_.resize(orders_ * cells_ * channels_);
        std::uint64_t* sums = energy_.data() + kept * cells_ * channels_;
        // Colours at once, as this takes a good part of the time of a metal
        std::size_t c = 0;
        for (; c + 3 <= channels_; c += 3)
            escape_weighted<3>(cells, paths, count, bounce, weights, c, sums + c);
        for (; c < channels_; ++c)
            escape_weighted<1>(cells, paths, count, bounce, weights, c, sums + c);
        return;
    }
    count_.resize(orders_ * cells_);
    std::uint32_t* counts = count_.data() + kept * cells_;
    for (std::size_t k = 0; k < count; ++k) {
        __builtin_prefetch(counts + cells[std::min(k + kAhead, count - 1)], 1);
        const std::size_t cell = index(cells[k]);
        ++counts[cell];
        touched[cell / kBlock] |= bit;
    }
    escaped_by_bounce_[bounce] += count * kRayEnergy;
}

template <std::size_t kCount>
void BatchSums::escape_weighted(const PerPath<std::int32_t>& cells,
                                const PerPath<std::int32_t>& paths, std::size_t count,
                                std::size_t bounce, const Weights& weights, std::size_t first,
                                std::uint64_t* sums) {
    // Plain pointers, and copies of what does not change, for the innermost loop
    std::array<const float*, kCount> weight;
    for (std::size_t c = 0; c < kCount; ++c) weight[c] = weights[first + c].values;
    const std::size_t channels = channels_;
    std::array<std::uint64_t, kCount> total{};
    for (std::size_t k = 0; k < count; ++k) {
        __builtin_prefetch(sums + index(cells[std::min(k + kAhead, count - 1)]) * channels, 1);
        std::uint64_t* sum = sums + index(cells[k]) * channels;
        for (std::size_t c = 0; c < kCount; ++c) {
            const std::uint64_t energy = to_energy(double{weight[c][paths[k]]});
            sum[c] += energy;
            total[c] += energy;
        }
    }
    for (std::size_t c = 0; c < kCount; ++c) {
        escaped_by_bounce_[(first + c) * bounces_ + bounce] += total[c];
        absorbed_[first + c] += count * kRayEnergy - total[c];
    }
}

void BatchSums::escape_counted(std::uint64_t count, const CountedLight& light) {
    if (count == 0) return;
    counted_ += count;
    for (std::size_t c = 0; c < channels_; ++c) {
        escaped_by_bounce_[c * bounces_] += count * light.reflected(c);
        absorbed_[c] += count * (kRayEnergy - light.reflected(c));
    }
}

template <class Work>
void BatchSums::for_touched(Work work) const {
    for (std::size_t block = 0; block < touched_.size(); ++block)
        if (touched_[block])
            work(block * kBlock * channels_, std::min((block + 1) * kBlock, cells_) * channels_,
                 touched_[block]);
}

void BatchSums::settle(std::vector<std::uint64_t>& account, const PerPath<std::int32_t>& paths,
                       std::size_t count, const Weights& weights) {
    if (weights.empty()) {
        account[0] += count * kRayEnergy;
        return;
    }
    for (std::size_t c = 0; c < channels_; ++c)
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint64_t energy = to_energy(double{weights[c][index(paths[k])]});
            account[c] += energy;
            absorbed_[c] += kRayEnergy - energy;
        }
}

void BatchSums::clear() {
    const auto forget = [&](auto& values) {
        if (values.empty()) return;
        for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
            for (std::size_t o = 0; o < orders_; ++o)
                if (bits & bit_of(o))
                    std::fill_n(values.data() + o * cells_ * channels_ + begin, end - begin, 0u);
        });
    };
    forget(energy_);
    forget(count_);
    std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
    for (auto* account : {&escaped_by_bounce_, &absorbed_, &truncated_, &edge_})
        std::fill(account->begin(), account->end(), std::uint64_t{0});
    rays = segments = reflections = stuck = counted_ = 0;
}

LayerSums::LayerSums(int cells, int channels, int orders, int bounces, std::uint64_t largest_batch,
                     const CountedLight* light)
    : cells_(index(cells)),
      channels_(index(channels)),
      orders_(index(orders)),
      bounces_(index(bounces)),
      largest_batch_(largest_batch),
      energy_(orders_ * channels_ * cells_),
      escaped_by_bounce_(channels_ * bounces_),
      absorbed_(channels_),
      truncated_(channels_),
      edge_(channels_),
      bounce_spread_(channels_ * bounces_),
      albedo_spread_(channels_),
      light_(light) {
    cell_spread_.squares.resize(channels_ * cells_);
    if (light && !light->cells().empty()) cell_spread_.by_counted.resize(channels_ * cells_);
}

std::uint64_t LayerSums::scaled(std::uint64_t energy, std::uint64_t rays) const {
    if (rays == largest_batch_) return energy;
    return static_cast<std::uint64_t>(Wide{energy} * largest_batch_ / rays);
}

void LayerSums::add(const BatchSums& b) {
    ++batches_;
    rays_ += b.rays;
    segments_ += b.segments;
    reflections_ += b.reflections;
    stuck_ += b.stuck;
    add_to(absorbed_, b.absorbed_);
    add_to(truncated_, b.truncated_);
    add_to(edge_, b.edge_);
    add_to(escaped_by_bounce_, b.escaped_by_bounce_);
    counted_ += b.counted_;
    const std::uint64_t counted = scaled(b.counted_ << kCountShift, b.rays);
    counted_spread_.add(counted);

    for (std::size_t k = 0; k < bounce_spread_.size(); ++k)
        bounce_spread_[k].add(scaled(b.escaped_by_bounce_[k], b.rays));
    for (std::size_t c = 0; c < channels_; ++c) {
        const auto* first = &b.escaped_by_bounce_[c * bounces_];
        albedo_spread_[c].add(
            scaled(std::accumulate(first, first + bounces_, std::uint64_t{0}), b.rays));
    }
    if (!b.energy_.empty()) add_cells<1>(b, b.energy_, counted);
    if (!b.count_.empty()) add_cells<kRayEnergy>(b, b.count_, counted);
}

template <std::uint64_t kUnit, class Value>
void LayerSums::add_cells(const BatchSums& b, const std::vector<Value>& values,
                          std::uint64_t counted) {
    CellSpreads& s = cell_spread_;
    const bool smaller = b.rays != largest_batch_;
    if (smaller && s.stretched.empty()) s.stretched.resize(channels_ * cells_);
    Wide* squares = s.squares.data();
    Wide* by_counted = s.by_counted.empty() ? nullptr : s.by_counted.data();
    std::array<std::uint64_t, BatchSums::kBlock * kMaxChannels> total;
    b.for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
        // Orders by themselves, and all together
        const std::size_t count = end - begin;
        std::fill_n(total.begin(), count, std::uint64_t{0});
        for (std::size_t o = 0; o < orders_; ++o) {
            if (!(bits & BatchSums::bit_of(o))) continue;
            const Value* added = values.data() + o * cells_ * channels_ + begin;
            std::uint64_t* sums = energy_.data() + o * cells_ * channels_ + begin;
            for (std::size_t k = 0; k < count; ++k) {
                sums[k] += added[k] * kUnit;
                total[k] += added[k] * kUnit;
            }
        }
        // What their spread will be told from
        if (smaller)
            for (std::size_t k = 0; k < count; ++k) {
                const std::uint64_t stretched = scaled(total[k], b.rays);
                s.stretched[begin + k] += stretched - total[k];
                total[k] = stretched;
            }
        for (std::size_t k = 0; k < count; ++k) {
            if (total[k] == 0) continue;
            squares[begin + k] += Wide{total[k]} * total[k];
            if (by_counted) by_counted[begin + k] += Wide{total[k]} * counted;
        }
    });
}

LayerSums::Estimate LayerSums::estimate(double sum, double excess) const {
    // Standard error of the mean over batches: sqrt((K sum e^2 - (sum e)^2) / (K - 1)) / K
    const double launched =
        static_cast<double>(kRayEnergy) * static_cast<double>(largest_batch_) * batches_;
    Estimate e;
    e.mean = sum / launched;
    e.error = batches_ < 2 ? std::numeric_limits<double>::infinity()
                           : std::sqrt(std::max(0.0, excess) / (batches_ - 1)) / launched;
    if (sum == 0) e.error = 0;
    return e;
}

double LayerSums::excess(Wide products, std::uint64_t a, std::uint64_t b) const {
    // Exact: however large the products, K batches of e <= 2^64 / K differ by less than 2^126
    __extension__ using SignedWide = __int128;
    return static_cast<double>(
        static_cast<SignedWide>(static_cast<Wide>(batches_) * products - Wide{a} * b));
}

LayerSums::Estimate LayerSums::estimate(const Spread& s) const {
    return estimate(static_cast<double>(s.sum), excess(s));
}

LayerSums::Estimate LayerSums::estimate(std::size_t k, std::uint64_t sum, std::uint64_t each,
                                        double of_counted) const {
    if (!cell_spread_.stretched.empty()) sum += cell_spread_.stretched[k];
    const Wide squares = cell_spread_.squares[k];
    if (each == 0) return estimate(Spread{sum, squares});
    // With n counted rays of energy f each beside e: (e + f n)^2, term by term
    const Spread& n = counted_spread_;
    const double f = std::ldexp(static_cast<double>(each), -kCountShift);
    return estimate(static_cast<double>(sum) + f * static_cast<double>(n.sum),
                    excess(squares, sum, sum) +
                        2 * f * excess(cell_spread_.by_counted[k], sum, n.sum) +
                        f * f * of_counted);
}

template <class Work>
void LayerSums::for_cells(Work work) const {
    const std::size_t counted = light_ ? light_->cells().size() : 0;
    std::size_t next = 0;
    for (std::size_t cell = 0; cell < cells_; ++cell) {
        const bool has_share = next < counted && light_->cells()[next] == cell;
        work(cell, has_share ? static_cast<std::ptrdiff_t>(next++) : -1);
    }
}

LayerSums::Errors LayerSums::relative_errors() const {
    Errors worst;
    const std::size_t order = channels_ * cells_;
    const double of_counted = excess(counted_spread_);
    for (std::size_t c = 0; c < channels_; ++c) {
        worst.albedo = std::max(worst.albedo, estimate(albedo_spread_[c]).relative());
        // The strongest cells that together carry 90 % of the energy
        std::vector<Estimate> cells;
        for_cells([&](std::size_t cell, std::ptrdiff_t k) {
            const std::size_t place = cell * channels_ + c;
            std::uint64_t sum = 0;
            for (std::size_t o = 0; o < orders_; ++o) sum += energy_[o * order + place];
            cells.push_back(estimate(place, sum, counted_energy(k, c), of_counted));
        });
        std::sort(cells.begin(), cells.end(),
                  [](const Estimate& a, const Estimate& b) { return a.mean > b.mean; });
        const double enough = 0.9 * estimate(albedo_spread_[c]).mean;
        double carried = 0;
        for (std::size_t k = 0; k < cells.size() && cells[k].mean > 0 && carried < enough; ++k) {
            carried += cells[k].mean;
            worst.cells = std::max(worst.cells, cells[k].relative());
        }
    }
    return worst;
}

void LayerSums::write(Layer& layer) const {
    layer.rays = rays_;
    layer.segments = segments_;
    layer.reflections = reflections_;
    layer.stuck = stuck_;
    layer.batches = batches_;
    layer.energy.resize(energy_.size());
    layer.stderr_energy.assign(channels_ * cells_, 0);
    layer.escaped.assign(channels_, 0);
    const std::size_t order = channels_ * cells_;
    const double of_counted = excess(counted_spread_);
    for_cells([&](std::size_t cell, std::ptrdiff_t k) {
        for (std::size_t c = 0; c < channels_; ++c) {
            const std::size_t place = cell * channels_ + c, out = c * cells_ + cell;
            std::uint64_t sum = 0;
            for (std::size_t o = 0; o < orders_; ++o)
                sum += layer.energy[o * order + out] = energy_[o * order + place];
            const std::uint64_t each = counted_energy(k, c), counted = counted_ * each;
            layer.energy[out] += counted;
            layer.escaped[c] += sum + counted;
            if (sum + counted > 0)
                layer.stderr_energy[out] =
                    static_cast<float>(estimate(place, sum, each, of_counted).error);
        }
    });
    layer.absorbed = absorbed_;
    layer.truncated = truncated_;
    layer.edge = edge_;
    layer.escaped_by_bounce = escaped_by_bounce_;

    layer.stderr_albedo.clear();
    for (const Spread& s : albedo_spread_) layer.stderr_albedo.push_back(estimate(s).error);
    layer.stderr_albedo_by_bounce.clear();
    for (const Spread& s : bounce_spread_)
        layer.stderr_albedo_by_bounce.push_back(estimate(s).error);

    // Energy is accounted for, to the last unit
    for (std::size_t c = 0; c < channels_; ++c)
        if (layer.escaped[c] + absorbed_[c] + truncated_[c] + edge_[c] != rays_ * kRayEnergy)
            throw std::logic_error("energy is not accounted for");
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_sums.h>

#include <asperity/core/energy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace asperity {

namespace {

std::size_t index(int a) {
    return static_cast<std::size_t>(a);
}

void add_to(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& more) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
}

}  // namespace

BatchSums::BatchSums(int cells, int channels, int orders, int bounces)
    : cells_(index(cells)),
      channels_(index(channels)),
      orders_(index(orders)),
      bounces_(index(bounces)),
      energy_(cells_ * orders_ * channels_),
      is_touched_(cells_),
      escaped_by_bounce_(channels_ * bounces_),
      absorbed_(channels_),
      truncated_(channels_),
      edge_(channels_) {}

void BatchSums::escape(const PerPath<std::int32_t>& cells, const PerPath<std::int32_t>& paths,
                       std::size_t count, int order, const Weights& weights) {
    const std::size_t bounce = index(order - 1), kept = std::min(bounce, orders_ - 1);
    const std::size_t stride = orders_ * channels_;
    // Plain pointers: this is the innermost loop that is not done in lanes
    if (weights.empty()) {
        std::uint64_t* sums = energy_.data() + kept;
        for (std::size_t k = 0; k < count; ++k) {
            std::uint64_t& sum = sums[index(cells[k]) * stride];
            if (sum == 0) touch(index(cells[k]));
            sum += kRayEnergy;
        }
        escaped_by_bounce_[bounce] += count * kRayEnergy;
        return;
    }
    for (std::size_t k = 0; k < count; ++k) touch(index(cells[k]));
    for (std::size_t c = 0; c < channels_; ++c) {
        const PerPath<float>& weight = weights[c];
        std::uint64_t* sums = energy_.data() + kept * channels_ + c;
        std::uint64_t sum = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint64_t energy = to_energy(double{weight[index(paths[k])]});
            sums[index(cells[k]) * stride] += energy;
            sum += energy;
        }
        escaped_by_bounce_[c * bounces_ + bounce] += sum;
        absorbed_[c] += count * kRayEnergy - sum;
    }
}

void BatchSums::touch(std::size_t cell) {
    if (is_touched_[cell]) return;
    is_touched_[cell] = 1;
    touched_.push_back(static_cast<std::uint32_t>(cell));
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
    const std::size_t stride = orders_ * channels_;
    for (const std::uint32_t cell : touched_) {
        std::fill_n(&energy_[cell * stride], stride, std::uint64_t{0});
        is_touched_[cell] = 0;
    }
    touched_.clear();
    for (auto* account : {&escaped_by_bounce_, &absorbed_, &truncated_, &edge_})
        std::fill(account->begin(), account->end(), std::uint64_t{0});
    rays = segments = reflections = stuck = 0;
}

LayerSums::LayerSums(int cells, int channels, int orders, int bounces, std::uint64_t largest_batch)
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
      cell_spread_(channels_ * cells_),
      bounce_spread_(channels_ * bounces_),
      albedo_spread_(channels_) {}

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

    for (std::size_t k = 0; k < bounce_spread_.size(); ++k)
        bounce_spread_[k].add(scaled(b.escaped_by_bounce_[k], b.rays));
    for (std::size_t c = 0; c < channels_; ++c) {
        const auto* first = &b.escaped_by_bounce_[c * bounces_];
        albedo_spread_[c].add(
            scaled(std::accumulate(first, first + bounces_, std::uint64_t{0}), b.rays));
    }
    for (const std::uint32_t cell : b.touched_) {
        const std::uint64_t* sums = &b.energy_[cell * orders_ * channels_];
        std::uint64_t* mine = &energy_[cell * orders_ * channels_];
        Spread* spread = &cell_spread_[cell * channels_];
        for (std::size_t c = 0; c < channels_; ++c) {
            std::uint64_t total = 0;
            for (std::size_t order = 0; order < orders_; ++order) {
                const std::uint64_t energy = sums[order * channels_ + c];
                mine[order * channels_ + c] += energy;
                total += energy;
            }
            if (total > 0) spread[c].add(scaled(total, b.rays));
        }
    }
}

double LayerSums::relative_error(const Spread& s) const {
    // Standard error of the mean over its mean: sqrt((K sum e^2 - (sum e)^2) / (K - 1)) / sum e.
    if (s.sum == 0) return 0;
    if (batches_ < 2) return std::numeric_limits<double>::infinity();
    const auto k = static_cast<long double>(batches_);
    const auto sum = static_cast<long double>(s.sum);
    const long double excess = k * static_cast<long double>(s.squares) - sum * sum;
    return static_cast<double>(std::sqrt(std::max(0.0L, excess) / (k - 1)) / sum);
}

double LayerSums::standard_error(const Spread& s) const {
    const double launched = static_cast<double>(largest_batch_) * batches_;
    const double mean = static_cast<double>(s.sum) / (static_cast<double>(kRayEnergy) * launched);
    return mean > 0 ? mean * relative_error(s) : 0.0;
}

LayerSums::Errors LayerSums::relative_errors() const {
    Errors worst;
    for (std::size_t c = 0; c < channels_; ++c) {
        worst.albedo = std::max(worst.albedo, relative_error(albedo_spread_[c]));
        // The strongest cells that together carry 90 % of the energy
        std::vector<const Spread*> cells;
        for (std::size_t k = 0; k < cells_; ++k)
            if (cell_spread_[k * channels_ + c].sum > 0)
                cells.push_back(&cell_spread_[k * channels_ + c]);
        std::sort(cells.begin(), cells.end(),
                  [](const Spread* a, const Spread* b) { return a->sum > b->sum; });
        const double enough = 0.9 * static_cast<double>(albedo_spread_[c].sum);
        double carried = 0;
        for (std::size_t k = 0; k < cells.size() && carried < enough; ++k) {
            carried += static_cast<double>(cells[k]->sum);
            worst.cells = std::max(worst.cells, relative_error(*cells[k]));
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
    for (std::size_t cell = 0; cell < cells_; ++cell)
        for (std::size_t k = 0; k < orders_ * channels_; ++k)
            layer.energy[k * cells_ + cell] = energy_[cell * orders_ * channels_ + k];
    layer.absorbed = absorbed_;
    layer.truncated = truncated_;
    layer.edge = edge_;
    layer.escaped_by_bounce = escaped_by_bounce_;
    layer.escaped.assign(channels_, 0);
    for (std::size_t k = 0; k < energy_.size(); ++k) layer.escaped[k % channels_] += energy_[k];

    layer.stderr_energy.resize(cell_spread_.size());
    for (std::size_t k = 0; k < cell_spread_.size(); ++k)
        layer.stderr_energy[k % channels_ * cells_ + k / channels_] =
            static_cast<float>(standard_error(cell_spread_[k]));
    for (const Spread& s : albedo_spread_) layer.stderr_albedo.push_back(standard_error(s));
    for (const Spread& s : bounce_spread_)
        layer.stderr_albedo_by_bounce.push_back(standard_error(s));

    // Energy is accounted for, to the last unit
    for (std::size_t c = 0; c < channels_; ++c)
        if (layer.escaped[c] + absorbed_[c] + truncated_[c] + edge_[c] != rays_ * kRayEnergy)
            throw std::logic_error("energy is not accounted for");
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/batch_sums.h>

#include <asperity/core/energy.h>
#include <asperity/core/index.h>

#include <array>
#include <utility>

namespace asperity {

namespace {

/// Cells are fetched so many paths ahead.
constexpr std::size_t kAhead = 48;

}  // namespace

SpreadLight::SpreadLight(const SumShape& shape, std::vector<std::uint32_t> at,
                         std::vector<std::uint64_t> energies)
    : places(std::move(at)), energy(std::move(energies)), reflected(shape.sides * shape.values()) {
    const std::size_t values = shape.values();
    for (std::size_t k = 0; k < places.size(); ++k)
        for (std::size_t v = 0; v < values; ++v)
            reflected[places[k] / shape.cells * values + v] += energy[k * values + v];
}

BatchSums::BatchSums(const SumShape& shape)
    : shape_(shape),
      touched_((shape.places() + kBlock - 1) / kBlock),
      escaped_by_bounce_(shape.sides * shape.values() * shape.bounces),
      absorbed_(shape.channels),
      truncated_(shape.channels),
      edge_(shape.channels) {}

void BatchSums::escape(std::size_t side, int order, const std::int32_t* cells,
                       const std::int32_t* paths, std::size_t count, Weights weights) {
    const std::size_t bounce = index(order - 1), kept = std::min(bounce, shape_.orders - 1);
    const std::size_t values = shape_.values(), first_place = side * shape_.cells;
    const std::uint8_t bit = bit_of(kept);
    std::uint8_t* touched = touched_.data();
    if (!weights.empty()) {
        for (std::size_t k = 0; k < count; ++k)
            touched[(first_place + index(cells[k])) / kBlock] |= bit;
        energy_.resize(shape_.orders * shape_.places() * values);
        counted_ = false;
        std::uint64_t* sums = energy_.data() + (kept * shape_.places() + first_place) * values;
        const Leaving leaving{side, bounce, cells, paths, count, weights};
        // Colours at once, as this takes a good part of the time of a metal
        std::size_t v = 0;
        for (; v + 3 <= values; v += 3) escape_weighted<3>(leaving, v, sums + v);
        for (; v < values; ++v) escape_weighted<1>(leaving, v, sums + v);
        return;
    }
    count_.resize(shape_.orders * shape_.places());
    std::uint32_t* counts = count_.data() + kept * shape_.places();
    for (std::size_t k = 0; k < count; ++k) {
        __builtin_prefetch(counts + first_place + cells[std::min(k + kAhead, count - 1)], 1);
        const std::size_t place = first_place + index(cells[k]);
        ++counts[place];
        touched[place / kBlock] |= bit;
    }
    by_bounce(side, 0, bounce) += count * kRayEnergy;
}

template <std::size_t kCount>
void BatchSums::escape_weighted(const Leaving& leaving, std::size_t first, std::uint64_t* sums) {
    // Plain pointers, and copies of what does not change, for the innermost loop
    std::array<const float*, kCount> weight;
    for (std::size_t v = 0; v < kCount; ++v) weight[v] = leaving.weights[first + v];
    const std::int32_t *cells = leaving.cells, *paths = leaving.paths;
    const std::size_t values = shape_.values(), count = leaving.count;
    std::array<std::uint64_t, kCount> total{};
    for (std::size_t k = 0; k < count; ++k) {
        __builtin_prefetch(sums + index(cells[std::min(k + kAhead, count - 1)]) * values, 1);
        std::uint64_t* sum = sums + index(cells[k]) * values;
        for (std::size_t v = 0; v < kCount; ++v) {
            const std::uint64_t energy = to_energy(double{weight[v][paths[k]]});
            sum[v] += energy;
            total[v] += energy;
        }
    }
    for (std::size_t v = 0; v < kCount; ++v) {
        by_bounce(leaving.side, first + v, leaving.bounce) += total[v];
        if ((first + v) % shape_.elements == 0)
            absorbed_[(first + v) / shape_.elements] += count * kRayEnergy - total[v];
    }
}

void BatchSums::escape_spread(std::uint64_t count, std::shared_ptr<const SpreadLight> light) {
    if (count == 0) return;
    spread_ += count;
    for (std::size_t c = 0; c < shape_.channels; ++c) absorbed_[c] += count * kRayEnergy;
    for (std::size_t k = 0; k < light->reflected.size(); ++k) {
        const std::size_t side = k / shape_.values(), v = k % shape_.values();
        const std::uint64_t sum = count * light->reflected[k];
        by_bounce(side, v, 0) += sum;
        if (v % shape_.elements == 0) absorbed_[v / shape_.elements] -= sum;
    }
    spread_light_ = std::move(light);
}

void BatchSums::truncate_launched(std::uint64_t count) {
    for (std::uint64_t& energy : truncated_) energy += count * kRayEnergy;
    stuck += count;
}

void BatchSums::settle(std::vector<std::uint64_t>& account, const std::int32_t* paths,
                       std::size_t count, Weights weights) {
    if (weights.empty()) {
        account[0] += count * kRayEnergy;
        return;
    }
    for (std::size_t c = 0; c < shape_.channels; ++c)
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint64_t energy = to_energy(double{weights[c * shape_.elements][paths[k]]});
            account[c] += energy;
            absorbed_[c] += kRayEnergy - energy;
        }
}

void share_evenly(std::uint64_t* values, std::size_t count, std::size_t stride) {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += values[k * stride];
    if (sum == 0) return;
    const std::uint64_t each = sum / count, more = sum % count;
    for (std::size_t k = 0; k < count; ++k) values[k * stride] = each + (k < more ? 1 : 0);
}

void BatchSums::weigh() {
    if (!counted_ || count_.empty()) return;
    const std::size_t order = shape_.places() * shape_.values();
    energy_.resize(shape_.orders * order);
    for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
        for (std::size_t o = 0; o < shape_.orders; ++o)
            if (bits & bit_of(o))
                for (std::size_t k = o * order + begin; k < o * order + end; ++k)
                    energy_[k] = std::exchange(count_[k], 0u) * kRayEnergy;
    });
    counted_ = false;
}

void BatchSums::share_rows(std::size_t columns) {
    const std::size_t values = shape_.values(), order = shape_.places() * values;
    weigh();
    if (counted_) return;
    for (std::size_t first = 0; first < shape_.places(); first += columns) {
        const std::size_t begin = first / kBlock, end = (first + columns - 1) / kBlock + 1;
        std::uint8_t bits = 0;
        for (std::size_t b = begin; b < end; ++b) bits |= touched_[b];
        if (bits == 0) continue;
        for (std::size_t b = begin; b < end; ++b) touched_[b] = bits;
        for (std::size_t o = 0; o < shape_.orders; ++o)
            if (bits & bit_of(o))
                for (std::size_t v = 0; v < values; ++v)
                    share_evenly(&energy_[o * order + first * values + v], columns, values);
    }
}

BatchSums& BatchSums::operator+=(const BatchSums& other) {
    const std::size_t order = shape_.places() * shape_.values();
    const bool paths = other.counted_ ? !other.count_.empty() : !other.energy_.empty();
    if (!other.counted_) weigh();
    if (paths && counted_ && other.counted_) count_.resize(other.count_.size());
    if (paths && !other.counted_) {
        energy_.resize(other.energy_.size());
        counted_ = false;
    }
    other.for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
        touched_[begin / (kBlock * shape_.values())] |= bits;
        for (std::size_t o = 0; o < shape_.orders; ++o) {
            if (!(bits & bit_of(o))) continue;
            for (std::size_t k = o * order + begin; k < o * order + end; ++k)
                if (counted_)
                    count_[k] += other.count_[k];
                else
                    energy_[k] += other.counted_ ? other.count_[k] * kRayEnergy : other.energy_[k];
        }
    });
    const auto add = [](std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& more) {
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
    };
    add(escaped_by_bounce_, other.escaped_by_bounce_);
    add(absorbed_, other.absorbed_);
    add(truncated_, other.truncated_);
    add(edge_, other.edge_);
    rays += other.rays;
    segments += other.segments;
    reflections += other.reflections;
    stuck += other.stuck;
    spread_ += other.spread_;
    if (other.spread_light_) spread_light_ = other.spread_light_;
    return *this;
}

void BatchSums::for_totals(std::vector<std::uint64_t>& totals, int sign) const {
    const std::size_t values = shape_.values(), order = shape_.places() * values;
    // In two's complement, so what is taken away may be more than there is
    const auto factor = static_cast<std::uint64_t>(std::int64_t{sign});
    if (counted_ ? !count_.empty() : !energy_.empty())
        for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
            for (std::size_t o = 0; o < shape_.orders; ++o)
                if (bits & bit_of(o))
                    for (std::size_t k = begin; k < end; ++k)
                        totals[k] += factor * (counted_ ? count_[o * order + k] * kRayEnergy
                                                        : energy_[o * order + k]);
        });
    if (spread_ == 0) return;
    for (std::size_t p = 0; p < spread_light_->places.size(); ++p)
        for (std::size_t v = 0; v < values; ++v)
            totals[spread_light_->places[p] * values + v] +=
                factor * spread_ * spread_light_->energy[p * values + v];
}

std::vector<std::uint64_t> BatchSums::escaped() const {
    std::vector<std::uint64_t> sums(shape_.sides * shape_.values());
    for (std::size_t k = 0; k < escaped_by_bounce_.size(); ++k)
        sums[k / shape_.bounces] += escaped_by_bounce_[k];
    return sums;
}

void BatchSums::clear() {
    const std::size_t order = shape_.places() * shape_.values();
    const auto forget = [&](auto& sums, std::size_t orders) {
        if (sums.empty()) return;
        for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
            for (std::size_t o = 0; o < orders; ++o)
                if (bits & bit_of(o)) std::fill_n(sums.data() + o * order + begin, end - begin, 0u);
        });
    };
    forget(energy_, shape_.orders);
    forget(count_, shape_.orders);
    std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
    for (auto* account : {&escaped_by_bounce_, &absorbed_, &truncated_, &edge_})
        std::fill(account->begin(), account->end(), std::uint64_t{0});
    rays = segments = reflections = stuck = spread_ = 0;
    spread_light_.reset();
    counted_ = true;
}

}  // namespace asperity

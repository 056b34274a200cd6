// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/layer_sums.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/detector/cell_estimates.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace asperity {

namespace {

__extension__ using SignedWide = __int128;

/// Calls work(k, energy of a ray) for each place and value, k = place * values + value.
template <class Work>
void for_spread(const SpreadLight& light, std::size_t values, Work work) {
    for (std::size_t p = 0; p < light.places.size(); ++p)
        for (std::size_t v = 0; v < values; ++v)
            work(light.places[p] * values + v, light.energy[p * values + v]);
}

template <class T>
void add_to(std::vector<T>& sum, const std::vector<T>& more) {
    if (sum.empty()) sum.resize(more.size());
    for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

/// Batches have at most 2^20 rays, so what they hold fits a signed number, too.
LayerSums::Wide product(std::uint64_t a, std::uint64_t b) {
    return static_cast<LayerSums::Wide>(SignedWide{static_cast<std::int64_t>(a)} *
                                        static_cast<std::int64_t>(b));
}

LayerSums::Wide square(std::uint64_t energy) {
    return product(energy, energy);
}

void add_to(LayerSums::Spread& spread, std::uint64_t scaled) {
    spread.sum += scaled;
    spread.squares += square(scaled);
}

void add_to(std::vector<LayerSums::Spread>& spreads, const std::vector<LayerSums::Spread>& more) {
    for (std::size_t k = 0; k < more.size(); ++k) {
        spreads[k].sum += more[k].sum;
        spreads[k].squares += more[k].squares;
    }
}

}  // namespace

LayerSums::LayerSums(const SumShape& of, std::uint64_t largest)
    : shape(of),
      largest_batch(largest),
      energy(of.orders * of.places() * of.values()),
      escaped_by_bounce(of.sides * of.values() * of.bounces),
      absorbed(of.channels),
      truncated(of.channels),
      edge(of.channels),
      squares(of.places() * of.values()),
      reached(squares.size()),
      bounces(escaped_by_bounce.size()),
      albedo(of.sides * of.values()),
      albedo_by_age(kAges * albedo.size()),
      groups(of) {}

std::uint64_t LayerSums::scaled(std::uint64_t value, std::uint64_t of_rays) const {
    if (of_rays == largest_batch) return value;
    const SignedWide product =
        SignedWide{static_cast<std::int64_t>(value)} * static_cast<std::int64_t>(largest_batch);
    return static_cast<std::uint64_t>(
        static_cast<std::int64_t>(product / static_cast<std::int64_t>(of_rays)));
}

void LayerSums::add(std::uint64_t number, const BatchSums& b) {
    if (!done.add({number, number + 1}))
        throw Error(ErrorCode::Usage, fmt::format("batch {} is in the sums already", number));
    rays += b.rays;
    segments += b.segments;
    reflections += b.reflections;
    stuck += b.stuck;
    add_to(absorbed, b.absorbed_);
    add_to(truncated, b.truncated_);
    add_to(edge, b.edge_);
    add_to(escaped_by_bounce, b.escaped_by_bounce_);
    add_spreads(number, b);
    const std::size_t group = number % GroupSums::kGroups;
    groups.rays[group] += b.rays;
    const auto add = [&]<std::uint64_t kUnit>(const auto& paths) {
        if (b.rays == largest_batch)
            add_places<kUnit>(group, b, paths);
        else
            add_scaled_places<kUnit>(group, b, paths);
    };
    if (b.counted_)
        add.operator()<kRayEnergy>(b.count_);
    else
        add.operator()<1>(b.energy_);
}

void LayerSums::add_halves(std::uint64_t number, BatchSums& first, const BatchSums& second) {
    // In two's complement; squares do not ask for the sign
    std::vector<std::uint64_t> difference(squares.size());
    first.add_to(difference);
    second.take_from(difference);
    std::vector<std::uint64_t> escaped = first.escaped();
    const std::vector<std::uint64_t> of_second = second.escaped();
    for (std::size_t k = 0; k < escaped.size(); ++k) escaped[k] -= of_second[k];
    first += second;
    add(number, first);
    const auto add = [](std::vector<Wide>& sums, const std::vector<std::uint64_t>& differences) {
        sums.resize(differences.size());
        for (std::size_t k = 0; k < sums.size(); ++k)
            if (differences[k] != 0) sums[k] += square(differences[k]);
    };
    add(halves.cells, difference);
    add(halves.albedo, escaped);
}

void LayerSums::add_spreads(std::uint64_t number, const BatchSums& b) {
    for (std::size_t k = 0; k < bounces.size(); ++k)
        add_to(bounces[k], scaled(b.escaped_by_bounce_[k], b.rays));
    const std::size_t age =
        std::min<std::size_t>(static_cast<std::size_t>(std::bit_width(number)), kAges - 1);
    for (std::size_t k = 0; k < albedo.size(); ++k) {
        const auto* first = &b.escaped_by_bounce_[k * shape.bounces];
        const std::uint64_t all =
            scaled(std::accumulate(first, first + shape.bounces, std::uint64_t{0}), b.rays);
        add_to(albedo[k], all);
        add_to(albedo_by_age[age * albedo.size() + k], all);
    }
}

template <std::uint64_t kUnit, class Value>
void LayerSums::add_places(std::size_t group, const BatchSums& b, const std::vector<Value>& paths) {
    Wide* products = nullptr;
    if (b.spread_ > 0) {
        // Surfaces of their own spread light in ways of their own
        if (waiting_.light && waiting_.light != b.spread_light_) settle();
        waiting_.light = b.spread_light_;
        waiting_.count += b.spread_;
        waiting_.squares += Wide{b.spread_} * b.spread_;
        waiting_.products.resize(squares.size());
        waiting_.of_group.resize(GroupSums::kGroups);
        waiting_.of_group[group] += b.spread_;
        products = waiting_.products.data();
    }
    if (paths.empty()) return;
    const std::size_t order = squares.size();
    std::vector<std::uint64_t> of_block(BatchSums::kBlock * shape.values());
    std::uint64_t* total = of_block.data();
    b.for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
        // Orders by themselves, and all together
        const std::size_t count = end - begin;
        std::fill_n(total, count, std::uint64_t{0});
        for (std::size_t o = 0; o < shape.orders; ++o) {
            if (!(bits & BatchSums::bit_of(o))) continue;
            const Value* added = paths.data() + o * order + begin;
            std::uint64_t* sums = energy.data() + o * order + begin;
            for (std::size_t k = 0; k < count; ++k) {
                sums[k] += added[k] * kUnit;
                total[k] += added[k] * kUnit;
            }
        }
        // What their spread will be told from
        for (std::size_t k = 0; k < count; ++k) {
            if (total[k] == 0) continue;
            squares[begin + k] += square(total[k]);
            ++reached[begin + k];
            if (products) products[begin + k] += product(total[k], b.spread_);
        }
        groups.add(shape, group, begin, {total, count});
    });
}

template <std::uint64_t kUnit, class Value>
void LayerSums::add_scaled_places(std::size_t group, const BatchSums& b,
                                  const std::vector<Value>& paths) {
    const std::size_t order = squares.size();
    if (stretched.empty()) stretched.resize(order);
    std::vector<std::uint64_t> total(order);
    const auto add = [&](std::size_t o, std::size_t k, std::uint64_t added) {
        energy[o * order + k] += added;
        total[k] += added;
    };
    if (!paths.empty())
        b.for_touched([&](std::size_t begin, std::size_t end, std::uint8_t bits) {
            for (std::size_t o = 0; o < shape.orders; ++o)
                if (bits & BatchSums::bit_of(o))
                    for (std::size_t k = begin; k < end; ++k)
                        add(o, k, paths[o * order + k] * kUnit);
        });
    for (std::size_t k = 0; k < order; ++k) reached[k] += total[k] > 0;
    if (b.spread_ > 0) {
        exact.resize(order);
        for_spread(*b.spread_light_, shape.values(), [&](std::size_t k, std::uint64_t each) {
            add(0, k, b.spread_ * each);
            exact[k] += b.spread_ * each;
        });
    }
    groups.add(shape, group, 0, total);
    for (std::size_t k = 0; k < order; ++k) {
        if (total[k] == 0) continue;
        const std::uint64_t stretch = scaled(total[k], b.rays);
        stretched[k] += stretch - total[k];
        squares[k] += square(stretch);
    }
}

void LayerSums::settle() {
    if (settled()) return;
    exact.resize(squares.size());
    groups.spread(shape, waiting_.of_group, *waiting_.light);
    for_spread(*waiting_.light, shape.values(), [&](std::size_t k, std::uint64_t each) {
        energy[k] += waiting_.count * each;
        exact[k] += waiting_.count * each;
        squares[k] += 2 * each * waiting_.products[k] + square(each) * waiting_.squares;
    });
    waiting_ = {};
}

LayerSums& LayerSums::operator+=(const LayerSums& other) {
    if (shape != other.shape || largest_batch != other.largest_batch)
        throw Error(ErrorCode::Usage, "sums of different layers cannot be added");
    if (!other.settled()) {
        LayerSums whole = other;
        whole.settle();
        return *this += whole;
    }
    if (!done.add(other.done))
        throw Error(ErrorCode::Usage, "sums that share a batch cannot be added");
    settle();
    rays += other.rays;
    segments += other.segments;
    reflections += other.reflections;
    stuck += other.stuck;
    add_to(energy, other.energy);
    add_to(escaped_by_bounce, other.escaped_by_bounce);
    add_to(absorbed, other.absorbed);
    add_to(truncated, other.truncated);
    add_to(edge, other.edge);
    add_to(squares, other.squares);
    add_to(stretched, other.stretched);
    add_to(exact, other.exact);
    add_to(reached, other.reached);
    add_to(bounces, other.bounces);
    add_to(albedo, other.albedo);
    add_to(halves.cells, other.halves.cells);
    add_to(halves.albedo, other.halves.albedo);
    add_to(albedo_by_age, other.albedo_by_age);
    add_to(groups.rays, other.groups.rays);
    add_to(groups.energy, other.groups.energy);
    return *this;
}

LayerSums::Estimate LayerSums::estimate(const Spread& s, std::uint64_t batches) const {
    // Standard error of the mean over K batches: sqrt((K sum e^2 - (sum e)^2) / (K - 1)) / K. The
    // difference is exact: of batches of e <= 2^64 / K it is less than 2^126
    const auto sum = static_cast<std::int64_t>(s.sum);
    const bool negative = shape.elements > 1 && sum < 0;
    const std::uint64_t size = negative ? 0 - s.sum : s.sum;
    const double launched = static_cast<double>(kRayEnergy) * static_cast<double>(largest_batch) *
                            static_cast<double>(batches);
    Estimate e;
    e.mean = (negative ? -static_cast<double>(size) : static_cast<double>(size)) / launched;
    if (s.squares == 0) return e;
    if (batches < 2) {
        e.error = std::numeric_limits<double>::infinity();
        return e;
    }
    const auto excess =
        static_cast<double>(static_cast<SignedWide>(Wide{batches} * s.squares - Wide{size} * size));
    e.error = std::sqrt(std::max(0.0, excess) / static_cast<double>(batches - 1)) / launched;
    return e;
}

std::uint64_t LayerSums::over_all_orders(std::size_t k) const {
    std::uint64_t sum = 0;
    for (std::size_t o = 0; o < shape.orders; ++o) sum += energy[o * squares.size() + k];
    return sum;
}

LayerSums::Estimate LayerSums::cell(std::size_t k) const {
    const std::uint64_t stretch = stretched.empty() ? 0 : stretched[k];
    return estimate({over_all_orders(k) + stretch, squares[k]});
}

LayerSums::Errors LayerSums::relative_errors() const {
    Errors worst;
    const std::size_t values = shape.values();
    const std::vector<Estimate> all_cells = cell_estimates(*this);
    for (std::size_t a = 0; a < albedo.size(); a += shape.elements) {
        const Estimate all = estimate(albedo[a]);
        worst.albedo = std::max(worst.albedo, all.relative());
        // The strongest cells of this side that together carry 90 % of the energy
        const std::size_t first = a / values * shape.cells * values + a % values;
        std::vector<Estimate> of_cells;
        for (std::size_t c = 0; c < shape.cells; ++c)
            of_cells.push_back(all_cells[first + c * values]);
        std::sort(of_cells.begin(), of_cells.end(),
                  [](const Estimate& x, const Estimate& y) { return x.mean > y.mean; });
        const double enough = 0.9 * all.mean;
        double carried = 0;
        for (std::size_t k = 0; k < of_cells.size() && of_cells[k].mean > 0 && carried < enough;
             ++k) {
            carried += of_cells[k].mean;
            worst.cells = std::max(worst.cells, of_cells[k].relative());
        }
    }
    return worst;
}

double LayerSums::relative_error_told_by_first(unsigned k) const {
    const std::uint64_t first = std::uint64_t{1} << k;
    double worst = 0;
    for (std::size_t a = 0; a < albedo.size(); a += shape.elements) {
        Spread sum;
        for (std::size_t age = 0; age <= k; ++age) {
            const Spread& more = albedo_by_age[age * albedo.size() + a];
            sum.sum += more.sum;
            sum.squares += more.squares;
        }
        worst = std::max(worst, estimate(sum, first).relative());
    }
    return worst * std::sqrt(static_cast<double>(first) / static_cast<double>(batches()));
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/energy_rests.h>

#include <asperity/formats/results/rest_coding.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace asperity::io {

namespace {

using Row = std::span<const std::uint64_t>;

/// Sums of each number of a row and its neighbours; the last one is next to the first one.
void sum_neighbours(Row row, std::span<std::uint64_t> sums) {
    const std::size_t last = row.size() - 1;
    for (std::size_t k = 1; k < last; ++k) sums[k] = row[k - 1] + row[k] + row[k + 1];
    sums[0] = row[last] + row[0] + row[last == 0 ? 0 : 1];
    if (last > 0) sums[last] = row[last - 1] + row[last] + row[0];
}

bool is_empty(Row row) {
    return std::all_of(row.begin(), row.end(), [](std::uint64_t x) { return x == 0; });
}

/// Energy of one channel for each unit of what stands before it, by cells: told from the two rows
/// above as if it went on like that.
class RatioOfRows {
  public:
    RatioOfRows(std::size_t columns, double first)
        : first_(first), above_(2, Sums(columns)), rows_(0) {}

    /// Of a cell in the row that comes next.
    double operator()(std::size_t column) const {
        const Sums &one = above_[(rows_ + 1) % 2], &two = above_[rows_ % 2];
        if (one.empty || one.before[column] == 0) return first_;
        const double near = one.ratio(column);
        return two.empty || two.before[column] == 0 ? near : 2 * near - two.ratio(column);
    }
    void add(Row before, Row energy) {
        Sums& sums = above_[rows_++ % 2];
        sums.empty = is_empty(before);
        if (sums.empty) return;
        sum_neighbours(before, sums.before);
        sum_neighbours(energy, sums.energy);
    }

  private:
    struct Sums {
        explicit Sums(std::size_t columns) : before(columns), energy(columns) {}
        double ratio(std::size_t k) const {
            return static_cast<double>(energy[k]) / static_cast<double>(before[k]);
        }
        std::vector<std::uint64_t> before, energy;
        bool empty = true;  ///< nothing before: then the rest is not set
    };
    double first_;
    std::vector<Sums> above_;
    std::size_t rows_;
};

std::uint64_t guess(std::uint64_t before, double ratio) {
    return whole64(static_cast<double>(before) * ratio);
}

double first_ratio(const EnergyRests& r, std::size_t slice, bool first_channel) {
    const auto here = static_cast<double>(r.of_path[slice]);
    if (first_channel) return here;
    return here / static_cast<double>(std::max<std::uint64_t>(1, r.of_path[slice - 1]));
}

/// What a single path may have brought: the median of all energies that are nearly the least one.
std::uint64_t energy_of_a_path(std::span<const std::uint64_t> energy) {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (const std::uint64_t e : energy)
        if (e > 0) least = std::min(least, e);
    std::vector<std::uint64_t> small;
    for (const std::uint64_t e : energy)
        if (e > 0 && e - least <= least / 2) small.push_back(e);
    if (small.empty()) return 0;
    const auto middle = small.begin() + static_cast<std::ptrdiff_t>(small.size() / 2);
    std::nth_element(small.begin(), middle, small.end());
    return *middle;
}

/// Ratios of the cells of a row that have energy.
void set_ratios(Row energy, const RatioOfRows& ratio, std::span<double> ratios) {
    for (std::size_t k = 0; k < energy.size(); ++k)
        if (energy[k] > 0) ratios[k] = ratio(k);
}

/// Numbers of paths in a row that fit its energies best, each path bringing so much.
void count_paths(Row energy, std::span<const double> of_path, std::span<std::uint64_t> paths) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t k = 0; k < energy.size(); ++k) {
        paths[k] = 0;
        if (energy[k] == 0) continue;
        const double number = static_cast<double>(energy[k]) / of_path[k] + 0.5;
        if (number >= 1 && number <= kMost) paths[k] = static_cast<std::uint64_t>(number);
    }
}

}  // namespace

EnergyRests energy_rests(std::span<const std::uint64_t> energy, const SumShape& shape) {
    EnergyRests r;
    const std::size_t cells = shape.cells, columns = shape.columns;
    r.paths.resize(shape.orders * cells);
    r.rests.resize(energy.size());
    std::vector<std::uint64_t> counts(cells);
    std::vector<double> ratios(columns);
    for (std::size_t slice = 0; slice < shape.orders * shape.channels; ++slice) {
        const bool first = slice % shape.channels == 0;
        const Row here = energy.subspan(slice * cells, cells);
        std::uint64_t bits = 0;
        for (const std::uint64_t e : here) bits |= e;
        r.zeros.push_back(static_cast<std::uint8_t>(zeros_of(bits)));
        r.of_path.push_back(bits == 0 ? 0 : energy_of_a_path(here));
        if (bits == 0) continue;
        const Row before = first ? Row(counts) : energy.subspan((slice - 1) * cells, cells);
        RatioOfRows ratio(columns, first_ratio(r, slice, first));
        for (std::size_t begin = 0; begin < cells; begin += columns) {
            const Row row = here.subspan(begin, columns), units = before.subspan(begin, columns);
            set_ratios(row, ratio, ratios);
            if (first) count_paths(row, ratios, std::span(counts).subspan(begin, columns));
            const auto rests = std::span(r.rests).subspan(slice * cells + begin, columns);
            for (std::size_t k = 0; k < columns; ++k) {
                if (units[k] == 0 && row[k] == 0) continue;
                if (row[k] == 0) ratios[k] = ratio(k);
                const std::uint64_t guessed = units[k] == 0 ? 0 : guess(units[k], ratios[k]);
                rests[k] = rest_of(row[k], guessed, r.zeros[slice]);
            }
            ratio.add(units, row);
        }
        if (first)
            std::transform(
                counts.begin(), counts.end(),
                r.paths.begin() + static_cast<std::ptrdiff_t>(slice / shape.channels * cells),
                [](std::uint64_t n) { return static_cast<std::uint32_t>(n); });
    }
    return r;
}

std::vector<std::uint64_t> take_energy(EnergyRests& r, const SumShape& shape) {
    std::vector<std::uint64_t> energy = std::move(r.rests);
    const std::size_t cells = shape.cells, columns = shape.columns;
    for (std::size_t slice = 0; slice < shape.orders * shape.channels; ++slice) {
        const bool first = slice % shape.channels == 0;
        const auto paths = std::span(r.paths).subspan(slice / shape.channels * cells, cells);
        const std::vector<std::uint64_t> counts(paths.begin(), paths.end());
        const Row before = first ? Row(counts) : Row(energy).subspan((slice - 1) * cells, cells);
        const auto here = std::span(energy).subspan(slice * cells, cells);
        RatioOfRows ratio(columns, first_ratio(r, slice, first));
        for (std::size_t begin = 0; begin < cells; begin += columns) {
            const Row units = before.subspan(begin, columns);
            const auto row = here.subspan(begin, columns);
            for (std::size_t k = 0; k < columns; ++k) {
                if (units[k] == 0 && row[k] == 0) continue;
                const std::uint64_t guessed = units[k] == 0 ? 0 : guess(units[k], ratio(k));
                row[k] = from_rest(row[k], guessed, r.zeros[slice]);
            }
            ratio.add(units, row);
        }
    }
    return energy;
}

}  // namespace asperity::io

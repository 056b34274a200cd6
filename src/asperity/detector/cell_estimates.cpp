// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/cell_estimates.h>

#include <asperity/core/energy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

namespace {

/// ln((n + k) / n), to the same bits with every mathematics library: result files make errors
/// again. Sums, products and quotients alone, with one rounding each (-ffp-contract=off).
double log_of_ratio(double n, double k) {
    // n * 2^e is nearest to n + k, and ln(a / b) = 2 artanh((a - b) / (a + b))
    constexpr double kLn2 = 0x1.62e42fefa39efp-1;
    int e = 0;
    double near = n;
    while (n + k > 1.5 * near) near *= 2, ++e;
    const double z = e == 0 ? k / (2 * n + k) : (n + k - near) / (n + k + near);
    double sum = 0;
    for (int power = 31; power > 0; power -= 2) sum = sum * z * z + 1.0 / power;
    return e * kLn2 + 2 * z * sum;
}

/// Hits by which `reached` of so many batches got one at least: Poisson's law. If all did, there
/// are as many as half a batch less would tell, or more: no ray brings more than its energy.
double hits_of(double reached, double batches, double energy) {
    const double most = batches - 0.5;
    const double got = std::min(reached, most);
    const double hits = batches * log_of_ratio(batches - got, got);
    return reached > most ? std::max(hits, energy / static_cast<double>(kRayEnergy)) : hits;
}

/// hits_of() without energy, most often from a table.
class Hits {
  public:
    explicit Hits(double batches) : batches_(batches) {
        for (double reached = 0; reached <= std::min(batches, 1024.0); ++reached)
            few_.push_back(hits_of(reached, batches, 0));
    }
    double of(std::uint32_t reached, double energy) const {
        if (reached >= few_.size()) return hits_of(reached, batches_, energy);
        if (reached < batches_) return few_[reached];
        return std::max(few_[reached], energy / static_cast<double>(kRayEnergy));
    }

  private:
    double batches_;
    std::vector<double> few_;
};

/// One value of one side, as rows of cells.
class Cells {
  public:
    /// `energy` is what paths brought.
    Cells(const LayerSums& sums, std::size_t side, std::size_t value,
          const std::vector<std::uint64_t>& energy)
        : columns_(std::max<std::size_t>(1, sums.shape.columns)),
          of_cell_(sums.shape.cells),
          exact_(sums.shape.cells),
          often_(sums.shape.cells) {
        const std::uint64_t batches = sums.batches();
        const Hits hits(static_cast<double>(batches));
        const std::size_t values = sums.shape.values();
        for (std::size_t c = 0; c < exact_.size(); ++c) {
            const std::size_t k = (side * sums.shape.cells + c) * values + value;
            of_cell_.energy[c] = static_cast<double>(energy[k]);
            of_cell_.hits[c] = hits.of(sums.reached[k], of_cell_.energy[c]);
            often_[c] = sums.reached[k] == batches && of_cell_.hits[c] >= kMany;
            exact_[c] = !sums.exact.empty() && sums.exact[k] > 0;
        }
        of_three_ = of_cell_;
        add_up_columns(of_cell_.hits, of_three_.hits);
        add_up_columns(of_cell_.energy, of_three_.energy);
    }

    std::size_t columns() const { return columns_; }

    /// Square of the energy by which each cell of a row may be wrong that has few hits; variances
    /// are those of their energies over batches.
    void floors(std::size_t row, const double* variances, double* floors) const {
        const std::size_t first = row * columns_, count = exact_.size();
        const std::size_t columns = std::min(columns_, count - first);
        const bool above = row > 0, below = first + columns < count;
        const int rows_around = 1 + (above ? 1 : 0) + (below ? 1 : 0);
        const double cells_around = rows_around * (columns_ < 3 ? 1 : 3);
        const std::vector<double> none(columns, 0.0);
        const auto of_rows = [&](const std::vector<double>& sums) {
            const double* const here = sums.data() + first;
            return std::array{above ? here - columns : none.data(), here,
                              below ? here + columns : none.data()};
        };
        const auto hits = of_rows(of_three_.hits), energy = of_rows(of_three_.energy);
        const double* const own_hits = of_cell_.hits.data() + first;
        const double* const own_energy = of_cell_.energy.data() + first;
        const unsigned char* const exact = exact_.data() + first;
        const unsigned char* const often = often_.data() + first;
        for (std::size_t k = 0; k < columns; ++k) {
            const double around = hits[1][k] + hits[0][k] + hits[2][k];
            const double around_energy = energy[1][k] + energy[0][k] + energy[2][k];
            // Of one ray, from the cell's own or else from those around
            const double here = own_hits[k] > 0 ? own_hits[k] : around;
            double ray = (own_hits[k] > 0 ? own_energy[k] : around_energy) / here;
            // What comes in clumps, as sweeps of isotropic light do, weighs as much as they
            const double clump = variances[k] / own_energy[k];
            if (exact[k] == 0 && own_energy[k] > 0 && ray < clump) ray = clump;
            const double per_cell = around / cells_around;
            // Where each batch had some, they tell if rays on a lattice vary less than by chance
            double square = ray * ray;
            const double told = variances[k] * ray / own_energy[k];
            if (often[k] != 0 && told < square) square = told;
            floors[k] = around > 0 ? per_cell / (per_cell + kHalfway) * square : 0;
        }
    }

  private:
    /// Hits a cell at which the ray more or less counts by half.
    static constexpr double kHalfway = 0.5;
    /// Hits whose batches tell how they vary, if each had some.
    static constexpr double kMany = 30;

    /// Rays that came to cells one by one, and the energy they brought.
    struct Arrivals {
        explicit Arrivals(std::size_t cells = 0) : hits(cells), energy(cells) {}
        std::vector<double> hits, energy;
    };

    /// Three columns each; the last is beside the first.
    void add_up_columns(const std::vector<double>& cells, std::vector<double>& sums) const {
        if (columns_ < 3) return;
        const std::size_t last = columns_ - 1;
        for (std::size_t first = 0; first < cells.size(); first += columns_) {
            const double* const cell = cells.data() + first;
            double* const sum = sums.data() + first;
            sum[0] = cell[0] + cell[1] + cell[last];
            for (std::size_t k = 1; k < last; ++k) sum[k] = cell[k] + cell[k + 1] + cell[k - 1];
            sum[last] = cell[last] + cell[0] + cell[last - 1];
        }
    }

    std::size_t columns_;
    Arrivals of_cell_, of_three_;
    std::vector<unsigned char> exact_;  ///< not all came ray by ray
    std::vector<unsigned char> often_;  ///< each batch had some that did, and all together many
};

/// Over all orders, by place and value.
std::vector<std::uint64_t> over_all_orders(const LayerSums& sums) {
    const std::size_t size = sums.squares.size();
    std::vector<std::uint64_t> all(sums.energy.begin(),
                                   sums.energy.begin() + static_cast<std::ptrdiff_t>(size));
    for (std::size_t order = 1; order < sums.shape.orders; ++order)
        for (std::size_t k = 0; k < size; ++k) all[k] += sums.energy[order * size + k];
    return all;
}

}  // namespace

std::vector<LayerSums::Estimate> cell_estimates(const LayerSums& sums) {
    const std::size_t values = sums.shape.values();
    std::vector<LayerSums::Estimate> estimates(sums.squares.size());
    std::vector<std::uint64_t> energy = over_all_orders(sums);
    const std::uint64_t batches = sums.batches();
    for (std::size_t k = 0; k < estimates.size(); ++k) {
        const std::uint64_t stretch = sums.stretched.empty() ? 0 : sums.stretched[k];
        estimates[k] = sums.estimate({energy[k] + stretch, sums.squares[k]}, batches);
    }
    for (std::size_t k = 0; k < sums.exact.size(); ++k) energy[k] -= sums.exact[k];
    const double launched = static_cast<double>(kRayEnergy) *
                            static_cast<double>(sums.largest_batch) * static_cast<double>(batches);
    for (std::size_t side = 0; side < sums.shape.sides; ++side)
        for (std::size_t v = 0; v < values; v += sums.shape.elements) {
            const Cells cells(sums, side, v, energy);
            const std::size_t columns = cells.columns();
            std::vector<double> variances(columns), floors(columns);
            for (std::size_t first = 0; first < sums.shape.cells; first += columns) {
                LayerSums::Estimate* const here =
                    &estimates[(side * sums.shape.cells + first) * values + v];
                for (std::size_t k = 0; k < columns; ++k) {
                    const double error = here[k * values].error * launched;
                    variances[k] = error * error;
                }
                cells.floors(first / columns, variances.data(), floors.data());
                for (std::size_t k = 0; k < columns; ++k) {
                    LayerSums::Estimate& e = here[k * values];
                    if (e.mean > 0 && std::isfinite(e.error * launched))
                        e.error = std::sqrt(variances[k] + floors[k]) / launched;
                }
            }
        }
    return estimates;
}

}  // namespace asperity

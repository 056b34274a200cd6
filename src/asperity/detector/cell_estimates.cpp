// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/cell_estimates.h>

#include <asperity/core/energy.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity {

namespace {

/// Rays that came to a cell one by one, and the energy they brought.
struct Arrivals {
    double hits = 0, energy = 0;

    Arrivals& operator+=(const Arrivals& other) {
        hits += other.hits;
        energy += other.energy;
        return *this;
    }
    double each() const { return hits > 0 ? energy / hits : 0.0; }
};

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
    Cells(const LayerSums& sums, std::size_t side, std::size_t value)
        : columns_(std::max<std::size_t>(1, sums.shape.columns)),
          of_cell_(sums.shape.cells),
          exact_(of_cell_.size()),
          often_(exact_) {
        const std::uint64_t batches = sums.batches();
        const Hits hits(static_cast<double>(batches));
        const std::size_t values = sums.shape.values();
        for (std::size_t c = 0; c < of_cell_.size(); ++c) {
            const std::size_t k = (side * sums.shape.cells + c) * values + value;
            const double energy = static_cast<double>(sums.followed(k));
            of_cell_[c] = {hits.of(sums.reached[k], energy), energy};
            often_[c] = sums.reached[k] == batches && of_cell_[c].hits >= kMany;
            exact_[c] = !sums.exact.empty() && sums.exact[k] > 0;
        }
        add_up_rows();
    }

    /// Square of the energy by which a cell may be wrong that has few hits; `variance` is that of
    /// its energy over batches.
    double floor(std::size_t cell, double variance) const {
        const Arrivals around = of_neighbours(cell);
        if (around.hits <= 0) return 0;
        const Arrivals& here = of_cell_[cell];
        double ray = here.hits > 0 ? here.each() : around.each();
        // What comes in clumps, as sweeps of isotropic light do, weighs as much as they
        if (!exact_[cell] && here.energy > 0) ray = std::max(ray, variance / here.energy);
        const double per_cell = around.hits / cells_around(cell);
        // Where each batch had some, they tell if rays on a lattice vary less than by chance
        const double square =
            often_[cell] ? std::min(ray * ray, variance * ray / here.energy) : ray * ray;
        return per_cell / (per_cell + kHalfway) * square;
    }

  private:
    /// Hits a cell at which the ray more or less counts by half.
    static constexpr double kHalfway = 0.5;
    /// Hits whose batches tell how they vary, if each had some.
    static constexpr double kMany = 30;

    std::size_t rows() const { return of_cell_.size() / columns_; }

    /// Three columns each; the last is beside the first.
    void add_up_rows() {
        of_three_ = of_cell_;
        if (columns_ < 3) return;
        for (std::size_t c = 0; c < of_cell_.size(); ++c) {
            const std::size_t first = c / columns_ * columns_, column = c - first;
            of_three_[c] += of_cell_[first + (column + 1) % columns_];
            of_three_[c] += of_cell_[first + (column + columns_ - 1) % columns_];
        }
    }
    Arrivals of_neighbours(std::size_t cell) const {
        Arrivals sum = of_three_[cell];
        if (cell >= columns_) sum += of_three_[cell - columns_];
        if (cell + columns_ < of_three_.size()) sum += of_three_[cell + columns_];
        return sum;
    }
    double cells_around(std::size_t cell) const {
        const std::size_t row = cell / columns_;
        const int rows_around = 1 + (row > 0 ? 1 : 0) + (row + 1 < rows() ? 1 : 0);
        return rows_around * (columns_ < 3 ? 1 : 3);
    }

    std::size_t columns_;
    std::vector<Arrivals> of_cell_, of_three_;
    std::vector<bool> exact_;  ///< not all came ray by ray
    std::vector<bool> often_;  ///< each batch had some that did, and all together many
};

}  // namespace

std::vector<LayerSums::Estimate> cell_estimates(const LayerSums& sums) {
    const std::size_t values = sums.shape.values();
    std::vector<LayerSums::Estimate> estimates(sums.squares.size());
    for (std::size_t k = 0; k < estimates.size(); ++k) estimates[k] = sums.cell(k);
    const double launched = static_cast<double>(kRayEnergy) *
                            static_cast<double>(sums.largest_batch) *
                            static_cast<double>(sums.batches());
    for (std::size_t side = 0; side < sums.shape.sides; ++side)
        for (std::size_t v = 0; v < values; v += sums.shape.elements) {
            const Cells cells(sums, side, v);
            for (std::size_t c = 0; c < sums.shape.cells; ++c) {
                LayerSums::Estimate& e = estimates[(side * sums.shape.cells + c) * values + v];
                const double error = e.error * launched;
                if (e.mean > 0 && std::isfinite(error))
                    e.error = std::sqrt(error * error + cells.floor(c, error * error)) / launched;
            }
        }
    return estimates;
}

}  // namespace asperity

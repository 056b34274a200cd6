// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/region.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/index.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asperity {

namespace {

constexpr double kFewRays = 10;

using Groups = std::array<double, GroupSums::kGroups>;

/// What cells of a block hold, and what their errors would be if they knew nothing of each other.
struct Part {
    double energy = 0, variance = 0;
    void add(double e, double error) {
        energy += e;
        variance += error * error;
    }
};

/// One channel of a layer, block by block.
class Blocks {
  public:
    Blocks(const Measurement& m, const Layer& layer, int channel)
        : m_(m), layer_(layer), channel_(index(channel)), grid_(m.shape()), of_(grid_.blocks()) {
        for (int cell = 0; cell < m.detector.cells(); ++cell) add(of_, cell);
    }

    /// Squared error of what these cells hold together.
    double variance_of(std::span<const int> cells) const {
        std::vector<Part> taken(of_.size());
        for (const int cell : cells) add(taken, cell);
        Groups sum{};
        double of_parts = 0;
        for (std::size_t b = 0; b < taken.size(); ++b) {
            if (taken[b].energy <= 0) continue;
            const double share = taken[b].energy / of_[b].energy, rest = 1 - share;
            for (std::size_t g = 0; g < sum.size(); ++g) sum[g] += share * group(g, b);
            of_parts += rest * rest * taken[b].variance +
                        share * share * std::max(0.0, of_[b].variance - taken[b].variance);
        }
        const double whole = variance(sum);
        return of_parts > 0 ? whole + likeness() * of_parts : whole;
    }

  private:
    void add(std::vector<Part>& parts, int cell) const {
        const double energy = m_.energy(layer_, static_cast<int>(channel_), cell);
        if (energy > 0)
            parts[grid_.block_of(index(cell))].add(
                energy,
                double{layer_.stderr_energy[channel_ * index(m_.detector.cells()) + index(cell)]});
    }

    /// Energy that a group of batches brought to a block, in rays.
    double group(std::size_t g, std::size_t block) const {
        const std::size_t k = (g * grid_.blocks() + block) * index(m_.channels()) + channel_;
        return energy_fraction(layer_.spread.groups.energy[k], 1);
    }

    /// Squared standard error of the mean over all rays, from means of groups of some rays each.
    double variance(const Groups& energy) const {
        const std::vector<std::uint64_t>& rays = layer_.spread.groups.rays;
        double all_energy = 0, all_rays = 0, squares = 0;
        int groups = 0;
        for (std::size_t g = 0; g < energy.size(); ++g) {
            all_energy += energy[g];
            all_rays += static_cast<double>(rays[g]);
            groups += rays[g] > 0;
        }
        if (groups < 2) return std::numeric_limits<double>::infinity();
        const double mean = all_energy / all_rays;
        for (std::size_t g = 0; g < energy.size(); ++g) {
            if (rays[g] == 0) continue;
            const double n = static_cast<double>(rays[g]), off = energy[g] / n - mean;
            squares += n * off * off;
        }
        return squares / (groups - 1) / all_rays;
    }

    /// Squared error of blocks over what it would be if their cells knew nothing of each other, in
    /// the mean; 1 at least.
    double likeness() const {
        double found = 0, apart = 0;
        for (std::size_t b = 0; b < of_.size(); ++b) {
            Groups sum;
            for (std::size_t g = 0; g < sum.size(); ++g) sum[g] = group(g, b);
            found += variance(sum);
            apart += of_[b].variance;
        }
        return apart > 0 ? std::max(1.0, found / apart) : 1.0;
    }

    const Measurement& m_;
    const Layer& layer_;
    const std::size_t channel_;
    const CoarseGrid grid_;
    std::vector<Part> of_;
};

}  // namespace

std::vector<int> cells_in(const Detector& detector, const Region& r) {
    constexpr double kRounding = 1e-9;
    if (!(r.theta_from >= 0 && r.theta_from < r.theta_to && r.theta_to <= 0.5 * kPi + kRounding &&
          r.phi_from < r.phi_to && r.phi_to - r.phi_from <= 2 * kPi + kRounding &&
          std::abs(r.phi_from) <= 4 * kPi))
        throw Error(ErrorCode::Usage,
                    fmt::format("{:g}:{:g},{:g}:{:g} degrees are no part of the hemisphere: polar "
                                "angles grow within 0 to 90, azimuths by 360 at most",
                                degrees(r.theta_from), degrees(r.theta_to), degrees(r.phi_from),
                                degrees(r.phi_to)),
                    "region");
    std::vector<int> cells;
    for (int row = 0; row < detector.rows(); ++row) {
        const double theta = detector.theta_centre(row);
        if (theta < r.theta_from || theta >= r.theta_to) continue;
        for (int column = 0; column < detector.columns(); ++column) {
            const double turns = (detector.phi_centre(column) - r.phi_from) / (2 * kPi);
            if (2 * kPi * (turns - std::floor(turns)) < r.phi_to - r.phi_from)
                cells.push_back(row * detector.columns() + column);
        }
    }
    return cells;
}

EnergyOfCells energy_of_cells(const Measurement& m, const Layer& layer, int channel,
                              std::span<const int> cells) {
    EnergyOfCells sum;
    for (const int cell : cells) sum.energy += m.energy(layer, channel, cell);
    sum.few_rays = sum.energy * static_cast<double>(layer.rays) < kFewRays;
    if (cells.size() == 1)
        sum.error = double{
            layer.stderr_energy[index(channel) * index(m.detector.cells()) + index(cells.front())]};
    else if (layer.spread.groups.rays.empty() || layer.stderr_energy.empty())
        sum.error = std::numeric_limits<double>::quiet_NaN();
    else if (!cells.empty())
        sum.error = std::sqrt(Blocks(m, layer, channel).variance_of(cells));
    return sum;
}

}  // namespace asperity

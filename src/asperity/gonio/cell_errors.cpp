// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/cell_errors.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace asperity {

/// Calls work(block, begin, end) for the cells from begin to end of a row that lie in one block, in
/// order.
template <class Work>
void CellErrors::for_blocks(Work work) const {
    for (std::size_t row = 0; row * grid_.columns < cells_; ++row) {
        const std::size_t first = row * grid_.columns;
        for (std::size_t k = 0; k < grid_.across; ++k)
            work(row / grid_.height * grid_.across + k, first + k * grid_.width,
                 first + std::min((k + 1) * grid_.width, grid_.columns));
    }
}

CellErrors::CellErrors(const Measurement& m, const Layer& layer)
    : grid_(m.shape()),
      channels_(static_cast<std::size_t>(m.channels())),
      cells_(static_cast<std::size_t>(m.detector.cells())) {
    const GroupSums& groups = layer.spread.groups;
    for (std::size_t g = 0; g < kGroups; ++g) {
        rays_[g] = static_cast<double>(groups.rays[g]);
        all_rays_ += rays_[g];
        groups_ += groups.rays[g] > 0;
    }
    const std::size_t blocks = grid_.blocks();
    group_energy_.resize(channels_ * blocks * kGroups);
    const std::uint64_t* energy = groups.energy.data();
    for (std::size_t g = 0; g < kGroups; ++g)
        for (std::size_t b = 0; b < blocks; ++b)
            for (std::size_t c = 0; c < channels_; ++c)
                group_energy_[(c * blocks + b) * kGroups + g] =
                    static_cast<double>(*energy++) * (1 / static_cast<double>(kRayEnergy));
    block_of_.resize(cells_);
    for_blocks([&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell)
            block_of_[cell] = static_cast<std::uint32_t>(block);
    });
    block_energy_.resize(channels_ * blocks);
    energy_.reserve(channels_ * cells_);
    error_.reserve(channels_ * cells_);
    for (std::size_t c = 0; c < channels_; ++c) {
        const std::vector<double> energies = m.energies(layer, static_cast<int>(c));
        energy_.insert(energy_.end(), energies.begin(), energies.end());
        for (std::size_t cell = 0; cell < cells_; ++cell) {
            const double e = energies[cell];
            block_energy_[c * blocks + block_of_[cell]] += e;
            error_.push_back(e > 0 ? double{layer.stderr_energy[c * cells_ + cell]} : 0.0);
        }
        const double alike = std::sqrt(likeness(c));
        block_square_.resize((c + 1) * blocks);
        for (std::size_t cell = 0; cell < cells_; ++cell) {
            double& error = error_[c * cells_ + cell];
            error *= alike;
            block_square_[c * blocks + block_of_[cell]] += error * error;
        }
    }
    find_known(layer);
}

/// A ray meets a solved facet or is followed: with shares p and 1 - p of the light the first kind
/// is off by sqrt(p (1 - p) / rays), the other by as much against it.
void CellErrors::find_known(const Layer& layer) {
    if (layer.spread.exact.empty()) return;
    double known = 0, all = 0;
    std::vector<double> exact;
    for (std::size_t k = 0; k < energy_.size(); ++k) {
        exact.push_back(std::min(energy_[k], energy_fraction(layer.spread.exact[k], layer.rays)));
        known += exact[k];
        all += energy_[k];
    }
    const double p = all > 0 ? known / all : 0.0;
    if (!(p > 0 && p < 1)) return;
    const double sigma = std::sqrt(p * (1 - p) / static_cast<double>(layer.rays));
    for (std::size_t k = 0; k < energy_.size(); ++k)
        known_.push_back(sigma * (exact[k] / p - (energy_[k] - exact[k]) / (1 - p)));
}

/// Squared error of blocks over what it would be if their cells knew nothing of each other, in the
/// mean; 1 at least.
double CellErrors::likeness(std::size_t channel) const {
    double found = 0, apart = 0;
    for (std::size_t b = 0; b < grid_.blocks(); ++b) {
        std::array<double, kGroups> sum{};
        for (std::size_t g = 0; g < kGroups; ++g)
            sum[g] = group_energy_[(channel * grid_.blocks() + b) * kGroups + g];
        found += covariance(sum, sum);
    }
    for (std::size_t cell = 0; cell < cells_; ++cell) {
        const double error = error_[channel * cells_ + cell];
        apart += error * error;
    }
    return apart > 0 && std::isfinite(found) ? std::max(1.0, found / apart) : 1.0;
}

/// Covariance of two means over all rays, from means of groups of some rays each.
double CellErrors::covariance(const std::array<double, kGroups>& a,
                              const std::array<double, kGroups>& b) const {
    if (groups_ < 2) return std::numeric_limits<double>::infinity();
    double sum_a = 0, sum_b = 0, products = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
        sum_a += a[g];
        sum_b += b[g];
    }
    const double mean_a = sum_a / all_rays_, mean_b = sum_b / all_rays_;
    for (std::size_t g = 0; g < kGroups; ++g) {
        if (!(rays_[g] > 0)) continue;
        const double off_a = a[g] / rays_[g] - mean_a;
        const double off_b = &a == &b ? off_a : b[g] / rays_[g] - mean_b;
        products += rays_[g] * off_a * off_b;
    }
    return products / (groups_ - 1) / all_rays_;
}

/// What the groups bring to a sum if cells follow their blocks, and by cell what its weight apart
/// from that of its block makes of its error.
std::array<double, CellErrors::kGroups> CellErrors::group_sums(std::span<const double> weights,
                                                               std::vector<double>& parts) const {
    if (weights.size() != channels_ * cells_)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} weights for {} energies", weights.size(), channels_ * cells_));
    std::array<double, kGroups> sums{};
    parts.assign(cells_ + 1, 0.0);  // the last: solved light, of all cells together
    std::vector<double> mean(grid_.blocks());
    for (std::size_t c = 0; c < channels_; ++c) {
        std::fill(mean.begin(), mean.end(), 0.0);
        const std::size_t first = c * cells_;
        for_blocks([&](std::size_t block, std::size_t begin, std::size_t end) {
            double sum = mean[block];
            for (std::size_t k = first + begin; k < first + end; ++k)
                sum += weights[k] * energy_[k];
            mean[block] = sum;
        });
        for (std::size_t b = 0; b < mean.size(); ++b) {
            const double whole = block_energy_[c * mean.size() + b];
            mean[b] = whole > 0 ? mean[b] / whole : 0.0;
            for (std::size_t g = 0; mean[b] != 0 && g < kGroups; ++g)
                sums[g] += mean[b] * group_energy_[(c * mean.size() + b) * kGroups + g];
        }
        if (grid_.height * grid_.width == 1) continue;
        const double* const error = error_.data() + first;
        const double* const known = known_.empty() ? nullptr : known_.data() + first;
        double of_known = parts[cells_];
        for_blocks([&](std::size_t block, std::size_t begin, std::size_t end) {
            for (std::size_t cell = begin; cell < end; ++cell) {
                const double apart = weights[first + cell] - mean[block];
                parts[cell] += apart * error[cell];
                if (known != nullptr) of_known += apart * known[cell];
            }
        });
        parts[cells_] = of_known;
    }
    return sums;
}

double CellErrors::error_of_cells(std::size_t channel, std::span<const int> cells) const {
    struct Taken {
        double energy = 0, square = 0;
    };
    std::map<std::size_t, Taken> taken;
    for (const int cell : cells) {
        const std::size_t k = static_cast<std::size_t>(cell);
        Taken& block = taken[block_of_[k]];
        block.energy += energy_[channel * cells_ + k];
        block.square += error_[channel * cells_ + k] * error_[channel * cells_ + k];
    }
    std::array<double, kGroups> sums{};
    double parts = 0;
    for (const auto& [block, part] : taken) {
        if (part.energy <= 0) continue;
        const std::size_t b = channel * grid_.blocks() + block;
        const double share = part.energy / block_energy_[b], rest = 1 - share;
        for (std::size_t g = 0; g < kGroups; ++g) sums[g] += share * group_energy_[b * kGroups + g];
        if (grid_.height * grid_.width > 1)
            parts += rest * rest * part.square +
                     share * share * std::max(0.0, block_square_[b] - part.square);
    }
    return std::sqrt(covariance(sums, sums) + parts);
}

double CellErrors::error(std::span<const double> weights) const {
    std::vector<double> parts;
    const std::array<double, kGroups> sums = group_sums(weights, parts);
    double sum = covariance(sums, sums);
    for (const double part : parts) sum += part * part;
    return std::sqrt(sum);
}

std::vector<double> CellErrors::covariances(std::span<const std::vector<double>> weights) const {
    const std::size_t count = weights.size();
    std::vector<std::array<double, kGroups>> sums;
    std::vector<std::vector<double>> parts(count);
    for (std::size_t k = 0; k < count; ++k) sums.push_back(group_sums(weights[k], parts[k]));
    std::vector<double> result(count * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = covariance(sums[i], sums[j]);
            for (std::size_t k = 0; k < parts[i].size(); ++k) sum += parts[i][k] * parts[j][k];
            result[i * count + j] = result[j * count + i] = sum;
        }
    }
    return result;
}

}  // namespace asperity

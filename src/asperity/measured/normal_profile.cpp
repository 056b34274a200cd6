// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/normal_profile.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

namespace asperity {

namespace {

void check_bins(int bins) {
    if (bins < 1 || bins > 4096)
        throw Error(ErrorCode::Usage, fmt::format("{} is not in 1 .. 4096", bins), "bins");
}

/// Integral of cos(theta_m) over the ring between two polar angles [sr].
double projected_ring(double theta1, double theta2) {
    const double s1 = std::sin(theta1), s2 = std::sin(theta2);
    return kPi * (s2 * s2 - s1 * s1);
}

}  // namespace

double NormalProfile::theta_edge(int t) const {
    return kPi / 2 * t / bins();
}

NormalProfile normal_profile(const Heightfield& surface, int bins, const Run& run) {
    check_bins(bins);
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(bins));
    std::mutex mutex;
    for_blocks(surface.cells_y(), kRowsPerBlock, run, [&](int first, int last) {
        std::vector<std::uint64_t> part(counts.size());
        for (int j = first; j < last; ++j)
            visit_facets(surface, j, [&](int, Triangle, Slope s) {
                const double theta = std::atan(std::hypot(s.x, s.y));
                ++part[static_cast<std::size_t>(
                    std::min(static_cast<int>(theta / (kPi / 2) * bins), bins - 1))];
            });
        const std::lock_guard lock(mutex);
        for (std::size_t t = 0; t < part.size(); ++t) counts[t] += part[t];
    });
    // All facets have the same projected area: their share of it, per projected solid angle.
    const double facets = 2.0 * static_cast<double>(surface.cell_count());
    NormalProfile profile{std::vector<double>(counts.size())};
    for (int t = 0; t < bins; ++t) {
        const std::size_t k = static_cast<std::size_t>(t);
        profile.density[k] =
            static_cast<double>(counts[k]) /
            (facets * projected_ring(profile.theta_edge(t), profile.theta_edge(t + 1)));
    }
    return profile;
}

NormalProfile normal_profile(SlopeFamily family, double alpha, int bins) {
    check_bins(bins);
    const SlopeLaw law{family, alpha, alpha};
    NormalProfile profile{std::vector<double>(static_cast<std::size_t>(bins))};
    const auto share_below = [&](int t) {
        return t == bins ? 1.0 : law.cumulative(std::tan(profile.theta_edge(t)) / alpha);
    };
    for (int t = 0; t < bins; ++t)
        profile.density[static_cast<std::size_t>(t)] =
            (share_below(t + 1) - share_below(t)) /
            projected_ring(profile.theta_edge(t), profile.theta_edge(t + 1));
    return profile;
}

std::optional<NormalProfile> normal_profile(const Bsdf& model, int bins, const Run& run) {
    check_bins(bins);
    if (!model.normal_density({0, 0, 1})) return std::nullopt;
    constexpr int kRows = 128, kAzimuths = 64;
    const int azimuths = model.isotropic() ? 1 : kAzimuths;
    NormalProfile profile{std::vector<double>(static_cast<std::size_t>(bins))};
    for (int t = 0; t < bins; ++t) {
        if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
        const double low = profile.theta_edge(t), width = profile.theta_edge(t + 1) - low;
        double sum = 0, weights = 0;
        for (int row = 0; row < kRows; ++row) {
            const double theta = low + (row + 0.5) / kRows * width;
            const double weight = std::sin(theta) * std::cos(theta);
            for (int column = 0; column < azimuths; ++column) {
                const double phi = (column + 0.5) * 2 * kPi / azimuths;
                sum += weight * *model.normal_density(from_spherical(theta, phi));
                weights += weight;
            }
        }
        profile.density[static_cast<std::size_t>(t)] = sum / weights;
    }
    return profile;
}

}  // namespace asperity

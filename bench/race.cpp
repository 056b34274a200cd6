// SPDX-License-Identifier: Apache-2.0
#include "race.h"

#include "averages.h"
#include "clocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::bench {

namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

bool is_embree(const Measured& m) {
    return m.rival.starts_with("tri") || m.rival.starts_with("grid");
}

}  // namespace

const Measured* Row::find(const std::string& rival) const {
    const auto found = std::find_if(measured.begin(), measured.end(),
                                    [&](const Measured& m) { return m.rival == rival; });
    return found == measured.end() ? nullptr : &*found;
}

const Measured* Row::best_embree() const {
    const Measured* best = nullptr;
    for (const Measured& m : measured) {
        if (!is_embree(m)) continue;
        if (best == nullptr || m.paths_per_second > best->paths_per_second) best = &m;
    }
    return best;
}

double Row::over(const Measured* other) const {
    return other == nullptr ? kNotANumber : own().paths_per_second / other->paths_per_second;
}

double Row::off_plain(const Measured& other) const {
    const Measured* plain = find("plain");
    if (plain == nullptr || !other.follows_points) return kNotANumber;
    return disagreement_of_same_points(plain->tally(), other.tally());
}

double Row::tight_disagreement() const {
    double largest = kNotANumber;
    for (const Measured& m : measured) {
        if (is_embree(m)) largest = std::fmax(largest, off_plain(m));
    }
    return largest;
}

double Row::loose_disagreement() const {
    double largest = kNotANumber;
    for (const Measured& m : measured) {
        if (!is_embree(m) || own().follows_points) continue;
        largest = std::fmax(largest, disagreement_of_own_points(own().tallies, m.tallies));
    }
    return largest;
}

std::vector<Row> race(const Heightfield& surface, const std::vector<std::unique_ptr<Rival>>& rivals,
                      const RaceSettings& settings) {
    const std::size_t angles = settings.thetas_deg.size();
    std::vector<Row> rows(angles);
    std::vector<std::vector<std::vector<double>>> seconds(
        angles, std::vector<std::vector<double>>(rivals.size()));
    for (std::size_t a = 0; a < angles; ++a) {
        rows[a].size = surface.nx;
        rows[a].theta_deg = settings.thetas_deg[a];
        for (const auto& rival : rivals) {
            Measured m;
            m.rival = rival->name();
            m.follows_points = rival->follows_points();
            m.build_seconds = rival->build_seconds();
            rows[a].measured.push_back(std::move(m));
        }
    }

    Workload workload;
    workload.surface = &surface;
    workload.bounces = settings.bounces;
    workload.own_paths = settings.own_paths;
    for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
        workload.seed = static_cast<std::uint64_t>(repetition) + 1;
        workload.points = blocked_points(surface, settings.points, workload.seed);
        for (std::size_t a = 0; a < angles; ++a) {
            workload.theta_deg = settings.thetas_deg[a];
            for (std::size_t r = 0; r < rivals.size(); ++r) {
                const double begin = cpu_seconds();
                rows[a].measured[r].tallies.push_back(rivals[r]->run(workload));
                seconds[a][r].push_back(cpu_seconds() - begin);
            }
        }
    }

    for (std::size_t a = 0; a < angles; ++a) {
        for (std::size_t r = 0; r < rivals.size(); ++r) {
            Measured& m = rows[a].measured[r];
            const double middle = median(seconds[a][r]);
            m.paths_per_second = static_cast<double>(m.tally().paths()) / middle;
            m.segments_per_second = static_cast<double>(m.tally().segments()) / middle;
            m.memory_bytes = rivals[r]->memory_bytes();
        }
    }
    return rows;
}

}  // namespace asperity::bench

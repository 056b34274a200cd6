// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rival.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace asperity::bench {

/// One rival on one row.
struct Measured {
    std::string rival;
    bool follows_points = false;
    double paths_per_second = 0;     ///< of CPU time of one thread, median of the repetitions
    double segments_per_second = 0;  ///< likewise
    std::vector<Tally> tallies;      ///< one a repetition
    std::size_t memory_bytes = 0;
    double build_seconds = 0;

    const Tally& tally() const { return tallies.front(); }
};

/// All rivals on one surface and incidence.
struct Row {
    std::string surface;
    int size = 0;  ///< samples on a side
    double theta_deg = 0;
    std::vector<Measured> measured;

    /// Null when it did not take part.
    const Measured* find(const std::string& rival) const;
    /// The fastest mode of Embree; null when there is none.
    const Measured* best_embree() const;
    /// The one the others are compared with: the product, or else the plain tracer.
    const Measured& own() const { return measured.front(); }
    /// How many times faster ours is; not a number beside nobody.
    double over(const Measured* other) const;
    /// disagreement_of_same_points of a rival with the plain tracer; not a number where that means
    /// nothing.
    double off_plain(const Measured& other) const;
    /// The largest of those of Embree's modes.
    double tight_disagreement() const;
    /// disagreement_of_own_points of Embree's modes with ours, the largest.
    double loose_disagreement() const;
};

struct RaceSettings {
    std::vector<double> thetas_deg;
    int points = 0;               ///< launch points of those rivals that follow a list
    std::uint64_t own_paths = 0;  ///< paths of those that launch by themselves
    int repetitions = 0;
    int bounces = 0;
};

/// Lets the rivals run in turn, again and again, so that none has the quiet hour for itself. Every
/// repetition has launch points of its own. One row for each incidence.
std::vector<Row> race(const Heightfield& surface, const std::vector<std::unique_ptr<Rival>>& rivals,
                      const RaceSettings& settings);

}  // namespace asperity::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Lists of incident angles between which a table interpolates; inside this folder only.

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity::detail {

inline constexpr double kSameAngle = 1e-9;  ///< [rad]

/// A value between nodes of a sorted list: nodes `index` and `next` with weights 1 - t and t.
struct Bracket {
    std::size_t index = 0, next = 0;
    double t = 0;
};

/// Clamps to the ends of the list.
inline Bracket bracket(std::span<const double> nodes, double x) {
    if (x <= nodes.front()) return {0, 0, 0};
    const std::size_t last = nodes.size() - 1;
    if (x >= nodes.back()) return {last, last, 0};
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
    const std::size_t index = static_cast<std::size_t>(above - nodes.begin()) - 1;
    return {index, index + 1, (x - nodes[index]) / (nodes[index + 1] - nodes[index])};
}

/// Runs round from the last node to the first; x and the nodes in [0, 2 pi).
inline Bracket bracket_round(std::span<const double> nodes, double x) {
    const std::size_t last = nodes.size() - 1;
    if (last == 0) return {0, 0, 0};
    if (x >= nodes.front() && x < nodes.back()) return bracket(nodes, x);
    const double gap = nodes.front() + 2 * kPi - nodes.back();
    const double beyond = x >= nodes.back() ? x - nodes.back() : x + 2 * kPi - nodes.back();
    return {last, 0, beyond / gap};
}

/// The nodes and, between them, as many more as keep neighbours within `spacing`; from `low` to
/// `high`.
inline std::vector<double> refine(std::vector<double> nodes, double low, double high,
                                  double spacing) {
    if (nodes.front() > low) nodes.insert(nodes.begin(), low);
    if (nodes.back() < high) nodes.push_back(high);
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const int parts = std::max(
            1, static_cast<int>(std::ceil((nodes[k + 1] - nodes[k]) / spacing - kSameAngle)));
        for (int p = 0; p < parts; ++p)
            fine.push_back(nodes[k] + (nodes[k + 1] - nodes[k]) * p / parts);
    }
    fine.push_back(nodes.back());
    return fine;
}

/// Sorted, without repetitions.
inline std::vector<double> distinct(std::vector<double> angles) {
    std::sort(angles.begin(), angles.end());
    std::vector<double> result;
    for (const double a : angles)
        if (result.empty() || a - result.back() > kSameAngle) result.push_back(a);
    return result;
}

/// In [0, 2 pi).
inline double positive_azimuth(double phi) {
    const double turned = std::fmod(phi, 2 * kPi);
    const double positive = turned < -kSameAngle ? turned + 2 * kPi : std::max(0.0, turned);
    return positive < 2 * kPi - kSameAngle ? positive : 0.0;
}

}  // namespace asperity::detail

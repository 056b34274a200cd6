// SPDX-License-Identifier: Apache-2.0
#include "tally.h"

#include <asperity/core/directions.h>

namespace asperity::bench {

namespace {

/// Mean absolute value of a normal variable of variance 1.
const double kMeanAbsolute = std::sqrt(2 / kPi);

/// Mean of the repetitions, and the variance of that mean as their spread shows it.
struct Estimate {
    double mean = 0, variance = 0;
};

Estimate estimate(const std::vector<Tally>& repetitions, std::size_t cell) {
    const auto count = static_cast<double>(repetitions.size());
    Estimate e;
    for (const Tally& tally : repetitions) e.mean += tally.share(cell) / count;
    for (const Tally& tally : repetitions) {
        const double off = tally.share(cell) - e.mean;
        e.variance += off * off / (count - 1) / count;
    }
    return e;
}

}  // namespace

DirectionCells::DirectionCells() {
    for (int step = 0; step < kSteps; ++step) {
        // The inverse of the unfolding in cell_of
        const double turned = 4.0 * step / kSteps, inside = turned - std::floor(turned);
        const double azimuth = kPi / 2 * std::floor(turned) + std::atan2(inside, 1 - inside);
        const int column =
            std::min(static_cast<int>(azimuth / (2 * kPi) * kColumns + 1e-9), kColumns - 1);
        const double edge = 2 * kPi * (column + 1) / kColumns;
        guesses_[static_cast<std::size_t>(step)] = {static_cast<float>(std::cos(edge)),
                                                    static_cast<float>(std::sin(edge)), column};
    }
}

double disagreement_of_same_points(const Tally& a, const Tally& b) {
    // The difference of two Poisson counts of mean n has variance 2 n.
    double distance = 0, expected = 0;
    for (std::size_t c = 0; c < DirectionCells::kCells; ++c) {
        distance += std::abs(a.share(c) - b.share(c));
        expected += kMeanAbsolute * std::sqrt(2 * a.share(c) / static_cast<double>(a.paths()));
    }
    return distance / expected;
}

double disagreement_of_own_points(const std::vector<Tally>& a, const std::vector<Tally>& b) {
    if (a.size() < 2 || b.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    double distance = 0, expected = 0;
    for (std::size_t c = 0; c < DirectionCells::kCells; ++c) {
        const Estimate of_a = estimate(a, c), of_b = estimate(b, c);
        distance += std::abs(of_a.mean - of_b.mean);
        expected += kMeanAbsolute * std::sqrt(of_a.variance + of_b.variance);
    }
    return distance / expected;
}

}  // namespace asperity::bench

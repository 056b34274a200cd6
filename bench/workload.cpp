// SPDX-License-Identifier: Apache-2.0
#include "workload.h"

#include <asperity/core/directions.h>
#include <asperity/core/random.h>

#include <cmath>
#include <cstddef>

namespace asperity::bench {

namespace {

/// Every second bit of `code`, from the lowest on: one coordinate of a point on the Z-order curve.
std::uint32_t every_second_bit(std::uint64_t code) {
    std::uint32_t result = 0;
    for (unsigned bit = 0; code != 0; ++bit, code >>= 2) {
        result |= static_cast<std::uint32_t>(code & 1) << bit;
    }
    return result;
}

/// Splits a position in cells into the cell and the place inside it.
void place(double position, std::int32_t& cell, float& inside) {
    cell = static_cast<std::int32_t>(position);
    inside = static_cast<float>(position - cell);
    if (inside >= 1.0F) inside = std::nextafter(1.0F, 0.0F);
}

}  // namespace

std::vector<Launch> stratified_launch(const Heightfield& surface, int strata, std::uint64_t seed) {
    const std::uint64_t count =
        static_cast<std::uint64_t>(strata) * static_cast<std::uint64_t>(strata);
    const double width = static_cast<double>(surface.cells_x()) / strata;
    const double depth = static_cast<double>(surface.cells_y()) / strata;
    const CounterRandom random(seed, 0);
    std::vector<Launch> launch(count);
    for (std::uint64_t k = 0; k < count; ++k) {
        const auto shift = random.uniform2(k);
        place((every_second_bit(k) + shift[0]) * width, launch[k].i, launch[k].u);
        place((every_second_bit(k >> 1) + shift[1]) * depth, launch[k].j, launch[k].v);
    }
    return launch;
}

Vec3 incident_direction(double theta_deg) {
    return -from_spherical(radians(theta_deg), radians(25));
}

double distance(const Tally& a, const Tally& b) {
    double sum = 0;
    for (std::size_t c = 0; c < a.histogram().size(); ++c) {
        sum +=
            std::abs(static_cast<double>(a.histogram()[c]) - static_cast<double>(b.histogram()[c]));
    }
    return sum / 2 / static_cast<double>(a.paths());
}

double distance_of_independent_runs(const Tally& a) {
    // The difference of two Poisson counts of mean n is nearly normal with variance 2 n; its mean
    // absolute value is sqrt(2 / pi) times the root of that.
    double sum = 0;
    for (const std::uint64_t n : a.histogram()) {
        sum += std::sqrt(4 / kPi * static_cast<double>(n));
    }
    return sum / 2 / static_cast<double>(a.paths());
}

}  // namespace asperity::bench

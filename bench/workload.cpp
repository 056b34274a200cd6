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

}  // namespace

std::vector<Launch> blocked_launch(const Heightfield& surface, int count, std::uint64_t seed) {
    constexpr std::uint64_t kPerBlock = std::uint64_t{kBlock} * kBlock;
    // A prime larger than the number of blocks: k * kStride visits all of them before any again.
    constexpr std::uint64_t kStride = 2654435761;
    const auto columns = static_cast<std::uint64_t>(surface.nx / kBlock);
    const std::uint64_t blocks = columns * static_cast<std::uint64_t>(surface.ny / kBlock);
    const CounterRandom random(seed, 0);
    std::vector<Launch> launch(static_cast<std::size_t>(count));
    for (std::uint64_t k = 0; k < launch.size(); ++k) {
        const std::uint64_t block = k / kPerBlock * kStride % blocks;
        const std::uint64_t inside = k % kPerBlock;
        const auto bits = random.bits(k);
        launch[k] = {
            static_cast<std::int32_t>(block % columns * kBlock + every_second_bit(inside)),
            static_cast<std::int32_t>(block / columns * kBlock + every_second_bit(inside >> 1)),
            static_cast<float>(bits[0] >> 8) * 0x1p-24F,
            static_cast<float>(bits[1] >> 8) * 0x1p-24F};
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

// SPDX-License-Identifier: Apache-2.0
#include "workload.h"

#include <asperity/core/directions.h>
#include <asperity/core/random.h>

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

Vec3 Workload::direction() const {
    return -from_spherical(radians(theta_deg), radians(kPhiDeg));
}

std::vector<StartPoint> blocked_points(const Heightfield& surface, int count, std::uint64_t seed) {
    constexpr std::uint64_t kPerBlock = std::uint64_t{kBlock} * kBlock;
    // A prime larger than the number of blocks: k * kStride visits all of them before any again.
    constexpr std::uint64_t kStride = 2654435761;
    const auto columns = static_cast<std::uint64_t>(surface.nx / kBlock);
    const std::uint64_t blocks = columns * static_cast<std::uint64_t>(surface.ny / kBlock);
    const std::uint64_t first = seed * (static_cast<std::uint64_t>(count) / kPerBlock);
    const CounterRandom random(seed, 0);
    std::vector<StartPoint> points(static_cast<std::size_t>(count));
    for (std::uint64_t k = 0; k < points.size(); ++k) {
        const std::uint64_t block = (first + k / kPerBlock) * kStride % blocks;
        const std::uint64_t inside = k % kPerBlock;
        const auto bits = random.bits(k);
        points[k] = {
            static_cast<std::int32_t>(block % columns * kBlock + every_second_bit(inside)),
            static_cast<std::int32_t>(block / columns * kBlock + every_second_bit(inside >> 1)),
            static_cast<float>(bits[0] >> 8) * 0x1p-24F,
            static_cast<float>(bits[1] >> 8) * 0x1p-24F};
    }
    return points;
}

}  // namespace asperity::bench

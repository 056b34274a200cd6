// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace asperity {

/// Energy is counted in units of 2^-32 of one launched ray, in 64-bit integers: sums are exact and
/// do not depend on their order. Just under 2^32 rays of full energy fit into one sum.
inline constexpr std::uint64_t kRayEnergy = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kMaxRaysPerLayer = kRayEnergy - (std::uint64_t{1} << 20);

/// The energy of a ray of weight `weight` in [0, 1].
inline std::uint64_t to_energy(double weight) {
    // Over a signed integer, which takes one instruction
    return static_cast<std::uint64_t>(
        static_cast<std::int64_t>(weight * static_cast<double>(kRayEnergy) + 0.5));
}

/// `energy` as a fraction of `rays` launched rays; 0 when none was launched.
inline double energy_fraction(std::uint64_t energy, std::uint64_t rays) {
    return rays == 0 ? 0.0
                     : static_cast<double>(energy) /
                           (static_cast<double>(kRayEnergy) * static_cast<double>(rays));
}

}  // namespace asperity

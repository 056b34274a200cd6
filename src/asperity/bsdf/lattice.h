// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>

namespace asperity {

/// Points of the unit square without gaps or clusters: the first coordinate steps by 1 / points,
/// the second by step / points, round the square; two neighbouring Fibonacci numbers (Sloan and Joe
/// 1994, "Lattice methods for multiple integration").
struct FibonacciLattice {
    int points, step;
};
inline constexpr FibonacciLattice kFinestLattice = {121393, 75025}, kFinerLattice = {28657, 17711};
inline constexpr FibonacciLattice kFineLattice = {10946, 6765}, kMediumLattice = {4181, 2584},
                                  kCoarseLattice = {1597, 987};

/// Directional albedo as E[f cos(theta_o) / pdf] over the lattice: with the sampler's own map
/// substituted for the directions, what is left to integrate is smooth however sharp the lobe.
void albedo_by_sampling(const Bsdf& brdf, Vec3 wi, FibonacciLattice lattice, std::span<double> a);

}  // namespace asperity

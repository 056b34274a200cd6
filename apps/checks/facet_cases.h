// SPDX-License-Identifier: Apache-2.0
// Surfaces of few slopes, whose reflection is known by hand, and what a metal does with light.
#pragma once

#include <asperity/core/vec.h>
#include <asperity/gonio/measurement.h>
#include <asperity/optics/optics_settings.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity::checks {

/// Samples on a side of the surfaces here.
inline constexpr int kSide = 64;

/// One optical constant n + i k, as optics settings.
OpticsSettings metal(double n, double k);

/// Exact reflectance for unpolarised light of what has the index n + i k (dielectrics: k = 0),
/// from Fresnel's equations in complex numbers.
double reflectance(double cosine, double n, double k);

/// Ridges of slopes +-a in x plus ridges of slopes +-b in y, a crease every `kSide` / 2 samples,
/// which lie wider in y than in x: four facets, each over a quarter of the tile. b = 0: V-grooves
/// along y.
Heightfield four_slopes(double a, double b);

/// A level tile with a trench of the depth along y, one cell of wall, ground and wall.
Heightfield trench(double depth);

/// A direction into which a share of the light goes, and the cosine between it and the facet.
struct Beam {
    Vec3 wo;
    double share = 0, cosine = 1;
};
/// What each facet of four_slopes(a, b) does with light from `wi`, if all of it lies in the light
/// and nothing stands in the way of what leaves.
std::vector<Beam> beams_of(double a, double b, Vec3 wi);

/// Energy of the cell that a direction falls into, over all orders, as a share of the light.
double energy_towards(const Measurement& m, const Layer& layer, int channel, Vec3 wo);
/// Of one order in the whole row of cells at this polar angle, at azimuths less than a quarter turn
/// from `phi`.
double energy_of_row(const Measurement& m, const Layer& layer, int order, double theta, double phi);

}  // namespace asperity::checks

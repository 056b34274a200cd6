// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/half_vector_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace asperity {

/// What a BakedBrdf looks up; filled by bake_brdf.
///
/// A slice belongs to one incident direction and holds side x side nodes over the square round the
/// disk of half vectors, and the (side - 1)^2 cells between them for the sampling. Anisotropic:
/// half vectors are in the frame of the surface. Isotropic: in that of the incident light, turned
/// to azimuth 0, and there is one azimuth.
struct BakedBrdf::Tables {
    int thetas = 0, phis = 1, side = 0, channels = 1;
    bool isotropic = true;
    HalfVectorMap map;

    /// Per slice (theta * phis + phi), row and column: f (cos_i + cos_o) of each channel, and the
    /// density over the disk with which the cell that begins there is sampled.
    std::vector<float> nodes;
    std::vector<float> rows;   ///< cumulated: share of the slice up to and with this row of cells
    std::vector<float> cells;  ///< cumulated: share of its row up to and with this cell

    /// Between incident angles the table neither keeps the albedo by itself nor need it be right:
    /// what it is multiplied by, and the albedo, at the nodes and in their middles [theta][phi].
    std::vector<float> corrections, albedos;

    /// Steps of `corrections` between two nodes.
    static constexpr int kFine = 2;
    int fine_thetas() const { return (thetas - 1) * kFine + 1; }
    int fine_phis() const { return isotropic ? 1 : phis * kFine; }

    /// Incident light as a place between slices.
    struct Incidence {
        double theta = 0, phi = 0;    ///< in nodes
        double cosine = 1, sine = 0;  ///< of the azimuth that turns into the frame of the slices
    };
    Incidence incidence(Vec3 wi) const;

    /// Cosine of the polar angle that stands at `theta` nodes.
    double cosine_at(double theta) const;
    /// The incident direction at a place between slices.
    Vec3 incident_at(double theta, double phi) const;

    /// The whole part of x >= 0, at most `most`.
    static int whole(double x, int most) { return std::min(static_cast<int>(x), most); }

    /// The slices round an incidence, and their weights.
    template <bool kIsotropic>
    struct Shares {
        static constexpr std::size_t kCount = kIsotropic ? 2 : 4;
        std::array<std::size_t, kCount> slice;
        std::array<double, kCount> weight;
    };
    template <bool kIsotropic>
    Shares<kIsotropic> shares(const Incidence& in) const;

    /// Writes f of kChannels channels and returns the density of the table alone [1/sr].
    template <int kChannels, bool kIsotropic>
    double look(Vec3 wi, Vec3 wo, double* f) const;
    double look(Vec3 wi, Vec3 wo, double* f) const;

    /// Draws wo from the table alone, and its density; wo.z may be below 0.
    template <bool kIsotropic>
    BsdfSample draw(Vec3 wi, double u1, double u2) const;

    /// Interpolates `corrections` or `albedos`.
    template <int kChannels, bool kIsotropic>
    std::array<double, kChannels> at_incidence(const std::vector<float>& values,
                                               const Incidence& in) const;

    std::size_t slices() const {
        return static_cast<std::size_t>(thetas) * static_cast<std::size_t>(phis);
    }
    std::size_t record() const { return static_cast<std::size_t>(channels) + 1; }
    std::size_t nodes_per_slice() const {
        return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    }
    std::size_t cells_per_row() const { return static_cast<std::size_t>(side) - 1; }
    /// Position of a node on the square.
    double position(double node) const { return 2 * node / (side - 1) - 1; }
};

template <bool kIsotropic>
BakedBrdf::Tables::Shares<kIsotropic> BakedBrdf::Tables::shares(const Incidence& in) const {
    const int t = whole(in.theta, thetas - 2);
    const double above = in.theta - t;
    const std::size_t lower = static_cast<std::size_t>(t * phis);
    const std::size_t upper = lower + static_cast<std::size_t>(phis);
    if constexpr (kIsotropic) {
        return {{lower, upper}, {1 - above, above}};
    } else {
        const int p = whole(in.phi, phis - 1);
        const double beyond = in.phi - p;
        const std::size_t left = static_cast<std::size_t>(p);
        const std::size_t right = static_cast<std::size_t>(p + 1 < phis ? p + 1 : 0);
        return {{lower + left, upper + left, lower + right, upper + right},
                {(1 - above) * (1 - beyond), above * (1 - beyond), (1 - above) * beyond,
                 above * beyond}};
    }
}

/// The polar angle as a number that is dense where BRDFs change most, by one square root: 0 along
/// the normal, 1 on the horizon, where neighbours lie five times closer than at the normal.
inline double polar_place(double cosine) {
    const double v = std::sqrt(std::max(0.0, 1 - cosine));
    return 0.5 * (v + v * v * v * v);
}

/// The azimuth as a number in 0 .. 4, by one division: 0 along x, 1 along y.
inline double azimuth_place(double x, double y) {
    const double sum = std::abs(x) + std::abs(y);
    if (!(sum > 0)) return 0;
    const double t = y / sum;
    const double place = x >= 0 ? t : 2 - t;
    return place < 0 ? place + 4 : place;
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <cmath>

namespace asperity {

/// The upper half vectors as a disk of radius 1, without trigonometry.
///
/// The half vector is drawn out by 1 / stretch in x and y, which spreads a lobe of that width over
/// the hemisphere, and then projected stereographically from the lower pole: the normal comes to
/// lie in the middle, slopes of `stretch` at radius 0.41, the horizon at radius 1.
struct HalfVectorMap {
    double stretch = 1;  ///< > 0; about the alpha of the lobe

    /// Where a half vector lies, and what a density over the disk is worth as one over directions.
    struct Place {
        double x = 0, y = 0;
        double density = 0;  ///< d(disk) / d(wo) [1/sr]
    };

    /// `m` = wi + wo, as long as it is, m.z > 0. With n = m / |m| and L the length of m drawn out,
    ///
    ///     d(disk) / d(n drawn out) = (L / (L + m.z))^2           the projection
    ///     d(n drawn out) / d(n) = |m|^3 / (stretch^2 L^3)        the stretch
    ///     d(n) / d(wo) = 1 / (4 wi . n) = 1 / (2 |m|)            the mirror
    Place place(Vec3 m) const {
        const double x = m.x / stretch, y = m.y / stretch;
        const double l = std::sqrt(x * x + y * y + m.z * m.z);
        const double scale = 1 / (l + m.z);
        return {x * scale, y * scale, dot(m, m) * scale * scale / (2 * stretch * stretch * l)};
    }

    /// The half vector at a place, not normalized; z <= 0 on and outside the circle.
    Vec3 half_vector(double x, double y) const {
        return {2 * stretch * x, 2 * stretch * y, 1 - x * x - y * y};
    }

    /// place().density where half_vector() gave h, once light from wi is mirrored at it.
    double density(double x, double y, Vec3 h, Vec3 wi) const {
        const double length2 = dot(h, h);
        return length2 * length2 / (16 * stretch * stretch * (1 + x * x + y * y) * dot(wi, h));
    }
};

}  // namespace asperity

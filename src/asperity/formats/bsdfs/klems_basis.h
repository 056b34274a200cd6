// SPDX-License-Identifier: Apache-2.0
// The patches of Klems: rings of polar angle cut into azimuths (Klems 1994; LBNL's WINDOW).
#pragma once

#include <asperity/core/vec.h>

#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// One of the three hemispheres of patches. Ring 0 is one patch about the normal; patch k of a ring
/// of n is centred at azimuth 360 k / n degrees. Patches are counted ring by ring.
class KlemsBasis {
  public:
    struct Ring {
        double low_deg = 0, high_deg = 0;
        int patches = 0, first = 0;
        double squared_tangent = 0;  ///< of high_deg
        std::vector<double> turns;   ///< [patch] where it ends, as a quarter_turns()
    };

    /// "full" (145 patches), "half" (77) or "quarter" (41); throws Error(Usage, "basis").
    explicit KlemsBasis(std::string_view kind);

    const std::string& name() const { return name_; }  ///< "LBNL/Klems Full"
    const std::vector<Ring>& rings() const { return rings_; }
    int patches() const { return rings_.back().first + rings_.back().patches; }

    /// The patch of a direction of the upper hemisphere.
    int patch_of(Vec3 w) const;
    /// Integral of cos(theta) over a patch [sr]: pi (sin^2 high - sin^2 low) / n.
    double projected_solid_angle(int patch) const;
    /// A direction of a patch; u and v in [0, 1) are uniform in projected solid angle.
    Vec3 direction(int patch, double u, double v) const;

  private:
    const Ring& ring_of(int patch) const;

    std::string name_;
    std::vector<Ring> rings_;
};

/// Klems files count the patches of incident light by where it goes on to: the azimuth of wi turned
/// by 180 degrees, so that the mirror direction has the same number.
inline Vec3 klems_incident(Vec3 wi) {
    return {-wi.x, -wi.y, wi.z};
}

}  // namespace asperity::io

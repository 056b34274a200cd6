// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <functional>
#include <vector>

namespace asperity {

/// A rectangular field stop as its lens sees it: full angles in the plane of incidence and across
/// it [degrees].
struct Aperture {
    double in_plane = 0, across = 0;
};

/// Source and receptor of a glossmeter. The source's directions are spread evenly over a flat
/// aperture, and so much light comes from each of them, whatever the angle at the specimen.
struct GlossGeometry {
    double angle_deg = 60;  ///< of the axes from the normal
    Aperture source, receptor;
};

/// 20, 60 and 85 degrees of ISO 2813:2014 and ASTM D523-14: source 0.75 x 2.5, receptors 1.8 x 3.6,
/// 4.4 x 11.7 and 4.0 x 6.0. Throws Error(Usage, "geometry") for another angle.
GlossGeometry standard_gloss_geometry(double angle_deg);

/// The index of the glass that has 100 gloss units, at 587.6 nm.
inline constexpr double kGlossIndex = 1.567;

/// The instrument over a specimen whose normal is z, light coming from the azimuth 0: the plane of
/// incidence is that of x and z.
class GlossOptics {
  public:
    explicit GlossOptics(const GlossGeometry& geometry);

    /// Towards a place of the source, u and v in [0, 1): unit vector.
    Vec3 source_direction(double u, double v) const;
    /// Whether light that leaves along the unit vector `wo` comes into the receptor.
    bool receives(Vec3 wo) const { return receives(wo, 0); }
    /// The same for one of the receptor's size whose axis lies `off_deg` further from the normal.
    bool receives(Vec3 wo, double off_deg) const;
    /// The mean over the source of the reflectance of smooth glass of this index.
    double glass(double index) const;
    /// The mean over the source of the integral of f(wi, wo) cos theta_o over the receptor: the
    /// share of the light that a BRDF sends there. By `steps` points along each side.
    double share(const std::function<double(Vec3 wi, Vec3 wo)>& f, int steps = 8) const;

  private:
    struct Axis {
        Vec3 along, in_plane;
    };
    static Axis axis_at(double angle, double side);

    GlossGeometry geometry_;
    Axis source_;
};

}  // namespace asperity

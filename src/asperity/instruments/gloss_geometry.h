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
    /// Of the axes of two more receptors of the same size, to either side of the first in the plane
    /// of incidence; 0 = there are none.
    double aside_deg = 0;
};

/// 20, 60 and 85 degrees of ISO 2813:2014 and ASTM D523-14: source 0.75 x 2.5, receptors 1.8 x 3.6,
/// 4.4 x 11.7 and 4.0 x 6.0; at 20 degrees with the receptors of haze, 1.9 degrees aside, taken to
/// be as large as that of the gloss (ISO 13803, ASTM E430 method B have these angles). Throws
/// Error(Usage, "geometry") for another angle.
GlossGeometry standard_gloss_geometry(double angle_deg);

/// Distinctness of image as ASTM E430 and D5767 have it: light in the mirror direction beside light
/// 0.3 degrees from it. How wide source and receptors are differs from instrument to instrument and
/// decides the figure, so nothing is assumed of them.
struct DoiSettings {
    double source_deg = 0;    ///< width of the source in the plane of incidence; 0 = no DOI
    double receptor_deg = 0;  ///< of each receptor
    double angle_deg = 30;    ///< of the axes from the normal, 5 to 80
};

/// Slits 2.5 (source) and 5 degrees (receptors) long across the plane. Throws Error(Usage, "doi")
/// unless the widths are positive and together below twice 0.3 degrees, above which a perfect
/// mirror would not have 100, and Error(Usage, "doi-angle").
GlossGeometry doi_geometry(const DoiSettings& settings);

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
    /// Into one of the two receptors aside.
    bool receives_aside(Vec3 wo) const {
        return receives(wo, geometry_.aside_deg) || receives(wo, -geometry_.aside_deg);
    }
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
    bool receives(Vec3 wo, double off_deg) const;

    GlossGeometry geometry_;
    Axis source_;
};

}  // namespace asperity

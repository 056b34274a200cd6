// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/experiment.h>
#include <asperity/instruments/gloss_geometry.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/heightfield.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

struct GlossSettings {
    std::vector<double> angles_deg = {20, 60, 85};
    double azimuth_deg = 0;     ///< of the light: the instrument turned on the specimen
    bool all_azimuths = false;  ///< each ray has one of its own
    DoiSettings doi = {};
    RunSettings run =
        {};  ///< rays are per geometry; `until` is the error of gloss, and of DOI / 100
};

/// A figure of one channel and its standard error.
struct WithError {
    double value = 0, error = 0;
};

struct GlossReading {
    GlossGeometry geometry;
    std::vector<WithError> gloss;  ///< gloss units, by channel
    /// At 20 degrees, else empty: 100 times what the two receptors aside see together, over what
    /// the receptor between them would see of the glass of 100 gloss units (ISO 13803 and ASTM E430
    /// method B).
    std::vector<WithError> haze;
    std::vector<WithError> reflectance;  ///< directional-hemispherical, over all directions
    double truncated = 0;  ///< share of the light that still travelled after all reflections
    double edge = 0;       ///< share that left through the side of a finite patch
    std::uint64_t rays = 0;
};

/// Distinctness of image, 100 (1 - R_aside / R_mirror): R_mirror what the receptor in the mirror
/// direction sees, R_aside the mean of those 0.3 degrees to either side. 100 for a perfect mirror.
struct DoiReading {
    GlossGeometry geometry;
    std::vector<WithError> doi;  ///< by channel; empty where the narrow receptor saw too little
    std::uint64_t rays = 0;
};

struct GlossReport {
    std::vector<std::string> channel_names;
    std::vector<GlossReading> readings;  ///< in the order of the angles
    /// By channel: the haze index of ASTM D4039, the gloss at 60 degrees less that at 20. Empty
    /// unless both were read of a dielectric; meant for 70 gloss units and more at 60 degrees.
    std::vector<WithError> haze_index;
    std::optional<DoiReading> doi;  ///< where the settings ask for it
    std::vector<std::string> notes;
    bool stopped = false;  ///< the readings hold what was done, none of fewer than two batches
};

/// A virtual glossmeter: light from the source's aperture falls on the surface, is followed from
/// facet to facet, and counts where it leaves into the receptor's.
///
/// Same bits for any number of threads. Errors are those of independent batches; a surface of few
/// patches has an error of its own on top, which they do not know. Throws Error(Usage, "name of the
/// setting") and what check_scale() throws. Stage "tracing", in rays.
/// Source: ISO 2813:2014, ASTM D523-14; docs/topographies.md.
GlossReport measure_gloss(const Heightfield& surface, const OpticsSettings& optics,
                          const GlossSettings& settings, Run& run);

/// Total integrated scatter: the share of the reflected light that a surface of Gaussian heights
/// sends out of the mirror direction by interference, 1 - exp(-(4 pi Sq cos theta / lambda)^2).
double total_integrated_scatter(double rms_height, double wavelength, double theta);

}  // namespace asperity

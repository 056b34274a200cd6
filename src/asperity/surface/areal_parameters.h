// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <optional>

namespace asperity {

/// Areal surface texture parameters of ISO 25178-2:2021, of the surface as it stands: the S-F
/// surface when prepare() took a form off, the S-L surface when it took an L-filter too. Lengths
/// and heights in the unit of the surface; heights about their mean.
struct ArealParameters {
    double sa = 0;  ///< mean size of the heights
    double sq = 0;  ///< root mean square of the heights
    double sp = 0;  ///< highest peak above the mean
    double sv = 0;  ///< depth of the deepest pit below the mean, positive
    double sz = 0;  ///< sp + sv
    double ssk = 0, sku = 0;
    double sdq = 0;  ///< RMS gradient over the facets
    double sdr = 0;  ///< true area over projected area, less 1, exact for the facets

    /// Autocorrelation length: where the autocorrelation falls to 0.2 first, in the direction of
    /// its fastest fall. Nothing for a flat surface.
    std::optional<double> sal;
    /// Texture aspect ratio: sal over the distance of the slowest fall to 0.2, 1 for a surface that
    /// is alike in all directions. Nothing where it does not fall so far within half the width.
    std::optional<double> str;
    /// Texture direction [degrees, -90 < . <= 90], counter-clockwise from x in a picture with row 0
    /// on top: along the lay, across which most of the power lies.
    std::optional<double> std_deg;

    /// Of the material ratio curve (ISO 25178-2, 4.5): core height, reduced peak height and pit
    /// depth; material ratios at the ends of the core [%].
    double sk = 0, spk = 0, svk = 0, smr1 = 0, smr2 = 0;
};

/// Heights count once a sample, slopes once a facet; a periodic surface goes on beyond its edges,
/// the autocorrelation of one with edges is a mean over the part that overlaps with itself. Cost:
/// three Fourier transforms and a sort. Same value for any number of threads. Throws
/// Error(Stopped). sal, str and std_deg are left out above kMostTransformed samples.
ArealParameters areal_parameters(const Heightfield& surface, Run& run);

inline constexpr std::uint64_t kMostTransformed = std::uint64_t{1} << 26;

}  // namespace asperity

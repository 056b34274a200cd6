// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/length.h>

#include <cstdint>
#include <optional>

namespace asperity {

/// What happens to points where nothing was measured.
enum class Fill {
    Auto,     ///< Smooth up to kMostFilled of the points of a file that is not Asperity's own, else
              ///< the file is refused
    None,     ///< a file with missing points is refused
    Nearest,  ///< the height of the nearest measured point
    Smooth,   ///< a soap film over the hole: Laplace's equation, about the mean plane
};
inline constexpr double kMostFilled = 0.05;

/// The form that is taken off: a polynomial of this order in x and y, fitted by least squares to
/// the measured points (the F-operation of ISO 25178-2).
enum class Level {
    Auto,  ///< Plane for a measurement, see is_measurement(); else None
    None,
    Mean,
    Plane,
    Order2,
    Order3,
};

/// A rectangle of a topography, from the left edge and from the top edge.
struct Crop {
    Length x, y, width, height;
};

/// What is done to a measurement before light falls on it. The steps are taken in this order:
/// outliers and missing points, form, S-filter, L-filter, crop, resampling.
struct Preparation {
    Fill fill = Fill::Auto;
    /// A point that differs from the median of the 5 x 5 points around it by more than so many
    /// deviations is filled like a missing one; a deviation is 1.4826 times the median of all such
    /// differences. 0: none is an outlier.
    double outliers = 0;
    Level level = Level::Auto;
    std::optional<Length> filter_s;  ///< cut-off of the S-filter: shorter waves are taken off
    std::optional<Length> filter_l;  ///< cut-off of the L-filter: longer waves are taken off
    std::optional<Crop> crop;
    /// Samples along x; along y as many as keep the shape of a cell. 0: as they are.
    std::uint64_t resample = 0;
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/preparation.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace asperity {

/// The kind of a surface that is read from a file, not made.
inline constexpr const char* kSurfaceFile = "file";

/// How neighbouring heights of a Gaussian surface are related.
enum class Autocorrelation {
    Gaussian,     ///< exp(-r^2 / L^2)
    Exponential,  ///< exp(-r / L), cut at the grid's own frequency (its slope has no other bound)
    SelfAffine,   ///< power spectrum 1 / (1 + (k L)^2)^(1 + hurst), cut likewise
};

/// How a surface file is made to fill the plane.
enum class Tiling {
    Auto,      ///< Periodic when the file says so or its opposite edges fit, else Mirrored
    Mirrored,  ///< the samples and their mirror images: (2 nx - 2) x (2 ny - 2) samples
    Periodic,  ///< taken as it is: the file repeats
    Finite,    ///< a patch with edges
};

/// Everything that decides a surface. Lengths are in cells (multiples of dx) unless said otherwise.
///
/// Slopes (alpha, tilt) are true slopes, whatever the size of a cell: heights, dx and dy share one
/// unit, and heights are made in multiples of dx. height_scale comes last and so changes slopes.
/// One of cell_x, cell_y given alone counts for both.
///
/// How a gaussian surface meets alpha_x, alpha_y and the correlation lengths, which are not
/// independent (a Gaussian autocorrelation of RMS height s has alpha_x = 2 s / Lx, alpha_y =
/// 2 s / Ly):
/// 1. correlation_x is taken as it is.
/// 2. correlation_x == correlation_y and alpha_x != alpha_y: the length along y is chosen so that
///    the expected facet slopes have the ratio asked for.
/// 3. correlation_x != correlation_y: both lengths are kept, and they decide the ratio.
/// 4. The heights are scaled so that the measured facets have the RMS gradient
///    sqrt((alpha_x^2 + alpha_y^2) / 2) exactly. With 1 and 2 each alpha is then met but for the
///    chance of a finite tile, about 0.7 L / side.
/// A ggx surface starts from rules 1 and 2 and meets both alphas; it takes one correlation length.
struct SurfaceSettings {
    std::string kind = "thesis";  ///< a row of surface_kinds(), or kSurfaceFile
    int size = 512;          ///< samples on a side, 2 .. kMaxSurfaceSide (files bring their own)
    double roughness = 0.2;  ///< thesis: 0 .. 1
    double alpha_x = 0.3,
           alpha_y = 0.3;  ///< gaussian, ggx: width of slope distribution, 1e-4 .. 100
    Autocorrelation autocorrelation = Autocorrelation::Gaussian;
    double correlation_x = 8, correlation_y = 8;  ///< [cells], 0.1 .. the side of the tile
    double hurst = 0.8;                           ///< self-affine: 0 < hurst <= 1
    double max_slope = 10;  ///< ggx: steeper facets are cut to this slope (84.3 degrees), > alpha
    std::uint64_t seed = 1;
    double tilt_deg = 45;  ///< facet tilt of tilted, vgroove, sawtooth and pyramids, 0 <= . < 90
    int period = 16;  ///< of shapes [cells]; divides size; even for vgroove, pyramids; waves >= 4
    double amplitude = 1;  ///< of sinusoid and eggcrate [cells]
    bool along_y = false;  ///< tilted, vgroove, sawtooth, sinusoid vary along y, not along x
    std::string file;      ///< kind kSurfaceFile
    std::string file_format, file_channel, file_decimal;  ///< kind kSurfaceFile: HeightsOptions
    Preparation ready = {};                               ///< kind kSurfaceFile
    Length wavelength = {550, "nm"};  ///< kind kSurfaceFile, in metres: is geometric optics right?
    Tiling tiling = Tiling::Auto;     ///< kind kSurfaceFile
    std::optional<double> cell_x, cell_y;  ///< spacing; default 1 cell, or what the file says;
                                           ///< sides differ by 100 times at most
    double height_scale = 1;  ///< multiplies the heights after all else; negative turns them over
    Diagonal diagonal = Diagonal::Anti;
    Boundary boundary = Boundary::Periodic;  ///< Finite: the made surface as a patch with edges
    /// Values of settings that only one kind has, by name; those not in it have their defaults. See
    /// own_field().
    std::map<std::string, ParamValue, std::less<>> own = {};
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <cstdint>
#include <optional>
#include <string>

namespace asperity {

/// The families of surfaces Asperity makes or reads.
enum class SurfaceKind {
    Thesis,    ///< independent heights, uniform in [0, 10 roughness] cells (thesis 2.2.2)
    Gaussian,  ///< Gaussian height field of given alpha and autocorrelation
    Ggx,       ///< heights whose facet normals follow GGX
    Flat,      ///< h = 0
    Tilted,    ///< one facet over the whole tile, its return in the last cell
    VGroove,   ///< symmetric grooves
    Sawtooth,  ///< one long facet a period, its return in one cell
    Pyramids,  ///< h = s (tri(x) + tri(y)): facets of slope (+-s, +-s), all creases on grid lines
    Sinusoid,  ///< amplitude sin(2 pi x / period)
    Eggcrate,  ///< amplitude (sin(2 pi x / period) + sin(2 pi y / period)) / 2
    File,      ///< read from `file`
};

/// How neighbouring heights of a Gaussian surface are related.
enum class Autocorrelation {
    Gaussian,     ///< exp(-r^2 / L^2)
    Exponential,  ///< exp(-r / L), cut at the grid's own frequency (its slope has no other bound)
    SelfAffine,   ///< power spectrum 1 / (1 + (k L)^2)^(1 + hurst), cut likewise
};

/// How a surface file that does not repeat is made to fill the plane.
enum class Tiling {
    Mirrored,  ///< the samples and their mirror images: 2 nx x 2 ny samples, periodic
    Periodic,  ///< taken as it is: the file repeats
    Finite,    ///< a patch with edges
};

/// Everything that decides a surface. Lengths are in cells (multiples of dx) unless said otherwise.
struct SurfaceSettings {
    SurfaceKind kind = SurfaceKind::Thesis;
    int size = 512;        ///< samples on a side, 2 .. kMaxSurfaceSide (files bring their own)
    double roughness = 0.2;              ///< thesis: 0 .. 1
    double alpha_x = 0.3, alpha_y = 0.3;  ///< gaussian, ggx: width of the slope distribution, > 0
    Autocorrelation autocorrelation = Autocorrelation::Gaussian;
    double correlation_x = 8, correlation_y = 8;  ///< correlation lengths [cells]
    double hurst = 0.8;                           ///< self-affine: 0 < hurst <= 1
    double max_slope = 10;  ///< ggx: steeper facets are cut to this slope (84.3 degrees)
    std::uint64_t seed = 1;
    double tilt_deg = 45;     ///< facet tilt of tilted, vgroove, sawtooth and pyramids, 0 <= . < 90
    int period = 16;          ///< of shapes [cells]; must divide size, even where shapes need it
    double amplitude = 1;     ///< of sinusoid and eggcrate [cells]
    bool along_y = false;     ///< tilted, vgroove, sawtooth, sinusoid vary along y, not along x
    std::string file;         ///< kind File
    Tiling tiling = Tiling::Mirrored;      ///< kind File
    std::optional<double> cell_x, cell_y;  ///< spacing; default 1 cell, or what the file says
    double height_scale = 1;               ///< multiplies the heights after all else
    Diagonal diagonal = Diagonal::Anti;
    Boundary boundary = Boundary::Periodic;  ///< Finite: the made surface as a patch with edges
};

}  // namespace asperity

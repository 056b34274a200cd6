// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace asperity {

/// Complex refractive index n + i k against air.
struct ComplexIndex {
    double n = 1, k = 0;
};

/// Wavelengths a material is known for [nm].
inline constexpr double kMinWavelength = 400, kMaxWavelength = 700;

/// One measured point of a material.
struct MaterialPoint {
    double wavelength_nm, n, k;
};

/// A metal with a measured index: a row of materials().
struct TabulatedMaterial {
    std::string_view symbol;  ///< in settings: "Au"
    std::string_view name;    ///< in lists and forms: "Gold"
    std::string_view source;  ///< the publication behind the numbers, one line
    /// By rising wavelength, from below kMinWavelength to above kMaxWavelength.
    std::span<const MaterialPoint> points;
};

/// All of them, in alphabetical order of their symbols.
std::span<const TabulatedMaterial> materials();

/// Index of a metal at `wavelength_nm`, linear between the measured points.
///
/// Throws Error(Usage, "material") for a symbol that is not in materials(), Error(Usage,
/// "wavelengths") outside kMinWavelength .. kMaxWavelength.
/// Sources: Johnson and Christy, Phys. Rev. B 6, 4370 (1972) for Ag, Au, Cu; Johnson and Christy,
/// Phys. Rev. B 9, 5056 (1974) for Cr, Fe, Ni, Ti; Rakic, Appl. Opt. 34, 4755 (1995) for Al; the
/// numbers as in the refractiveindex.info database (CC0 1.0).
ComplexIndex refractive_index(std::string_view material, double wavelength_nm);

}  // namespace asperity

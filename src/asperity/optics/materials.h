// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace asperity {

/// Complex refractive index n + i k against air.
struct ComplexIndex {
    double n = 1, k = 0;
};

/// Wavelengths a material is known for [nm].
inline constexpr double kMinWavelength = 400, kMaxWavelength = 700;

/// The names refractive_index() knows, in alphabetical order.
std::span<const std::string_view> material_names();

/// Index of a metal at `wavelength_nm`, linear between the measured points.
///
/// Throws Error(Usage, "material") for a name that is not in material_names(), Error(Usage,
/// "wavelengths") outside kMinWavelength .. kMaxWavelength.
/// Sources: Johnson and Christy, Phys. Rev. B 6, 4370 (1972) for Ag, Au, Cu; Johnson and Christy,
/// Phys. Rev. B 9, 5056 (1974) for Cr, Fe, Ni, Ti; Rakic, Appl. Opt. 34, 4755 (1995) for Al; the
/// numbers as in the refractiveindex.info database (CC0 1.0).
ComplexIndex refractive_index(std::string_view material, double wavelength_nm);

/// The publication behind the numbers of a material, one line; throws as refractive_index.
std::string material_source(std::string_view material);

}  // namespace asperity

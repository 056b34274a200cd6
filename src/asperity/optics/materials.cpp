// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/materials.h>

#include <fmt/format.h>

#include <array>
#include <string>

namespace asperity {
namespace {

using Point = MaterialPoint;

constexpr std::string_view kJohnson1972 =
    "P. B. Johnson and R. W. Christy, Optical constants of the noble metals, "
    "Phys. Rev. B 6, 4370-4379 (1972)";
constexpr std::string_view kJohnson1974 =
    "P. B. Johnson and R. W. Christy, Optical constants of transition metals, "
    "Phys. Rev. B 9, 5056-5070 (1974)";
constexpr std::string_view kRakic1995 =
    "A. D. Rakic, Algorithm for the determination of intrinsic optical constants of metal films: "
    "application to aluminum, Appl. Opt. 34, 4755-4767 (1995)";

// Measured points from the last one below 400 nm to the first one above 700 nm.
// clang-format off
constexpr std::array kAg = {
    Point{397.4, 0.05, 2.070}, Point{413.3, 0.05, 2.275}, Point{430.5, 0.04, 2.462},
    Point{450.9, 0.04, 2.657}, Point{471.4, 0.05, 2.869}, Point{495.9, 0.05, 3.093},
    Point{520.9, 0.05, 3.324}, Point{548.6, 0.06, 3.586}, Point{582.1, 0.05, 3.858},
    Point{616.8, 0.06, 4.152}, Point{659.5, 0.05, 4.483}, Point{704.5, 0.04, 4.838}};
constexpr std::array kAl = {
    Point{364.66, 0.39877, 4.3957}, Point{413.28, 0.52135, 5.0008}, Point{442.80, 0.60790, 5.3676},
    Point{476.87, 0.72780, 5.7781}, Point{516.60, 0.87340, 6.2418}, Point{563.57, 1.07280, 6.7839},
    Point{619.93, 1.36600, 7.4052}, Point{652.25, 1.57240, 7.7354}, Point{688.81, 1.83010, 8.0601},
    Point{729.32, 2.16060, 8.3565}};
constexpr std::array kAu = {
    Point{397.4, 1.47, 1.952}, Point{413.3, 1.46, 1.958}, Point{430.5, 1.45, 1.948},
    Point{450.9, 1.38, 1.914}, Point{471.4, 1.31, 1.849}, Point{495.9, 1.04, 1.833},
    Point{520.9, 0.62, 2.081}, Point{548.6, 0.43, 2.455}, Point{582.1, 0.29, 2.863},
    Point{616.8, 0.21, 3.272}, Point{659.5, 0.14, 3.697}, Point{704.5, 0.13, 4.103}};
constexpr std::array kCr = {
    Point{397, 2.00, 2.83}, Point{413, 2.08, 2.93}, Point{431, 2.19, 3.04}, Point{451, 2.33, 3.14},
    Point{471, 2.51, 3.24}, Point{496, 2.75, 3.30}, Point{521, 2.94, 3.33}, Point{549, 3.18, 3.33},
    Point{582, 3.22, 3.30}, Point{617, 3.17, 3.30}, Point{659, 3.09, 3.34}, Point{704, 3.05, 3.39}};
constexpr std::array kCu = {
    Point{397.4, 1.32, 2.116}, Point{413.3, 1.28, 2.207}, Point{430.5, 1.25, 2.305},
    Point{450.9, 1.24, 2.397}, Point{471.4, 1.25, 2.483}, Point{495.9, 1.22, 2.564},
    Point{520.9, 1.18, 2.608}, Point{548.6, 1.02, 2.577}, Point{582.1, 0.70, 2.704},
    Point{616.8, 0.30, 3.205}, Point{659.5, 0.22, 3.747}, Point{704.5, 0.21, 4.205}};
constexpr std::array kFe = {
    Point{397, 2.24, 2.58}, Point{413, 2.35, 2.65}, Point{431, 2.48, 2.71}, Point{451, 2.59, 2.77},
    Point{471, 2.67, 2.82}, Point{496, 2.74, 2.88}, Point{521, 2.86, 2.91}, Point{549, 2.95, 2.93},
    Point{582, 2.94, 2.99}, Point{617, 2.88, 3.05}, Point{659, 2.92, 3.10}, Point{704, 2.86, 3.19}};
constexpr std::array kNi = {
    Point{397, 1.72, 2.57}, Point{413, 1.70, 2.69}, Point{431, 1.71, 2.82}, Point{451, 1.73, 2.95},
    Point{471, 1.78, 3.09}, Point{496, 1.82, 3.25}, Point{521, 1.85, 3.42}, Point{549, 1.92, 3.61},
    Point{582, 1.96, 3.80}, Point{617, 1.99, 4.02}, Point{659, 1.99, 4.26}, Point{704, 2.06, 4.50}};
constexpr std::array kTi = {
    Point{397, 2.08, 2.95}, Point{413, 2.14, 2.98}, Point{431, 2.21, 3.01}, Point{451, 2.27, 3.04},
    Point{471, 2.32, 3.10}, Point{496, 2.36, 3.19}, Point{521, 2.44, 3.30}, Point{549, 2.54, 3.43},
    Point{582, 2.60, 3.58}, Point{617, 2.67, 3.72}, Point{659, 2.76, 3.84}, Point{704, 2.86, 3.96}};
// clang-format on

constexpr TabulatedMaterial kMaterials[] = {
    {"Ag", "Silver", kJohnson1972, kAg}, {"Al", "Aluminium", kRakic1995, kAl},
    {"Au", "Gold", kJohnson1972, kAu},   {"Cr", "Chrome", kJohnson1974, kCr},
    {"Cu", "Copper", kJohnson1972, kCu}, {"Fe", "Iron", kJohnson1974, kFe},
    {"Ni", "Nickel", kJohnson1974, kNi}, {"Ti", "Titanium", kJohnson1974, kTi},
};

std::string lower(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return small;
}

/// For who writes au or gold.
std::string cure(std::string_view typed) {
    for (const TabulatedMaterial& material : kMaterials)
        if (lower(typed) == lower(material.symbol) || lower(typed) == lower(material.name))
            return fmt::format("; did you mean {}?", material.symbol);
    return {};
}

const TabulatedMaterial& find_material(std::string_view symbol) {
    std::string symbols;
    for (const TabulatedMaterial& material : kMaterials) {
        if (material.symbol == symbol) return material;
        symbols += (symbols.empty() ? "" : ", ") + std::string(material.symbol);
    }
    throw Error(ErrorCode::Usage,
                fmt::format("\"{}\" is not known; there are {}{}", symbol, symbols, cure(symbol)),
                "material");
}

}  // namespace

std::span<const TabulatedMaterial> materials() {
    return kMaterials;
}

ComplexIndex refractive_index(std::string_view material, double wavelength_nm) {
    const std::span<const Point> points = find_material(material).points;
    if (!(wavelength_nm >= kMinWavelength && wavelength_nm <= kMaxWavelength))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} nm lies outside the {} to {} nm that materials are known for",
                                wavelength_nm, kMinWavelength, kMaxWavelength),
                    "wavelengths");

    // The tables reach beyond both ends, so there is always a point on either side.
    std::size_t right = 1;
    while (points[right].wavelength_nm < wavelength_nm) ++right;
    const Point& a = points[right - 1];
    const Point& b = points[right];
    const double t = (wavelength_nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
    return {a.n + t * (b.n - a.n), a.k + t * (b.k - a.k)};
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include "facet_cases.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace asperity::checks {

OpticsSettings metal(double n, double k) {
    OpticsSettings optics;
    optics.fresnel = FresnelKind::Conductor;
    optics.ior = {n};
    optics.k = {k};
    return optics;
}

double reflectance(double cosine, double n, double k) {
    const std::complex<double> index2 = std::complex<double>(n, k) * std::complex<double>(n, k);
    // n cos of the refracted direction, by Snell's law
    const std::complex<double> inside = std::sqrt(index2 - (1 - cosine * cosine));
    const double s = std::norm((cosine - inside) / (cosine + inside));
    const double p = std::norm((index2 * cosine - inside) / (index2 * cosine + inside));
    return (s + p) / 2;
}

Heightfield four_slopes(double a, double b) {
    Heightfield surface;
    surface.name = "four slopes";
    surface.nx = surface.ny = kSide;
    surface.dy = 1.5;
    const auto ridge = [](int i) { return std::min(i, kSide - i); };
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            surface.heights.push_back(
                static_cast<float>(a * ridge(i) * surface.dx + b * ridge(j) * surface.dy));
    return surface;
}

Heightfield trench(double depth) {
    Heightfield surface;
    surface.name = "trench";
    surface.nx = surface.ny = kSide;
    for (int k = 0; k < kSide * kSide; ++k) {
        const int i = k % kSide;
        surface.heights.push_back(static_cast<float>(i == 1 || i == 2 ? -depth : 0));
    }
    return surface;
}

std::vector<Beam> beams_of(double a, double b, Vec3 wi) {
    std::vector<Beam> beams;
    for (const double slope_x : {a, -a})
        for (const double slope_y : {b, -b}) {
            // The light on a facet is as its area seen from the light
            const double x = -slope_x, y = -slope_y;
            const double seen = wi.x * x + wi.y * y + wi.z, length = std::sqrt(x * x + y * y + 1);
            const double twice = 2 * seen / (length * length);
            beams.push_back({{twice * x - wi.x, twice * y - wi.y, twice - wi.z},
                             seen / wi.z / 4,
                             seen / length});
        }
    return beams;
}

double energy_towards(const Measurement& m, const Layer& layer, int channel, Vec3 wo) {
    return m.energy(layer, channel, m.detector.cell_of(wo));
}

double energy_of_row(const Measurement& m, const Layer& layer, int order, double theta,
                     double phi) {
    const int row = m.detector.cell_of(from_spherical(theta, 0)) / m.detector.columns();
    double sum = 0;
    for (int column = 0; column < m.detector.columns(); ++column)
        if (std::cos(m.detector.phi_centre(column) - phi) > 0)
            sum += m.energy(layer, order, 0, row * m.detector.columns() + column);
    return sum;
}

}  // namespace asperity::checks

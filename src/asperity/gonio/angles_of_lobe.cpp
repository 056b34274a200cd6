// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/optics/fresnel.h>
#include <asperity/surface/statistics.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr double kWidest = 10, kClosest = 1.5;  // between neighbours, far from the horizon [deg]
constexpr double kSteep = 0.6;                  // alpha from which on they are closer
constexpr double kShare = 0.4;     // of the way to the horizon that the next layer takes
constexpr double kMissed = 0.015;  // of the reflectance, half way between two layers

/// Mean reflectance of the channels at an angle of incidence [degrees].
double reflectance(const Fresnel& fresnel, double theta_deg) {
    std::vector<double> f(static_cast<std::size_t>(fresnel.channels()));
    fresnel.eval(std::cos(radians(std::min(theta_deg, 90.0))), f);
    double sum = 0;
    for (const double value : f) sum += value;
    return sum / static_cast<double>(f.size());
}

/// How wide a step [degrees] may be in which a straight line takes the place of the reflectance: it
/// misses h^2 |R''| / 8 in the middle.
double widest_for(const Fresnel& fresnel, double theta_deg) {
    constexpr double kSpan = 2;
    const double r = reflectance(fresnel, theta_deg);
    const double bend = reflectance(fresnel, std::abs(theta_deg - kSpan)) - 2 * r +
                        reflectance(fresnel, theta_deg + kSpan);
    if (!(std::abs(bend) > 0)) return kWidest;
    return std::max(kClosest, kSpan * std::sqrt(8 * kMissed * r / std::abs(bend)));
}

/// Short numbers to read, and the same ones whatever the last bits of the slopes are.
double rounded(double theta_deg) {
    const double unit = 90 - theta_deg > 3 ? 10 : 100;
    return std::round(theta_deg * unit) / unit;
}

}  // namespace

std::vector<double> angles_of_lobe(double rms_gradient, const OpticsSettings& optics) {
    const Fresnel fresnel(optics);
    const double steep = std::max(1.0, std::sqrt(rms_gradient / kSteep));
    const double widest = std::max(kWidest / 2, kWidest / steep);
    // Shadows change with cot(theta) / alpha: nothing is left of that closer to the horizon
    const double nearest = std::clamp(degrees(rms_gradient) / 8, 0.05, 0.25);
    std::vector<double> angles = {0};
    while (90 - angles.back() > nearest) {
        const double theta = angles.back();
        const double step =
            std::min({widest, kShare * (90 - theta), widest_for(fresnel, theta + 1)});
        angles.push_back(rounded(theta + step));
    }
    return angles;
}

Experiment with_angles(const Heightfield& surface, const Experiment& experiment, const Run& run) {
    Experiment chosen = experiment;
    IlluminationSettings& light = chosen.illumination;
    if (light.layers == 0 && light.theta_deg.empty())
        light.theta_deg = angles_of_lobe(statistics(surface, run).rms_gradient, experiment.optics);
    return chosen;
}

}  // namespace asperity

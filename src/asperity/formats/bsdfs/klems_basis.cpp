// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/klems_basis.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

double square_of_sine(double angle_deg) {
    const double s = std::sin(radians(angle_deg));
    return s * s;
}

}  // namespace

KlemsBasis::KlemsBasis(std::string_view kind) {
    std::vector<double> bounds;
    std::vector<int> counts;
    if (kind == "full") {
        name_ = "LBNL/Klems Full";
        bounds = {0, 5, 15, 25, 35, 45, 55, 65, 75, 90};
        counts = {1, 8, 16, 20, 24, 24, 24, 16, 12};
    } else if (kind == "half") {
        name_ = "LBNL/Klems Half";
        bounds = {0, 6.5, 19.5, 32.5, 45.5, 58.5, 71.5, 90};
        counts = {1, 8, 12, 16, 20, 12, 8};
    } else if (kind == "quarter") {
        name_ = "LBNL/Klems Quarter";
        bounds = {0, 9, 27, 45, 63, 90};
        counts = {1, 8, 12, 12, 8};
    } else {
        throw Error(ErrorCode::Usage, "is none of full, half, quarter", "basis");
    }
    int first = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        rings_.push_back({bounds[k], bounds[k + 1], counts[k], first});
        first += counts[k];
    }
}

int KlemsBasis::patch_of(Vec3 w) const {
    const double theta = degrees(polar_angle(w));
    const Ring* ring = &rings_.back();
    for (const Ring& r : rings_)
        if (theta < r.high_deg) {
            ring = &r;
            break;
        }
    const int k = static_cast<int>(std::floor(azimuth(w) / (2 * kPi) * ring->patches + 0.5));
    return ring->first + k % ring->patches;
}

const KlemsBasis::Ring& KlemsBasis::ring_of(int patch) const {
    for (const Ring& r : rings_)
        if (patch < r.first + r.patches) return r;
    return rings_.back();
}

double KlemsBasis::projected_solid_angle(int patch) const {
    const Ring& r = ring_of(patch);
    return kPi * (square_of_sine(r.high_deg) - square_of_sine(r.low_deg)) / r.patches;
}

Vec3 KlemsBasis::direction(int patch, double u, double v) const {
    const Ring& r = ring_of(patch);
    const double low = square_of_sine(r.low_deg), high = square_of_sine(r.high_deg);
    const double s = std::sqrt(low + u * (high - low));
    const double phi = 2 * kPi * (patch - r.first + v - 0.5) / r.patches;
    return {s * std::cos(phi), s * std::sin(phi), std::sqrt(std::max(0.0, 1 - s * s))};
}

}  // namespace asperity::io

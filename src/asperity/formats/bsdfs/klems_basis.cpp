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

/// Grows with the azimuth of (x, y), from 0 to 4: what finds a patch without a call of atan2.
double quarter_turns(double x, double y) {
    const double size = std::abs(x) + std::abs(y);
    if (size == 0) return 0;
    const double t = y / size;
    if (x < 0) return 2 - t;
    return y < 0 ? 4 + t : t;
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
        const double tangent = std::tan(radians(bounds[k + 1]));
        rings_.push_back({bounds[k], bounds[k + 1], counts[k], first, tangent * tangent, {}});
        for (int patch = 0; patch < counts[k]; ++patch) {
            const double end = 2 * kPi * (patch + 0.5) / counts[k];
            rings_.back().turns.push_back(quarter_turns(std::cos(end), std::sin(end)));
        }
        first += counts[k];
    }
}

int KlemsBasis::patch_of(Vec3 w) const {
    const double sine = w.x * w.x + w.y * w.y, cosine = w.z * w.z;  // squared, of w's length
    const Ring* ring = &rings_.back();
    for (const Ring& r : rings_)
        if (sine < r.squared_tangent * cosine) {
            ring = &r;
            break;
        }
    const auto end =
        std::upper_bound(ring->turns.begin(), ring->turns.end(), quarter_turns(w.x, w.y));
    // Beyond the end of the last one begins the first again
    return ring->first +
           (end == ring->turns.end() ? 0 : static_cast<int>(end - ring->turns.begin()));
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

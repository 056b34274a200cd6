// SPDX-License-Identifier: Apache-2.0
#include <asperity/brdf/brdf.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {
namespace {

// A Fibonacci lattice: F(21) points, the second coordinate advancing by F(20) / F(21). Points of
// the unit square without gaps or clusters (Sloan and Joe 1994, "Lattice methods").
constexpr int kPoints = 10946;
constexpr int kStep = 6765;

}  // namespace

void Brdf::albedo(Vec3 wi, std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    if (wi.z <= 0) return;
    // Substitute the sampler's own map for the directions: what is left to integrate over the unit
    // square, f cos(theta_o) / pdf, is smooth however sharp the lobe.
    std::array<double, kMaxBrdfChannels> values{};
    const std::span<double> f = std::span(values).first(a.size());
    for (int i = 0; i < kPoints; ++i) {
        const double u1 = (i + 0.5) / kPoints;
        const double u2 = (i * kStep % kPoints + 0.5) / kPoints;
        const std::optional<BrdfSample> s = sample(wi, u1, u2);
        if (!s) continue;
        eval(wi, s->wo, f);
        for (std::size_t c = 0; c < a.size(); ++c) a[c] += f[c] * s->wo.z / s->pdf;
    }
    for (double& value : a) value /= kPoints;
}

}  // namespace asperity

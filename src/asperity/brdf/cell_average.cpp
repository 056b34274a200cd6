// SPDX-License-Identifier: Apache-2.0
#include <asperity/brdf/compare.h>
#include <asperity/core/directions.h>
#include <asperity/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {
namespace {

using Channels = std::array<double, kMaxBrdfChannels>;

/// A rectangle in s = sin^2(theta) and phi, where f cos(theta) dw = f / 2 ds dphi.
struct Patch {
    double s0, s1, phi0, phi1;
};

/// Integrates f cos(theta_o) over patches of the hemisphere for one incident direction.
class PatchIntegrator {
  public:
    PatchIntegrator(const Brdf& brdf, Vec3 wi, double tolerance)
        : brdf_(brdf),
          wi_(wi),
          channels_(static_cast<std::size_t>(brdf.channels())),
          tolerance_(tolerance),
          mirror_s_(wi.x * wi.x + wi.y * wi.y),
          mirror_phi_(azimuth({-wi.x, -wi.y, wi.z})) {}

    /// Adds the integral to `sum`, one value per channel.
    void integrate(const Patch& p, std::span<double> sum, int depth = 0) const {
        // Where the mirror direction is near, a lobe may hide between the points: look closer.
        const bool look_closer = depth < kMinDepthAtMirror && near_mirror(p);
        if (!look_closer) {
            const Channels coarse = gauss<2>(p, kNodes2, kWeights2);
            const Channels fine = gauss<3>(p, kNodes3, kWeights3);
            double error = 0;
            for (std::size_t c = 0; c < channels_; ++c)
                error = std::max(error, std::abs(fine[c] - coarse[c]));
            if (error <= tolerance_ || depth >= kMaxDepth) {
                for (std::size_t c = 0; c < channels_; ++c) sum[c] += fine[c];
                return;
            }
        }
        const double s = 0.5 * (p.s0 + p.s1), phi = 0.5 * (p.phi0 + p.phi1);
        integrate({p.s0, s, p.phi0, phi}, sum, depth + 1);
        integrate({p.s0, s, phi, p.phi1}, sum, depth + 1);
        integrate({s, p.s1, p.phi0, phi}, sum, depth + 1);
        integrate({s, p.s1, phi, p.phi1}, sum, depth + 1);
    }

  private:
    static constexpr int kMinDepthAtMirror = 3, kMaxDepth = 9;
    // Nodes on [0, 1] and weights of the Gauss-Legendre rules of 2 and 3 points.
    static constexpr std::array kNodes2 = {0.21132486540518712, 0.78867513459481288};
    static constexpr std::array kWeights2 = {0.5, 0.5};
    static constexpr std::array kNodes3 = {0.11270166537925831, 0.5, 0.88729833462074169};
    static constexpr std::array kWeights3 = {5.0 / 18, 8.0 / 18, 5.0 / 18};

    template <std::size_t N>
    Channels gauss(const Patch& p, const std::array<double, N>& nodes,
                   const std::array<double, N>& weights) const {
        Channels sum{}, values{};
        const std::span<double> f = std::span(values).first(channels_);
        for (std::size_t a = 0; a < N; ++a) {
            const double s = p.s0 + nodes[a] * (p.s1 - p.s0);
            const double sin_theta = std::sqrt(s), cos_theta = std::sqrt(1 - s);
            for (std::size_t b = 0; b < N; ++b) {
                const double phi = p.phi0 + nodes[b] * (p.phi1 - p.phi0);
                const Vec3 wo = {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
                brdf_.eval(wi_, wo, f);
                const double weight = weights[a] * weights[b];
                for (std::size_t c = 0; c < channels_; ++c) sum[c] += weight * f[c];
            }
        }
        const double area = 0.5 * (p.s1 - p.s0) * (p.phi1 - p.phi0);
        for (std::size_t c = 0; c < channels_; ++c) sum[c] *= area;
        return sum;
    }

    /// True when the mirror direction lies in the patch or less than its own size beside it.
    bool near_mirror(const Patch& p) const {
        const double ds = p.s1 - p.s0, dphi = p.phi1 - p.phi0;
        if (mirror_s_ < p.s0 - ds || mirror_s_ > p.s1 + ds) return false;
        if (p.s0 <= ds && mirror_s_ <= 2 * ds) return true;  // at the pole all azimuths are near
        const double offset = std::remainder(mirror_phi_ - 0.5 * (p.phi0 + p.phi1), 2 * kPi);
        return std::abs(offset) <= 1.5 * dphi;
    }

    const Brdf& brdf_;
    Vec3 wi_;
    std::size_t channels_;
    double tolerance_;
    double mirror_s_, mirror_phi_;
};

/// Number of incident azimuths that stand for all of them.
constexpr int kAzimuths = 32;

/// Largest difference of the two rules, all cells together, as a share of the incident energy. The
/// finer rule, which is kept, is closer than that.
constexpr double kTotalTolerance = 2e-4;

}  // namespace

CellAverages average_over_cells(const Brdf& brdf, const Detector& detector, double theta_i,
                                double phi_i, bool isotropic, int threads) {
    const std::size_t channels = static_cast<std::size_t>(brdf.channels());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cells = static_cast<std::size_t>(detector.cells());
    const int azimuths = isotropic && !brdf.isotropic() ? kAzimuths : 1;
    const double tolerance = kTotalTolerance / static_cast<double>(cells);

    CellAverages result;
    result.energy.assign(channels * cells, 0.0);
    parallel_for(static_cast<std::size_t>(detector.rows()), threads, [&](std::size_t row) {
        const int r = static_cast<int>(row);
        const double sin0 = std::sin(detector.theta_edge(r));
        const double sin1 = std::sin(detector.theta_edge(r + 1));
        for (int azimuth_index = 0; azimuth_index < azimuths; ++azimuth_index) {
            const double turn = 2 * kPi * azimuth_index / azimuths;
            const double phi = isotropic ? turn : phi_i;
            const PatchIntegrator integrator(brdf, from_spherical(theta_i, phi), tolerance);
            for (std::size_t column = 0; column < columns; ++column) {
                // In isotropic mode the detector turns with the light.
                const double offset = isotropic ? turn : 0.0;
                const int c = static_cast<int>(column);
                Channels sum{};
                integrator.integrate({sin0 * sin0, sin1 * sin1, detector.phi_edge(c) + offset,
                                      detector.phi_edge(c + 1) + offset},
                                     std::span(sum).first(channels));
                for (std::size_t channel = 0; channel < channels; ++channel)
                    result.energy[channel * cells + row * columns + column] +=
                        sum[channel] / azimuths;
            }
        }
    });

    result.albedo.assign(channels, 0.0);
    for (std::size_t channel = 0; channel < channels; ++channel)
        for (std::size_t cell = 0; cell < cells; ++cell)
            result.albedo[channel] += result.energy[channel * cells + cell];
    return result;
}

}  // namespace asperity

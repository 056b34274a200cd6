// SPDX-License-Identifier: Apache-2.0
#pragma once

// How models are averaged over cells; inside this folder only.

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/directions.h>
#include <asperity/detector/detector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace asperity::detail {

/// Number of incident azimuths that stand for all of them.
inline constexpr int kAzimuths = 32;

/// Largest difference of the two rules, all cells together, as a share of the incident energy. The
/// finer rule, which is kept, is closer than that.
inline constexpr double kTotalTolerance = 2e-4;

/// A value per channel, without allocation.
using Channels = std::array<double, kMaxBsdfChannels>;

/// A rectangle in s = sin^2(theta) and phi, where f cos(theta) dw = f / 2 ds dphi.
struct Patch {
    double s0, s1, phi0, phi1;
};

/// Integrates f cos(theta_o) over patches of the hemisphere for one incident direction.
class PatchIntegrator {
  public:
    PatchIntegrator(const Bsdf& brdf, Vec3 wi, double tolerance)
        : brdf_(brdf),
          wi_(wi),
          channels_(static_cast<std::size_t>(brdf.channels())),
          tolerance_(tolerance),
          mirror_s_(wi.x * wi.x + wi.y * wi.y),
          mirror_phi_(azimuth({-wi.x, -wi.y, wi.z})) {}

    /// Adds the integral to `sum`, one value per channel.
    void integrate(const Patch& p, std::span<double> sum, int depth = 0) const {
        // Where the mirror direction is near, a lobe may hide between the points: look closer.
        const bool near = near_mirror(p);
        if (near && depth < kMinDepthAtMirror) {
            integrate_quarters(p, sum, depth);
            return;
        }
        const Channels two = gauss<2>(p, kNodes2, kWeights2);
        // Far from there f is smooth, and mostly small: the first two rules are enough
        if (!near && differ_little(gauss<1>(p, kNodes1, kWeights1), two))
            add(two, sum);
        else
            integrate_closer(p, two, sum, depth);
    }

    /// The same where the integral by the rule of two points is known, and not good enough.
    void integrate_closer(const Patch& p, const Channels& two, std::span<double> sum,
                          int depth = 0) const {
        const Channels three = gauss<3>(p, kNodes3, kWeights3);
        if (differ_little(two, three) || depth >= kMaxDepth)
            add(three, sum);
        else
            integrate_quarters(p, sum, depth);
    }

    /// True when the mirror direction lies in the patch or less than its own size beside it.
    bool near_mirror(const Patch& p) const {
        const double ds = p.s1 - p.s0, dphi = p.phi1 - p.phi0;
        if (mirror_s_ < p.s0 - ds || mirror_s_ > p.s1 + ds) return false;
        if (p.s0 <= ds && mirror_s_ <= 2 * ds) return true;  // at the pole all azimuths are near
        const double offset = std::remainder(mirror_phi_ - 0.5 * (p.phi0 + p.phi1), 2 * kPi);
        return std::abs(offset) <= 1.5 * dphi;
    }

    bool differ_little(const Channels& a, const Channels& b) const {
        double error = 0;
        for (std::size_t c = 0; c < channels_; ++c) error = std::max(error, std::abs(a[c] - b[c]));
        return error <= tolerance_;
    }

    const Bsdf& brdf() const { return brdf_; }
    Vec3 wi() const { return wi_; }

    // Nodes on [0, 1] and weights of the Gauss-Legendre rules of 1, 2 and 3 points.
    static constexpr std::array kNodes1 = {0.5};
    static constexpr std::array kWeights1 = {1.0};
    static constexpr std::array kNodes2 = {0.21132486540518712, 0.78867513459481288};
    static constexpr std::array kWeights2 = {0.5, 0.5};
    static constexpr std::array kNodes3 = {0.11270166537925831, 0.5, 0.88729833462074169};
    static constexpr std::array kWeights3 = {5.0 / 18, 8.0 / 18, 5.0 / 18};

  private:
    static constexpr int kMinDepthAtMirror = 3, kMaxDepth = 9;

    void add(const Channels& part, std::span<double> sum) const {
        for (std::size_t c = 0; c < channels_; ++c) sum[c] += part[c];
    }

    void integrate_quarters(const Patch& p, std::span<double> sum, int depth) const {
        const double s = 0.5 * (p.s0 + p.s1), phi = 0.5 * (p.phi0 + p.phi1);
        integrate({p.s0, s, p.phi0, phi}, sum, depth + 1);
        integrate({p.s0, s, phi, p.phi1}, sum, depth + 1);
        integrate({s, p.s1, p.phi0, phi}, sum, depth + 1);
        integrate({s, p.s1, phi, p.phi1}, sum, depth + 1);
    }

    template <std::size_t N>
    Channels gauss(const Patch& p, const std::array<double, N>& nodes,
                   const std::array<double, N>& weights) const {
        std::array<double, N> cos_phi, sin_phi;
        for (std::size_t b = 0; b < N; ++b) {
            const double phi = p.phi0 + nodes[b] * (p.phi1 - p.phi0);
            cos_phi[b] = std::cos(phi);
            sin_phi[b] = std::sin(phi);
        }
        std::array<Vec3, N * N> wo;
        for (std::size_t a = 0; a < N; ++a) {
            const double s = p.s0 + nodes[a] * (p.s1 - p.s0);
            const double sin_theta = std::sqrt(s), cos_theta = std::sqrt(1 - s);
            for (std::size_t b = 0; b < N; ++b)
                wo[a * N + b] = {sin_theta * cos_phi[b], sin_theta * sin_phi[b], cos_theta};
        }
        std::array<double, N * N * kMaxBsdfChannels> values;
        brdf_.eval_many(wi_, wo, std::span(values).first(wo.size() * channels_));
        Channels sum;
        std::fill_n(sum.begin(), channels_, 0.0);
        for (std::size_t k = 0; k < wo.size(); ++k) {
            const double weight = weights[k / N] * weights[k % N];
            for (std::size_t c = 0; c < channels_; ++c)
                sum[c] += weight * values[k * channels_ + c];
        }
        const double area = 0.5 * (p.s1 - p.s0) * (p.phi1 - p.phi0);
        for (std::size_t c = 0; c < channels_; ++c) sum[c] *= area;
        return sum;
    }

    const Bsdf& brdf_;
    Vec3 wi_;
    std::size_t channels_;
    double tolerance_;
    double mirror_s_, mirror_phi_;
};

/// Integrates f cos(theta_o) over cells of a detector, for light as a layer of a measurement has
/// it: with `isotropic`, from all azimuths, the detector turning with the light.
class CellIntegrator {
  public:
    CellIntegrator(const Bsdf& brdf, const Detector& detector, double theta_i, double phi_i,
                   bool isotropic)
        : detector_(detector), channels_(static_cast<std::size_t>(brdf.channels())) {
        const int azimuths = isotropic && !brdf.isotropic() ? kAzimuths : 1;
        const double tolerance = kTotalTolerance / detector.cells();
        for (int k = 0; k < azimuths; ++k) {
            const double turn = 2 * kPi * k / azimuths;
            turns_.push_back(isotropic ? turn : 0.0);
            integrators_.emplace_back(brdf, from_spherical(theta_i, isotropic ? turn : phi_i),
                                      tolerance);
        }
    }

    /// How often, and by which azimuths, the detector is turned with the light.
    std::span<const double> turns() const { return turns_; }
    const PatchIntegrator& at_turn(std::size_t k) const { return integrators_[k]; }

    /// The integral over one cell, per channel.
    Channels integrate(int row, int column) const {
        const double sin0 = std::sin(detector_.theta_edge(row));
        const double sin1 = std::sin(detector_.theta_edge(row + 1));
        const double count = static_cast<double>(turns_.size());
        Channels total{};
        for (std::size_t k = 0; k < turns_.size(); ++k) {
            Channels sum{};
            integrators_[k].integrate(
                {sin0 * sin0, sin1 * sin1, detector_.phi_edge(column) + turns_[k],
                 detector_.phi_edge(column + 1) + turns_[k]},
                std::span(sum).first(channels_));
            for (std::size_t c = 0; c < channels_; ++c) total[c] += sum[c] / count;
        }
        return total;
    }

  private:
    const Detector& detector_;
    std::size_t channels_;
    std::vector<double> turns_;  ///< azimuths the detector is turned by
    std::vector<PatchIntegrator> integrators_;
};

}  // namespace asperity::detail

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/spectral_density.h>

#include <asperity/surface/spectrum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace asperity {

namespace {

constexpr int kDirections = 180;  // a degree each

std::vector<double> window(int n, Boundary boundary) {
    std::vector<double> weights(static_cast<std::size_t>(n), 1.0);
    if (boundary == Boundary::Periodic) return weights;
    for (std::size_t k = 0; k < weights.size(); ++k)
        weights[k] =
            0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / n);
    return weights;
}

double mean_square(const std::vector<double>& weights) {
    const double sum = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
    return sum / static_cast<double>(weights.size());
}

/// What one column of the spectrum, kx, brings to rings and directions.
struct Sums {
    std::vector<double> ring, count;
    std::array<double, kDirections> direction{};
};

/// The wave vector's direction turns with twice its angle: so is the mean around the strongest.
double lay_of(const std::array<double, kDirections>& power) {
    constexpr int kAround = 3;
    const int best = static_cast<int>(std::max_element(power.begin(), power.end()) - power.begin());
    double sum = 0, turned = 0;
    for (int d = -kAround; d <= kAround; ++d) {
        const double p = power[static_cast<std::size_t>((best + d + kDirections) % kDirections)];
        sum += p;
        turned += p * d;
    }
    // Rows count downwards: counter-clockwise in the picture is against the angle
    double lay = 90 - (best + turned / sum);
    while (lay <= -90) lay += 180;
    while (lay > 90) lay -= 180;
    return lay;
}

class Collector {
  public:
    Collector(const Heightfield& surface, double scale)
        : nx_(surface.nx),
          ny_(surface.ny),
          per_x_(1 / (surface.nx * surface.dx)),
          per_y_(1 / (surface.ny * surface.dy)),
          step_(std::max(per_x_, per_y_)),
          scale_(scale),
          rings_(
              static_cast<std::size_t>(std::min(0.5 / surface.dx, 0.5 / surface.dy) / step_ + 0.5) +
              1),
          columns_(static_cast<std::size_t>(surface.nx / 2 + 1)) {}

    void add(int kx, std::span<const std::complex<float>> column) {
        Sums& sums = columns_[static_cast<std::size_t>(kx)];
        sums.ring.resize(rings_);
        sums.count.resize(rings_);
        const double twice = kx == 0 || 2 * kx == nx_ ? 1 : 2;  // the other half mirrors it
        for (int k = 0; k < ny_; ++k) {
            const int ky = 2 * k > ny_ ? k - ny_ : k;
            if (kx == 0 && ky == 0) continue;
            const double fx = kx * per_x_, fy = ky * per_y_, f = std::hypot(fx, fy);
            const double power =
                twice * scale_ *
                static_cast<double>(std::norm(column[static_cast<std::size_t>(k)]));
            const auto ring = static_cast<std::size_t>(std::lround(f / step_));
            if (ring < rings_) {
                sums.ring[ring] += power;
                sums.count[ring] += twice;
            }
            const auto angle = std::lround(std::atan2(fy, fx) * 180 / std::numbers::pi);
            sums.direction[static_cast<std::size_t>((angle + kDirections) % kDirections)] += power;
        }
    }

    SpectralDensity result() const {
        SpectralDensity density;
        std::vector<double> ring(rings_), count(rings_);
        std::array<double, kDirections> direction{};
        for (const Sums& sums : columns_) {
            for (std::size_t k = 0; k < rings_; ++k) ring[k] += sums.ring[k];
            for (std::size_t k = 0; k < rings_; ++k) count[k] += sums.count[k];
            for (std::size_t k = 0; k < direction.size(); ++k) direction[k] += sums.direction[k];
        }
        for (std::size_t k = 1; k < rings_; ++k) {
            if (count[k] == 0) continue;
            density.frequency.push_back(static_cast<double>(k) * step_);
            density.radial.push_back(ring[k] / count[k]);
        }
        density.flat = *std::max_element(direction.begin(), direction.end()) == 0;
        if (!density.flat) density.direction_deg = lay_of(direction);
        return density;
    }

  private:
    int nx_, ny_;
    double per_x_, per_y_, step_, scale_;
    std::size_t rings_;
    std::vector<Sums> columns_;
};

}  // namespace

SpectralDensity spectral_density(const Heightfield& surface, Run& run) {
    const auto nx = static_cast<std::size_t>(surface.nx);
    double mean = 0, largest = 0;
    for (const float h : surface.heights) mean += static_cast<double>(h);
    mean /= static_cast<double>(surface.heights.size());
    for (const float h : surface.heights)
        largest = std::max(largest, std::abs(static_cast<double>(h) - mean));
    if (largest == 0) return {};
    const std::vector<double> along_x = window(surface.nx, surface.boundary),
                              along_y = window(surface.ny, surface.boundary);
    // Of the order of 1, as floats like it
    std::vector<float> values(surface.heights.size());
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = static_cast<float>((static_cast<double>(surface.heights[k]) - mean) / largest *
                                       along_x[k % nx] * along_y[k / nx]);
    const double scale = largest * largest * surface.dx * surface.dy /
                         static_cast<double>(values.size()) / mean_square(along_x) /
                         mean_square(along_y);
    Collector collector(surface, scale);
    filter_spectrum(
        {surface.nx, surface.ny, values},
        [&](int kx, std::span<std::complex<float>> column) { collector.add(kx, column); }, run);
    return collector.result();
}

}  // namespace asperity

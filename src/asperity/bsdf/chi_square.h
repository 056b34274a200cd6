// SPDX-License-Identifier: Apache-2.0
#pragma once

// Statistical tests of samplers, for the tests of this folder.

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/directions.h>
#include <asperity/core/random.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace asperity::test {

/// What a million samples say about a sampler and its density.
struct SamplerReport {
    double p_value = 0;     ///< of the chi-square test: a right sampler is below 0.01 once in 100
    double integral = 0;    ///< of the density over the hemisphere
    double none_share = 0;  ///< of the samples that gave none
    int impossible = 0;     ///< samples with a density that is zero, not finite or not pdf()
    double mean_weight = 0, mean_weight_error = 0;  ///< E[f cos / pdf] of channel 0, its stderr
};

struct SamplerTest {
    Vec3 wi;
    int rows = 101, columns = 120;  ///< cells in theta and phi; odd rows fall in step with nothing
    int steps = 4;                  ///< the density is integrated over steps x steps points a cell
    std::uint64_t seed = 1;
    std::uint64_t samples = 1000000;
};

/// Upper tail of the chi-square distribution, by the cube root of Wilson and Hilferty (1931).
inline double chi_square_tail(double chi_square, double degrees_of_freedom) {
    const double v = 2 / (9 * degrees_of_freedom);
    const double z = (std::cbrt(chi_square / degrees_of_freedom) - (1 - v)) / std::sqrt(v);
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// p-value of counts against expected numbers; cells that expect fewer than 5 are pooled.
inline double chi_square_p_value(const std::vector<double>& observed,
                                 const std::vector<double>& expected) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    double chi_square = 0, pooled_observed = 0, pooled_expected = 0;
    int terms = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        pooled_observed += observed[order[k]];
        pooled_expected += expected[order[k]];
        if (pooled_expected < 5 && k + 1 < order.size()) continue;
        const double d = pooled_observed - pooled_expected;
        if (pooled_expected > 0) {
            chi_square += d * d / pooled_expected;
            ++terms;
        } else if (d > 0) {
            return 0;
        }
        pooled_observed = pooled_expected = 0;
    }
    return terms > 1 ? chi_square_tail(chi_square, terms - 1) : 1.0;
}

/// Draws samples of `brdf` and compares their numbers per cell with the integral of its density.
inline SamplerReport test_sampler(const Bsdf& brdf, const SamplerTest& test) {
    SamplerReport report;
    const std::size_t columns = static_cast<std::size_t>(test.columns);
    // One more cell counts the samples that gave none.
    const std::size_t none = static_cast<std::size_t>(test.rows) * columns;
    std::vector<double> observed(none + 1, 0.0), expected(none + 1, 0.0);
    const double n = static_cast<double>(test.samples);
    const double dtheta = 0.5 * kPi / test.rows, dphi = 2 * kPi / test.columns;

    std::vector<double> f(static_cast<std::size_t>(brdf.channels()));
    double sum = 0, squares = 0;
    const CounterRandom random(test.seed, 0);
    for (std::uint64_t i = 0; i < test.samples; ++i) {
        const auto u = random.uniform2(i);
        const auto s = brdf.sample(test.wi, u[0], u[1]);
        if (!s) {
            observed[none] += 1;
            continue;
        }
        const double pdf = i % 16 == 0 ? brdf.pdf(test.wi, s->wo) : s->pdf;
        if (!(s->pdf > 0) || std::abs(pdf - s->pdf) > 1e-9 * s->pdf) ++report.impossible;
        const int row = std::min(static_cast<int>(polar_angle(s->wo) / dtheta), test.rows - 1);
        const int column = std::min(static_cast<int>(azimuth(s->wo) / dphi), test.columns - 1);
        observed[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] += 1;
        brdf.eval(test.wi, s->wo, f);
        const double weight = f[0] * s->wo.z / s->pdf;
        sum += weight;
        squares += weight * weight;
    }
    report.none_share = observed[none] / n;
    report.mean_weight = sum / n;
    report.mean_weight_error =
        std::sqrt(std::max(0.0, squares / n - report.mean_weight * report.mean_weight) / n);

    const double h_theta = dtheta / test.steps, h_phi = dphi / test.steps;
    for (std::size_t cell = 0; cell < none; ++cell) {
        double integral = 0;
        for (int a = 0; a < test.steps; ++a) {
            const double theta = static_cast<double>(cell / columns) * dtheta + (a + 0.5) * h_theta;
            for (int b = 0; b < test.steps; ++b) {
                const double phi = static_cast<double>(cell % columns) * dphi + (b + 0.5) * h_phi;
                integral += brdf.pdf(test.wi, from_spherical(theta, phi)) * std::sin(theta);
            }
        }
        integral *= h_theta * h_phi;
        report.integral += integral;
        expected[cell] = n * integral;
    }
    expected[none] = std::max(0.0, n * (1 - report.integral));
    report.p_value = chi_square_p_value(observed, expected);
    return report;
}

}  // namespace asperity::test

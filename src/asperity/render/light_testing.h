// SPDX-License-Identifier: Apache-2.0
#pragma once

// Statistical tests of lights, for the tests of this folder.

#include <asperity/bsdf/chi_square.h>
#include <asperity/core/random.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/light.h>

#include <vector>

namespace asperity::test {

/// What samples of a light say about it and its density.
struct LightReport {
    double p_value = 0;   ///< of the chi-square test: a right sampler is below 0.01 once in 100
    double integral = 0;  ///< of the density over all directions
    int impossible = 0;   ///< samples that contradict radiance() or pdf()
    Rgb mean;             ///< E[L / pdf]
    double error = 0;     ///< standard error of its luminance
};

/// Cells in which samples are counted: `rows` x `columns` of latitude and longitude. The density is
/// integrated over steps x steps parts of each cell, exactly when it is the same all over a part.
struct LightCells {
    int rows = 16, columns = 32, steps = 4;
    std::uint64_t samples = 200000;
};

inline LightReport test_light(const Light& light, const LightCells& cells) {
    LightReport report;
    const auto columns = static_cast<std::size_t>(cells.columns);
    std::vector<double> observed(static_cast<std::size_t>(cells.rows) * columns, 0.0);
    std::vector<double> expected(observed.size(), 0.0);

    // Draw
    const CounterRandom random(1, 0);
    double squares = 0;
    const double n = static_cast<double>(cells.samples);
    for (std::uint64_t i = 0; i < cells.samples; ++i) {
        const auto u = random.uniform2(i);
        const auto s = light.sample({}, u[0], u[1]);
        if (!s) continue;
        if (!(s->pdf > 0) || s->pdf != light.pdf(s->direction) ||
            !(s->radiance == light.radiance(s->direction)) ||
            std::abs(length(s->direction) - 1) > 1e-12)
            ++report.impossible;
        const MapPoint p = map_point(s->direction);
        observed[static_cast<std::size_t>(p.v * cells.rows) * columns +
                 static_cast<std::size_t>(p.u * cells.columns)] += 1;
        const Rgb weight = (1 / s->pdf) * s->radiance;
        report.mean = report.mean + (1 / n) * weight;
        squares += luminance(weight) * luminance(weight) / n;
    }
    const double mean = luminance(report.mean);
    report.error = std::sqrt(std::max(0.0, squares - mean * mean) / n);

    // Integrate the density over the cells
    const int fine_rows = cells.rows * cells.steps, fine_columns = cells.columns * cells.steps;
    for (int row = 0; row < fine_rows; ++row) {
        const double solid_angle =
            2 * kPi / fine_columns *
            (std::cos(kPi * row / fine_rows) - std::cos(kPi * (row + 1) / fine_rows));
        for (int column = 0; column < fine_columns; ++column) {
            const Vec3 w = map_direction({(column + 0.5) / fine_columns, (row + 0.5) / fine_rows});
            const double share = solid_angle * light.pdf(w);
            report.integral += share;
            expected[static_cast<std::size_t>(row / cells.steps) * columns +
                     static_cast<std::size_t>(column / cells.steps)] += n * share;
        }
    }
    report.p_value = chi_square_p_value(observed, expected);
    return report;
}

}  // namespace asperity::test

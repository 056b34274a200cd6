// SPDX-License-Identifier: Apache-2.0
//
// Do 95 % intervals hold the truth 95 % of the time? Many runs with seeds of their own, the truth
// being the mean of all of them (its own error is a twentieth of one run's).
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

constexpr int kRuns = 400;
constexpr double kStudent15 = 2.1314;  // 97.5 % quantile, 15 degrees of freedom: 16 batches

/// Share of runs whose interval holds the mean of all runs, for figures x with standard errors s.
double coverage(const std::vector<double>& x, const std::vector<double>& s) {
    double mean = 0;
    for (const double value : x) mean += value / static_cast<double>(x.size());
    int held = 0;
    for (std::size_t k = 0; k < x.size(); ++k) held += std::abs(x[k] - mean) <= kStudent15 * s[k];
    return held / static_cast<double>(x.size());
}

struct Case {
    const char* name;
    LaunchPattern launch;
    double alpha;
    bool isotropic = false;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}
class CoverageOf : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Launches, CoverageOf,
    testing::Values(Case{"lattice", LaunchPattern::LowDiscrepancy, 0.6},
                    // Most facets are known here: their light is spread exactly
                    Case{"known_facets", LaunchPattern::LowDiscrepancy, 0.35},
                    // A batch is one sweep here, from an azimuth of its own
                    Case{"sweeps_around", LaunchPattern::LowDiscrepancy, 0.6, true},
                    Case{"stratified", LaunchPattern::Stratified, 0.6},
                    Case{"random", LaunchPattern::Random, 0.6}),
    [](const testing::TestParamInfo<Case>& tested) { return std::string(tested.param.name); });

TEST_P(CoverageOf, NinetyFivePercentIntervalsHoldTheTruth) {
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.size = 128;
    settings.alpha_x = settings.alpha_y = GetParam().alpha;
    asperity::Run run(0);
    const Heightfield surface = make_surface(settings, run);
    Experiment e;
    e.optics.fresnel = FresnelKind::Dielectric;
    e.optics.ior = {1.5};
    e.detector.resolution = 12;
    e.illumination.theta_deg = {40};
    e.illumination.isotropic = GetParam().isotropic;
    e.run.launch = GetParam().launch;
    // What known facets leave over may be little, and a handful of rays has skewed errors: four
    // rays a cell, half as many as a measurement has unless asked otherwise
    e.run.rays = GetParam().launch == LaunchPattern::LowDiscrepancy ? 65536 : 20000;

    std::vector<std::vector<double>> values, errors;  // one row per figure, one column per run
    std::vector<int> figures;                         // cells that get 100 rays or more
    for (int k = 0; k < kRuns; ++k) {
        e.run.seed = static_cast<std::uint64_t>(1000 + k);
        const Measurement m = measure(surface, e, run);
        const Layer& layer = m.layers[0];
        if (k == 0) {
            for (int cell = 0; cell < m.detector.cells(); ++cell)
                if (m.energy(layer, 0, cell) > 0.01 * m.albedo(layer, 0)) figures.push_back(cell);
            values.resize(figures.size() + 3);
            errors.resize(figures.size() + 3);
        }
        std::size_t row = 0;
        for (const int cell : figures) {
            values[row].push_back(m.energy(layer, 0, cell));
            errors[row++].push_back(double{layer.stderr_energy[static_cast<std::size_t>(cell)]});
        }
        values[row].push_back(m.albedo(layer, 0));
        errors[row++].push_back(layer.stderr_albedo[0]);
        for (int order = 0; order < 2; ++order) {
            values[row].push_back(m.albedo(layer, order, 0));
            errors[row++].push_back(layer.stderr_albedo_by_bounce[static_cast<std::size_t>(order)]);
        }
    }

    ASSERT_GE(figures.size(), 15u);
    double mean = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        const double held = coverage(values[row], errors[row]);
        mean += held / static_cast<double>(values.size());
        // One figure alone: binomial sd of 400 runs is 1.1 %
        EXPECT_NEAR(held, 0.95, 0.045) << "figure " << row;
    }
    EXPECT_GT(mean, 0.93);
    EXPECT_LT(mean, 0.97);
}

}  // namespace
}  // namespace asperity

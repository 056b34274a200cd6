// SPDX-License-Identifier: Apache-2.0
//
// Do 95 % intervals of the class hold the truth 95 % of the time? Many runs of 16 surfaces each,
// the truth being the mean over 1000 other surfaces.
#include <asperity/gonio/measure.h>
#include <asperity/gonio/noise_shares.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

constexpr int kRuns = 80, kTruth = 1000;
constexpr double kStudent15 = 2.1314;  // 97.5 % quantile, 15 degrees of freedom: 16 surfaces

Measurement measured(Experiment e, std::uint64_t surface_seed) {
    e.surface.seed = surface_seed;
    e.run.seed = surface_seed;
    asperity::Run run(0);
    return measure(make_surface(e.surface, run), e, run);
}

struct Case {
    const char* name;
    const char* kind;
    std::uint64_t rays;  ///< on a surface of 32 x 32 cells
    double least, most;  ///< share of the rays in the cells' squared errors
    const char* engine = "wide";
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}
class ClassCoverageOf : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Surfaces, ClassCoverageOf,
    testing::Values(Case{"both_noises", "thesis", 1024, 0.2, 0.8},
                    // Many facets are solved analytically: what is left is between surfaces
                    Case{"between_surfaces", "gaussian", 4096, 0, 0.2},
                    Case{"few_rays", "gaussian", 128, 0.3, 1},
                    Case{"plain", "thesis", 256, 0.5, 1, "plain"}),
    [](const testing::TestParamInfo<Case>& tested) { return std::string(tested.param.name); });

TEST_P(ClassCoverageOf, NinetyFivePercentIntervalsHoldTheClass) {
    Experiment e;
    e.surface.kind = GetParam().kind;
    e.surface.size = 32;
    e.surface.roughness = 0.1;
    e.surface.correlation_x = e.surface.correlation_y = 2;
    e.optics.fresnel = FresnelKind::Dielectric;
    e.optics.ior = {1.5};
    e.detector.resolution = 6;
    e.illumination.theta_deg = {40};
    e.run.engine = GetParam().engine;
    Experiment all = e;
    all.run.surfaces = kTruth;
    all.run.rays = kTruth * GetParam().rays;
    const Measurement truth = measured(all, 1000000);

    e.run.surfaces = 16;
    e.run.rays = 16 * GetParam().rays;
    std::vector<int> cells;
    for (int cell = 0; cell < truth.detector.cells(); ++cell)
        if (truth.energy(truth.layers[0], 0, cell) > 0.01 * truth.albedo(truth.layers[0], 0))
            cells.push_back(cell);
    ASSERT_GE(cells.size(), 5u);
    double held = 0, share = 0;
    for (std::uint64_t k = 0; k < kRuns; ++k) {
        const Measurement m = measured(e, 100 * k);
        const Layer& layer = m.layers[0];
        const auto holds = [&](double value, double error, double true_value) {
            held += std::abs(value - true_value) <= kStudent15 * error ? 1 : 0;
        };
        for (const int cell : cells)
            holds(m.energy(layer, 0, cell),
                  double{layer.stderr_energy[static_cast<std::size_t>(cell)]},
                  truth.energy(truth.layers[0], 0, cell));
        holds(m.albedo(layer, 0), layer.stderr_albedo[0], truth.albedo(truth.layers[0], 0));
        share += shares_of_rays(m.layers)->cells / kRuns;
    }
    held /= static_cast<double>(kRuns * (cells.size() + 1));
    EXPECT_GT(held, 0.93);
    EXPECT_LT(held, 0.97);
    EXPECT_GE(share, GetParam().least);
    EXPECT_LE(share, GetParam().most);
}

}  // namespace
}  // namespace asperity

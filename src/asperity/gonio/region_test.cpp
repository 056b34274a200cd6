// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/gonio/cell_errors.h>
#include <asperity/gonio/region.h>
#include <asperity/gonio/test_layers.h>
#include <asperity/gonio/test_measurements.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace asperity {
namespace {

std::vector<int> all_cells(const Measurement& m) {
    std::vector<int> cells(static_cast<std::size_t>(m.detector.cells()));
    std::iota(cells.begin(), cells.end(), 0);
    return cells;
}

TEST(Region, HasTheCellsWhoseCentreIsInIt) {
    // 4 rows of 22.5 degrees, 8 columns of 45
    const Detector detector({DetectorKind::LatLong, 8, 1});
    const auto cells = [&](double a, double b, double c, double d) {
        return cells_in(detector, {radians(a), radians(b), radians(c), radians(d)});
    };
    EXPECT_EQ(cells(0, 90, 0, 360).size(), 32u);
    EXPECT_EQ(cells(0, 22.5, 0, 90), (std::vector{0, 1}));
    EXPECT_EQ(cells(60, 90, 315, 405), (std::vector{24, 31}));
    EXPECT_EQ(cells(60, 90, -45, 45), (std::vector{24, 31}));
    EXPECT_TRUE(cells(0, 10, 0, 360).empty());
    for (const auto& [a, b, c, d] : {std::array{-1.0, 20.0, 0.0, 90.0},
                                     {30.0, 30.0, 0.0, 90.0},
                                     {0.0, 91.0, 0.0, 90.0},
                                     {0.0, 90.0, 90.0, 0.0},
                                     {0.0, 90.0, 0.0, 400.0},
                                     {0.0, std::nan(""), 0.0, 90.0}})
        EXPECT_THROW((void)cells(a, b, c, d), Error);
}

/// 16 groups of 10 rays on a detector of 2 x 4 cells: cell 0 gets 4 or 6 rays of each in turn, cell
/// 5 as many or, if they are against each other, the rest of 10.
Measurement two_cells(bool against) {
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 4, {"all"}, {0});
    Layer& layer = m.layers[0];
    layer.rays = 160;
    layer.spread.groups = GroupSums(m.shape());
    for (std::size_t g = 0; g < 16; ++g) {
        const std::uint64_t one = g % 2 ? 4 : 6, other = against ? 10 - one : one;
        layer.spread.groups.rays[g] = 10;
        layer.spread.groups.energy[g * 8] = one * kRayEnergy;
        layer.spread.groups.energy[g * 8 + 5] = other * kRayEnergy;
    }
    for (const int cell : {0, 5}) {
        test::add_rays(m, layer, 0, 0, cell, 80);
        // 16 values of 0.4 and 0.6: sample variance 0.16 / 15, of the mean a 16th
        layer.stderr_energy[static_cast<std::size_t>(cell)] =
            static_cast<float>(std::sqrt(0.16 / 15 / 16));
    }
    return m;
}

TEST(Region, CellsThatErrTogetherAddTheirErrors) {
    const Measurement together = two_cells(false), against = two_cells(true);
    const double one = std::sqrt(0.16 / 15 / 16);
    const auto error = [](const Measurement& m, std::vector<int> cells) {
        return energy_of_cells(m, m.layers[0], 0, cells).error;
    };
    EXPECT_NEAR(error(together, {0, 5}), 2 * one, 1e-12);
    EXPECT_NEAR(error(against, {0, 5}), 0, 1e-12);
    EXPECT_NEAR(error(against, {0}), one, 1e-8);
    EXPECT_NEAR(error(against, {0, 1}), one, 1e-12);
    const EnergyOfCells both = energy_of_cells(against, against.layers[0], 0, std::vector{0, 5});
    EXPECT_EQ(both.energy, 1);
    EXPECT_FALSE(both.few_rays);
    EXPECT_TRUE(energy_of_cells(against, against.layers[0], 0, std::vector{1, 2}).few_rays);
}

TEST(Region, AllOfTheHemisphereIsTheAlbedo) {
    Experiment e = test::small_experiment();
    e.optics = test::gold_like();
    for (const int resolution : {32, 100}) {
        e.detector.resolution = resolution;
        const Measurement m = test::measured(test::noise(64, 1), e);
        for (const Layer& layer : m.layers)
            for (int channel = 0; channel < m.channels(); ++channel) {
                const EnergyOfCells all = energy_of_cells(m, layer, channel, all_cells(m));
                EXPECT_NEAR(all.energy, m.albedo(layer, channel), 1e-12);
                const double albedo = layer.stderr_albedo[static_cast<std::size_t>(channel)];
                EXPECT_NEAR(all.error / albedo, 1, 1e-6);
            }
    }
}

TEST(Region, IsNotKnownWhereNothingIsKept) {
    Measurement m = two_cells(false);
    m.layers[0].spread = {};
    EXPECT_TRUE(std::isnan(energy_of_cells(m, m.layers[0], 0, std::vector{0, 5}).error));
}

TEST(CellErrorsTest, WeightsTellWhetherCellsErrTogether) {
    // Cells 0 and 5 of two_cells(): both 0.4 or 0.6 in a group, or one the rest of the other
    const Measurement together = two_cells(false), against = two_cells(true);
    const double one = std::sqrt(0.16 / 15 / 16);
    const auto error = [](const Measurement& m, double of_0, double of_5) {
        std::vector<double> weights(8, 0.0);
        weights[0] = of_0;
        weights[5] = of_5;
        return CellErrors(m, m.layers[0]).error(weights);
    };
    EXPECT_NEAR(error(together, 1, 1), 2 * one, 1e-12);
    EXPECT_NEAR(error(together, 1, -1), 0, 1e-12);
    EXPECT_NEAR(error(together, 3, -1), 2 * one, 1e-12);
    EXPECT_NEAR(error(against, 1, 1), 0, 1e-12);
    EXPECT_NEAR(error(against, 1, -1), 2 * one, 1e-12);

    const CellErrors errors(against, against.layers[0]);
    std::vector<std::vector<double>> weights(2, std::vector<double>(8, 0.0));
    weights[0][0] = weights[1][5] = 1;
    const std::vector<double> covariances = errors.covariances(weights);
    EXPECT_NEAR(covariances[0], one * one, 1e-12);
    EXPECT_NEAR(covariances[1], -one * one, 1e-12);
    EXPECT_NEAR(covariances[2], -one * one, 1e-12);
    EXPECT_NEAR(covariances[3], one * one, 1e-12);
    weights[1].pop_back();
    EXPECT_THROW((void)errors.covariances(weights), Error);
}

}  // namespace
}  // namespace asperity

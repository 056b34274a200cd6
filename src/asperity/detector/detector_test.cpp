// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/random.h>
#include <asperity/detector/detector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <tuple>

namespace asperity {
namespace {

class DetectorOfEachKind : public testing::TestWithParam<std::tuple<DetectorKind, int>> {
  protected:
    Detector detector{
        DetectorSettings{std::get<0>(GetParam()), std::get<1>(GetParam()), /*orders=*/4}};
};
INSTANTIATE_TEST_SUITE_P(Kinds, DetectorOfEachKind,
                         testing::Combine(testing::Values(DetectorKind::LatLong,
                                                          DetectorKind::EqualArea),
                                          testing::Values(2, 7, 32, 255, 512)));

TEST_P(DetectorOfEachKind, CellsCoverTheHemisphereExactlyOnce) {
    // Integral of cos over the hemisphere = pi, of 1 = 2 pi.
    double projected = 0, solid = 0;
    for (int row = 0; row < detector.rows(); ++row) {
        projected += detector.projected_solid_angle(row) * detector.columns();
        solid += detector.solid_angle(row) * detector.columns();
    }
    EXPECT_NEAR(projected, kPi, 1e-12);
    EXPECT_NEAR(solid, 2 * kPi, 1e-12);
}

TEST_P(DetectorOfEachKind, EveryCellFindsItsCentreAndItsOwnEdges) {
    const double inside = 1e-9;
    for (int row = 0; row < detector.rows(); ++row)
        for (int column = 0; column < detector.columns(); ++column) {
            const int cell = row * detector.columns() + column;
            EXPECT_EQ(detector.cell_of(detector.centre(cell)), cell);
            const double theta_a = detector.theta_edge(row) + inside;
            const double theta_b = detector.theta_edge(row + 1) - inside;
            const double phi_a = detector.phi_edge(column) + 1e-6;
            const double phi_b = detector.phi_edge(column + 1) - 1e-6;
            EXPECT_EQ(detector.cell_of(from_spherical(theta_b, phi_b)), cell);
            if (row > 0) {
                EXPECT_EQ(detector.cell_of(from_spherical(theta_a, phi_a)), cell);
            }
        }
}

TEST_P(DetectorOfEachKind, RowsAreToldApartToTheLastBit) {
    for (int edge = 1; edge < detector.rows(); ++edge)
        for (int turn = 0; turn < 8; ++turn)
            for (const int steps : {-2, -1, 0, 1, 2}) {
                double theta = detector.theta_edge(edge);
                for (int k = 0; k < std::abs(steps); ++k)
                    theta = std::nextafter(theta, 9.0 * steps);
                const Vec3 wo = from_spherical(theta, 0.7 * turn);
                const int row = detector.cell_of(wo) / detector.columns();
                EXPECT_LE(detector.theta_edge(row), polar_angle(wo));
                EXPECT_GT(detector.theta_edge(row + 1), polar_angle(wo));
            }
}

TEST_P(DetectorOfEachKind, UniformFluxFillsCellsByTheirProjectedSolidAngle) {
    // Directions of a perfectly diffuse surface: density cos / pi. Chi-square over the cells.
    if (detector.cells() > 2000) return;  // too few samples per cell to test
    const CounterRandom random(3, 0);
    constexpr int kSamples = 400000;
    std::vector<int> counts(static_cast<std::size_t>(detector.cells()));
    for (int k = 0; k < kSamples; ++k) {
        const auto u = random.uniform2(static_cast<std::uint64_t>(k));
        ++counts[static_cast<std::size_t>(
            detector.cell_of(from_spherical(std::asin(std::sqrt(u[0])), 2 * kPi * u[1])))];
    }
    double chi2 = 0;
    for (int cell = 0; cell < detector.cells(); ++cell) {
        const double expected =
            kSamples * detector.projected_solid_angle(cell / detector.columns()) / kPi;
        const double d = counts[static_cast<std::size_t>(cell)] - expected;
        chi2 += d * d / expected;
    }
    const double dof = detector.cells() - 1;
    EXPECT_LT(chi2, dof + 5 * std::sqrt(2 * dof) + 10);
}

TEST(Detector, HorizonAndPoleBelongToACell) {
    for (const DetectorKind kind : {DetectorKind::LatLong, DetectorKind::EqualArea}) {
        const Detector d(DetectorSettings{kind, 64, 4});
        EXPECT_EQ(d.cell_of({0, 0, 1}), 0);
        EXPECT_EQ(d.cell_of({1, 0, 0}) / d.columns(), d.rows() - 1);
        EXPECT_EQ(d.cell_of({1, -1e-300, 0}) % d.columns(), 0);
        EXPECT_EQ(d.cell_of({std::sqrt(0.5), 0, std::sqrt(0.5)}) % d.columns(), 0);
    }
}

TEST(Detector, ThesisResolutionsHaveTheThesisShape) {
    // R x R sky-map of the whole sphere: its upper half is R columns by R / 2 rows.
    for (const int r : {32, 64, 128, 256, 512}) {
        const Detector d(DetectorSettings{DetectorKind::LatLong, r, 4});
        EXPECT_EQ(d.columns(), r);
        EXPECT_EQ(d.rows(), r / 2);
        EXPECT_NEAR(d.theta_edge(1), kPi / r, 1e-15);  // v = theta / pi in R steps
    }
}

TEST(Detector, ThesisSkyMapFollowsItsEquation) {
    // Eq. 4.5 by hand, thesis axes (x, y, z) = ours (x, z, -y): straight up is v = 0; the thesis'
    // -z (our +y) is u = 1/2; +x is u = 3/4; the horizon is v = 1/2, straight down v just below 1.
    EXPECT_NEAR(thesis_sky_map({0, 0, 1}).v, 0, 1e-15);
    EXPECT_NEAR(thesis_sky_map({0, 1, 0}).u, 0.5, 1e-15);
    EXPECT_NEAR(thesis_sky_map({1, 0, 0}).u, 0.75, 1e-15);
    EXPECT_NEAR(thesis_sky_map({-1, 0, 0}).u, 0.25, 1e-15);
    EXPECT_NEAR(thesis_sky_map({1, 0, 0}).v, 0.5, 1e-15);
    EXPECT_LT(thesis_sky_map({0, 0, -1}).v, 1);
    EXPECT_EQ(thesis_sky_map({1e-30, -1, 0}).u, 0);  // u = 1 wraps to 0: nothing out of range
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/lobe_slice.h>

#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/measured/analytic_measurement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

Experiment one_light(double theta_deg, double phi_deg, int resolution,
                     DetectorKind kind = DetectorKind::LatLong) {
    Experiment e;
    e.illumination.theta_deg = {theta_deg};
    e.illumination.phi_deg = {phi_deg};
    e.detector.resolution = resolution;
    e.detector.kind = kind;
    return e;
}

/// A measurement of 16 columns and 8 rows where nothing came back, with error bars of nothing.
Measurement dark(double phi_deg) {
    const LambertBrdf black({0.0});
    Measurement m = test::measurement_of(black, one_light(40, phi_deg, 16));
    m.layers[0].stderr_energy.assign(static_cast<std::size_t>(m.detector.cells()), 0.0f);
    return m;
}

void light_up(Measurement& m, int row, int column, double fraction, float error) {
    Layer& layer = m.layers[0];
    const std::size_t cell = static_cast<std::size_t>(row * m.detector.columns() + column);
    layer.energy[cell] = static_cast<std::uint64_t>(fraction * static_cast<double>(kRayEnergy) *
                                                    static_cast<double>(layer.rays));
    layer.stderr_energy[cell] = error;
}

TEST(LobeSliceTest, LambertIsOneOverPiEverywhere) {
    const LambertBrdf white({1.0});
    for (const DetectorKind kind : {DetectorKind::LatLong, DetectorKind::EqualArea})
        for (const double phi_deg : {0.0, 30.0, 101.25}) {
            const Measurement m = test::measurement_of(white, one_light(40, phi_deg, 32, kind));
            const LobeSlice measured = lobe_slice(m, m.layers[0], -1);
            const LobeSlice model = lobe_slice(white, m, m.layers[0], 0);
            ASSERT_EQ(measured.samples.size(), 32u);
            for (std::size_t k = 0; k < 32; ++k) {
                EXPECT_NEAR(measured.samples[k].f, 1 / kPi, 1e-9);
                EXPECT_NEAR(model.samples[k].f, 1 / kPi, 1e-12);
                EXPECT_EQ(measured.samples[k].f_stderr, 0);
            }
        }
}

TEST(LobeSliceTest, RunsFromTheLightToItsMirrorImage) {
    const LambertBrdf white({1.0});
    const Measurement m = test::measurement_of(white, one_light(40, 100, 32));
    const LobeSlice slice = lobe_slice(m, m.layers[0], 0);
    EXPECT_TRUE(std::is_sorted(
        slice.samples.begin(), slice.samples.end(),
        [](const LobeSample& a, const LobeSample& b) { return a.theta_o < b.theta_o; }));
    EXPECT_NEAR(slice.samples.front().theta_o, -radians(90 - 90.0 / 32), 1e-12);
    for (const LobeSample& sample : slice.samples) {
        const double phi = radians(sample.theta_o < 0 ? 100 : 280);
        EXPECT_EQ(sample.cell, m.detector.cell_of(from_spherical(std::abs(sample.theta_o), phi)));
    }
}

TEST(LobeSliceTest, OneLitCellBesideThePlaneCountsHalf) {
    Measurement m = dark(0);
    const int row = 7;  // at the horizon, where the strip is just over two columns wide
    light_up(m, row, 8, 0.25, 0.01f);  // azimuth 180 .. 202.5 degrees: the mirror side
    const LobeSlice slice = lobe_slice(m, m.layers[0], 0);
    const double half = 1 / std::sin(m.detector.theta_centre(row));  // strip in columns
    const double f = m.brdf(m.layers[0], 0, row * 16 + 8);
    for (const LobeSample& sample : slice.samples) {
        const bool lit = sample.theta_o > m.detector.theta_edge(row);
        EXPECT_NEAR(sample.f, lit ? f / (2 * half) : 0, 1e-9 * f) << sample.theta_o;
    }
    const LobeSample& lit = slice.samples.back();
    EXPECT_NEAR(lit.f_stderr / lit.f, 0.01 / 0.25, 1e-6);
    EXPECT_NEAR(lit.f_cos / lit.f,
                m.detector.projected_solid_angle(row) / m.detector.solid_angle(row), 1e-12);
    EXPECT_NEAR(lit.f_cos_stderr / lit.f_cos, 0.01 / 0.25, 1e-6);
}

TEST(LobeSliceTest, TwoLitCellsHaveIndependentErrors) {
    Measurement m = dark(180);  // the light side is now at azimuth 180 degrees
    light_up(m, 7, 7, 0.1, 0.003f);
    light_up(m, 7, 8, 0.3, 0.004f);
    const LobeSample lit = lobe_slice(m, m.layers[0], 0).samples.front();
    EXPECT_NEAR(lit.f_stderr / lit.f, 0.005 / 0.4, 1e-6);
}

TEST(LobeSliceTest, ACellPartlyInTheStripKeepsItsRelativeError) {
    Measurement m = dark(0);
    light_up(m, 7, 9, 0.25, 0.01f);  // the second column beside the plane: half of it counts
    const LobeSample lit = lobe_slice(m, m.layers[0], 0, {.columns = 1.5}).samples.back();
    const double half = 1.5 / std::sin(m.detector.theta_centre(7));  // strip in columns
    EXPECT_NEAR(lit.f, m.brdf(m.layers[0], 0, 7 * 16 + 9) * (half - 1) / (2 * half), 1e-9);
    EXPECT_NEAR(lit.f_stderr / lit.f, 0.01 / 0.25, 1e-6);
}

TEST(LobeSliceTest, AtThePoleAllCellsOfASideCount) {
    Measurement m = dark(0);
    light_up(m, 0, 11, 0.5, 0);  // azimuth 247.5 .. 270 degrees: just on the mirror side
    const LobeSlice slice = lobe_slice(m, m.layers[0], 0);
    const double f = m.brdf(m.layers[0], 0, 11);
    EXPECT_NEAR(slice.samples[8].f, f / 8, 1e-9 * f);
    EXPECT_EQ(slice.samples[7].f, 0);
}

TEST(LobeSliceTest, AModelIsAveragedOverTheSameCells) {
    for (const char* spec : {"ggx:alpha=0.1", "beckmann:alpha=0.3,alpha_y=0.1"}) {
        const auto model = parse_brdf_spec(spec);
        for (const bool isotropic : {false, true}) {
            Experiment e = one_light(50, isotropic ? 0 : 20, 64);
            e.illumination.isotropic = isotropic;
            const Measurement m = test::measurement_of(*model, e);
            const LobeSlice measured = lobe_slice(m, m.layers[0], 0);
            const LobeSlice exact = lobe_slice(*model, m, m.layers[0], 0);
            for (std::size_t k = 0; k < measured.samples.size(); ++k)
                EXPECT_NEAR(measured.samples[k].f, exact.samples[k].f,
                            1e-9 + 1e-9 * exact.samples[k].f)
                    << spec;
        }
    }
}

TEST(LobeSliceTest, ChannelsAndTheirMean) {
    const LambertBrdf colour({0.2, 0.4, 0.9});
    const Measurement m = test::measurement_of(colour, one_light(30, 0, 16));
    EXPECT_NEAR(lobe_slice(m, m.layers[0], 2).samples[3].f, 0.9 / kPi, 1e-9);
    EXPECT_NEAR(lobe_slice(m, m.layers[0], -1).samples[3].f, 0.5 / kPi, 1e-9);
    EXPECT_NEAR(lobe_slice(colour, m, m.layers[0], -1).samples[3].f, 0.5 / kPi, 1e-9);
    EXPECT_THROW(lobe_slice(m, m.layers[0], 3), Error);
    EXPECT_THROW(lobe_slice(colour, m, m.layers[0], -2), Error);
}

}  // namespace
}  // namespace asperity

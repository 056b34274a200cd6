// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/measured/analytic_measurement.h>
#include <asperity/measured/patch_integrator.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

Experiment one_layer(double theta_deg, int resolution) {
    Experiment e;
    e.illumination.theta_deg = {theta_deg};
    e.detector.resolution = resolution;
    return e;
}

TEST(CellAverageTest, LambertFillsTheCellsByTheirProjectedSolidAngle) {
    const auto lambert = parse_brdf_spec("lambert:albedo=0.5");
    for (const DetectorKind kind : {DetectorKind::LatLong, DetectorKind::EqualArea}) {
        const Detector detector({kind, 64, 1});
        const CellAverages a = average_over_cells(*lambert, detector, 0.7, 0.2, false, 2);
        for (int cell = 0; cell < detector.cells(); ++cell)
            EXPECT_NEAR(a.energy[static_cast<std::size_t>(cell)],
                        0.5 / kPi * detector.projected_solid_angle(cell / detector.columns()),
                        1e-14);
        EXPECT_NEAR(a.albedo[0], 0.5, 1e-12);
    }
}

TEST(CellAverageTest, SharpLobesKeepTheirEnergy) {
    // With F = 1 and alpha = .05 nothing is lost up to 60 degrees: the cells must add up to 1, also
    // coarse cells that hold the whole lobe.
    const auto sharp = parse_brdf_spec("beckmann:alpha=0.05");
    const auto sharper = parse_brdf_spec("beckmann:alpha=0.004");
    for (const double theta_deg : {0.0, 12.0, 60.0})
        for (const int resolution : {16, 64, 256}) {
            const Detector detector({DetectorKind::LatLong, resolution, 1});
            const double theta = radians(theta_deg);
            EXPECT_NEAR(average_over_cells(*sharp, detector, theta, 1, false, 2).albedo[0], 1, 2e-4)
                << theta_deg << " " << resolution;
            EXPECT_NEAR(average_over_cells(*sharper, detector, theta, 1, false, 2).albedo[0], 1,
                        1e-3)
                << theta_deg << " " << resolution;
        }
}

/// A model of which nobody says that it is alike on both sides of the plane of incidence.
class OneSided : public Bsdf {
  public:
    explicit OneSided(const Bsdf& model) : model_(model) {}
    int channels() const override { return model_.channels(); }
    std::string name() const override { return model_.name(); }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override { model_.eval(wi, wo, f); }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return model_.sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return model_.pdf(wi, wo); }
    bool isotropic() const override { return true; }

  private:
    const Bsdf& model_;
};

TEST(CellAverageTest, BothSidesOfThePlaneOfIncidenceAreAlike) {
    const auto model = parse_brdf_spec("ggx:alpha=0.2,f0=0.9/0.5/0.1");
    const OneSided all(*model);
    // Rounding may have either side look closer where a rule is just fine enough
    for (const int resolution : {15, 32}) {  // an odd number has a column that is its own mirror
        const Detector detector({DetectorKind::LatLong, resolution, 1});
        // Edges of columns, their middles, neither
        for (const double column : {0.0, 1.0, 0.5, 7.0, 14.5, -3.0, 0.3}) {
            const double phi = 2 * kPi * column / resolution;
            const CellAverages half = average_over_cells(*model, detector, 0.8, phi, false, 2);
            const CellAverages whole = average_over_cells(all, detector, 0.8, phi, false, 2);
            for (std::size_t k = 0; k < whole.energy.size(); ++k)
                ASSERT_NEAR(half.energy[k], whole.energy[k], 2e-4 / detector.cells())
                    << resolution << " " << column;
        }
    }
}

TEST(CellAverageTest, SameBitsForAnyNumberOfThreads) {
    const auto brdf = parse_brdf_spec("ggx:alpha=0.2,alpha_y=0.4,f0=0.9/0.5/0.1");
    const Detector detector({DetectorKind::LatLong, 32, 1});
    const CellAverages one = average_over_cells(*brdf, detector, 1, 2, true, 1);
    for (const int threads : {2, 3, 7})
        EXPECT_EQ(one.energy, average_over_cells(*brdf, detector, 1, 2, true, threads).energy);
}

TEST(CellAverageTest, RowsHoldWhatTheirCellsHold) {
    const Detector detector({DetectorKind::LatLong, 32, 1});
    for (const char* spec : {"beckmann:alpha=0.1,material=Au", "ggx:alpha=0.2,alpha_y=0.4"}) {
        const auto brdf = parse_brdf_spec(spec);
        const CellAverages all = average_over_cells(*brdf, detector, 1, 2, true, 2);
        const detail::CellIntegrator cells(*brdf, detector, 1, 2, true);
        for (int cell = 0; cell < detector.cells(); ++cell) {
            const detail::Channels one =
                cells.integrate(cell / detector.columns(), cell % detector.columns());
            for (int c = 0; c < brdf->channels(); ++c) {
                const double energy = one[static_cast<std::size_t>(c)];
                ASSERT_NEAR(all.energy[static_cast<std::size_t>(c * detector.cells() + cell)],
                            energy, 1e-12 * energy + 1e-18)
                    << spec << " " << cell;
            }
        }
    }
}

TEST(CellAverageTest, IsotropicModeTurnsTheDetectorWithTheLight) {
    // The mean over all azimuths of the light cannot depend on the axes: alpha_x and alpha_y swap.
    const Detector detector({DetectorKind::LatLong, 32, 1});
    const auto a = parse_brdf_spec("beckmann:alpha=0.3,alpha_y=0.6");
    const auto b = parse_brdf_spec("beckmann:alpha=0.6,alpha_y=0.3");
    const CellAverages ea = average_over_cells(*a, detector, 0.8, 0, true, 2);
    const CellAverages eb = average_over_cells(*b, detector, 0.8, 0, true, 2);
    double l1 = 0, fixed = 0;
    const CellAverages ef = average_over_cells(*a, detector, 0.8, 0, false, 2);
    for (std::size_t k = 0; k < ea.energy.size(); ++k) {
        l1 += std::abs(ea.energy[k] - eb.energy[k]);
        fixed += std::abs(ea.energy[k] - ef.energy[k]);
    }
    EXPECT_LT(l1, 1e-4);
    EXPECT_GT(fixed, 0.1);
    // Light from +x: the mirror direction stays at azimuth 180 degrees, columns 15 and 16 of 32.
    const std::size_t row = 7;  // theta 45.8 degrees lies at row 0.8 / (pi / 2) * 16 = 8.1
    EXPECT_GT(ea.energy[(row + 1) * 32 + 16], 5 * ea.energy[(row + 1) * 32]);
}

TEST(CompareTest, LambertAgainstLambertByHand) {
    // f differs by 0.3 / pi everywhere. l1 = 0.3 / pi * integral of cos = 0.3.
    // rms^2 = (0.3 / pi)^2 mean of cos^2 over the hemisphere = (0.3 / pi)^2 / 3.
    const auto a = parse_brdf_spec("lambert:albedo=0.8"), b = parse_brdf_spec("lambert:albedo=0.5");
    const Comparison c = compare(*a, *b, one_layer(40, 256), 2);
    ASSERT_EQ(c.layers.size(), 1u);
    EXPECT_NEAR(c.layers[0].albedo_difference, 0.3, 1e-10);
    EXPECT_NEAR(c.layers[0].l1, 0.3, 1e-10);
    EXPECT_NEAR(c.layers[0].rms, 0.3 / kPi / std::sqrt(3.0), 1e-5);
    EXPECT_EQ(c.layers[0].l1_noise, 0);
    EXPECT_NEAR(c.mean_l1, 0.3, 1e-10);
    EXPECT_NEAR(c.max_albedo_difference, 0.3, 1e-10);
    EXPECT_EQ(c.name_a, "lambert:albedo=0.8");
}

TEST(CompareTest, ThesisLayersAndChannels) {
    // One channel against three: it serves each. Differences 0.2, 0, 0.4: mean 0.2; albedo 0.0667.
    Experiment e;
    e.illumination.layers = 5;
    e.detector.resolution = 16;
    const auto a = parse_brdf_spec("lambert:albedo=0.5");
    const auto b = parse_brdf_spec("lambert:albedo=0.3/0.5/0.9");
    const Comparison c = compare(*a, *b, e, 2);
    ASSERT_EQ(c.layers.size(), 5u);
    EXPECT_EQ(c.layers[0].number, 5);
    EXPECT_NEAR(degrees(c.layers[4].theta_i), 72, 1e-9);
    for (const LayerComparison& layer : c.layers) {
        EXPECT_NEAR(layer.l1, 0.2, 1e-10);
        EXPECT_NEAR(layer.albedo_difference, 0.5 - 1.7 / 3, 1e-10);
    }
}

TEST(CompareTest, DisjointLobesAreTwoApart) {
    // Mirror lobes of albedo 1 in different places share no cell: l1 = 2.
    const auto model = parse_brdf_spec("beckmann:alpha=0.01");
    const Measurement a = test::measurement_of(*model, one_layer(10, 64));
    Measurement b = test::measurement_of(*model, one_layer(50, 64));
    b.layers[0].theta_i = a.layers[0].theta_i;
    EXPECT_NEAR(compare(a, b).mean_l1, 2, 2e-3);
    EXPECT_NEAR(compare(a, a).mean_l1, 0, 1e-15);
}

TEST(CompareTest, ErrorBarsMakeTheExpectedNoise) {
    // Every cell with the same standard error s on both sides: sum sqrt(2 / pi) sqrt(2) s.
    const auto model = parse_brdf_spec("lambert:albedo=0.5");
    Measurement a = test::measurement_of(*model, one_layer(10, 16));
    a.layers[0].stderr_energy.assign(16 * 8, 0.25f);
    EXPECT_NEAR(compare(a, a).layers[0].l1_noise, 128 * std::sqrt(2 / kPi) * std::sqrt(2.0) * 0.25,
                1e-9);
    EXPECT_NEAR(compare(a, *model, 2).layers[0].l1_noise, 128 * std::sqrt(2 / kPi) * 0.25, 1e-9);
    EXPECT_NEAR(compare(a, *model, 2).layers[0].l1, 0, 1e-9);
}

TEST(CompareTest, SaysWhatDiffers) {
    const auto model = parse_brdf_spec("lambert:albedo=0.5");
    const auto rgb = parse_brdf_spec("lambert:albedo=0.5/0.4/0.3");
    const auto two = parse_brdf_spec("lambert:albedo=0.5/0.4");
    const Measurement a = test::measurement_of(*model, one_layer(10, 16));
    const auto message = [](const Measurement& x, const Measurement& y) {
        try {
            compare(x, y);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::InvalidInput);
            return e.message();
        }
        return std::string("accepted");
    };
    EXPECT_EQ(message(a, test::measurement_of(*rgb, one_layer(10, 16))), "accepted");
    EXPECT_NE(message(test::measurement_of(*two, one_layer(10, 16)),
                      test::measurement_of(*rgb, one_layer(10, 16)))
                  .find("2 channels, the other 3"),
              std::string::npos);
    EXPECT_NE(message(a, test::measurement_of(*model, one_layer(10, 32))).find("8 x 16 cells"),
              std::string::npos);
    EXPECT_NE(message(a, test::measurement_of(*model, one_layer(20, 16)))
                  .find("only one has a layer at theta 10, phi 0 degrees"),
              std::string::npos);
    Experiment equal = one_layer(10, 16);
    equal.detector.kind = DetectorKind::EqualArea;
    EXPECT_NE(message(a, test::measurement_of(*model, equal)).find("equal areas"),
              std::string::npos);
    EXPECT_THROW(compare(test::measurement_of(*two, one_layer(10, 16)), *rgb, 1), Error);
}

// Lobes of one model at angles that lie between each other's: interpolation has to bring them
// together far better than taking the nearest layer does, and the albedos, here smooth in the
// angle, to the blend of the neighbours.
TEST(CompareTest, BetweenLayersTheLobeIsWhereTheLightSendsIt) {
    const auto model = parse_brdf_spec("ggx:alpha=0.2,f0=0.5");
    Experiment odd = one_layer(0, 64), even = odd;
    odd.illumination.theta_deg = {5, 15, 25, 35, 45, 55};
    even.illumination.theta_deg = {0, 10, 20, 30, 40, 50, 60};
    const Measurement a = test::measurement_of(*model, odd), b = test::measurement_of(*model, even);
    EXPECT_EQ(unlike(a, b), "one has 6 layers, the other 7");
    const Comparison between = compare_between_layers(a, b, asperity::Run(2));
    ASSERT_EQ(between.layers.size(), 6u);
    Measurement nearest = b;
    nearest.layers.pop_back();
    for (std::size_t k = 0; k < nearest.layers.size(); ++k)
        nearest.layers[k].theta_i = a.layers[k].theta_i;
    const Comparison moved = compare(a, nearest);
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_LT(between.layers[k].l1, 0.3 * moved.layers[k].l1) << k;
        EXPECT_NEAR(between.layers[k].albedo_difference, 0, 0.01) << k;
    }
}

/// Where the lobe is narrow and shadowed, between layers set by it and beyond those of the thesis.
TEST(CompareTest, BetweenLayersSetByTheLobe) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.2");
    Experiment between = one_layer(0, 32), lobe = between, thesis = between;
    between.illumination.theta_deg = {3, 27, 51, 75, 81, 87, 89.5};
    lobe.illumination.theta_deg = angles_of_lobe(0.2, {});
    thesis.illumination.theta_deg.clear();
    const Measurement truth = test::measurement_of(*model, between);
    const auto distances = [&](const Experiment& experiment) {
        const Measurement table = test::measurement_of(*model, experiment);
        return compare_between_layers(truth, table, asperity::Run(2)).layers;
    };
    const std::vector<LayerComparison> near = distances(lobe), far = distances(thesis);
    ASSERT_EQ(near.size(), 7u);
    for (const LayerComparison& layer : near) {
        EXPECT_LT(layer.l1, 0.02) << degrees(layer.theta_i);
        EXPECT_NEAR(layer.albedo_difference, 0, 0.005) << degrees(layer.theta_i);
    }
    for (std::size_t k = 5; k < 7; ++k) EXPECT_GT(far[k].l1, 3 * near[k].l1) << k;
}

// 16 groups of 10 rays on 2 x 4 cells. Cell 0 gets 4 or 6 of each in turn, cell 5 a tenth of the
// rest: 0.5 and 0.05 in the mean, where a white diffuse surface has 0.125. So L1 grows with the
// first and falls with the second, and both with the group.
TEST(CompareTest, ErrorsKnowWhatCellsDoTogether) {
    const auto white = parse_brdf_spec("lambert:albedo=1");
    Measurement m = test::measurement_of(*white, one_layer(0, 4));
    Layer& layer = m.layers[0];
    ASSERT_EQ(layer.energy.size(), 8u);
    EXPECT_TRUE(std::isnan(compare(m, *white, 1).layers[0].l1_error));
    layer.rays = 160;
    layer.energy.assign(8, 0);
    layer.energy[0] = 80 * kRayEnergy;
    layer.energy[5] = 8 * kRayEnergy;
    layer.escaped = {88 * kRayEnergy};
    layer.escaped_by_bounce = layer.escaped;
    layer.stderr_energy.assign(8, 0.01F);
    layer.spread.groups = GroupSums(m.shape());
    for (std::size_t g = 0; g < 16; ++g) {
        const std::uint64_t more = g % 2 == 0 ? 6 : 4;
        layer.spread.groups.rays[g] = 10;
        layer.spread.groups.energy[g * 8] = more * kRayEnergy;
        layer.spread.groups.energy[g * 8 + 5] = (10 - more) * (kRayEnergy / 10);
    }
    const double one = std::sqrt(0.16 / 15 / 16);  // of cell 0, see CellErrors
    const LayerComparison c = compare(m, *white, 1).layers[0];
    EXPECT_NEAR(c.l1, 0.375 + 0.075 + 6 * 0.125, 1e-9);
    EXPECT_NEAR(c.l1_error, 1.1 * one, 1e-9);
    EXPECT_NEAR(c.albedo_difference_error, 0.9 * one, 1e-9);
    // d rms = sum of d_b / omega_b delta_b / (2 pi rms)
    const double top = m.detector.solid_angle(0), low = m.detector.solid_angle(1);
    EXPECT_NEAR(c.rms_error, (0.375 / top + 0.1 * 0.075 / low) * one / (2 * kPi * c.rms), 1e-9);
    // Two that were measured apart
    EXPECT_NEAR(compare(m, m).layers[0].albedo_difference_error, std::sqrt(2.0) * 0.9 * one, 1e-9);
}

}  // namespace
}  // namespace asperity

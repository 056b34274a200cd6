// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/measured/analytic_measurement.h>
#include <asperity/measured/tabulated.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

Experiment layers_at(std::vector<double> theta_deg, std::vector<double> phi_deg, int resolution,
                     DetectorKind kind = DetectorKind::LatLong) {
    Experiment e;
    e.illumination.theta_deg = std::move(theta_deg);
    e.illumination.phi_deg = std::move(phi_deg);
    e.detector.resolution = resolution;
    e.detector.kind = kind;
    return e;
}

double value(const Bsdf& brdf, Vec3 wi, Vec3 wo) {
    double f = 0;
    brdf.eval(wi, wo, {&f, 1});
    return f;
}

/// Distance of two models' lobes over the cells of a detector, relative to the energy of `a`.
double relative_l1(const Bsdf& a, const Bsdf& b, double theta_deg, double phi_deg, int resolution) {
    const Experiment e = layers_at({theta_deg}, {phi_deg}, resolution);
    const Comparison c = compare(a, b, e, 2);
    return c.layers[0].l1 / c.layers[0].albedo_a;
}

TEST(TabulatedTest, BetweenLayersThereAreNoGhostLobes) {
    // Layers 6 degrees apart, asked 3 degrees off. Showing the nearest layer is wrong by .29, .14
    // and .05 of the energy for alpha .1, .2, .5; blending the two layers by .06, .02, .01.
    struct Row {
        const char* spec;
        double at_33, at_63;
    };
    constexpr Row rows[] = {{"beckmann:alpha=0.1", .001, .015},
                            {"beckmann:alpha=0.2", .001, .007},
                            {"beckmann:alpha=0.5", .001, .002}};
    for (const Row& row : rows) {
        const auto model = parse_brdf_spec(row.spec);
        const auto table = make_tabulated_brdf(
            test::measurement_of(*model, layers_at({30, 36, 60, 66}, {0}, 128)));
        EXPECT_LT(relative_l1(*model, *table, 33, 0, 128), row.at_33) << row.spec;
        EXPECT_LT(relative_l1(*model, *table, 63, 0, 128), row.at_63) << row.spec;
    }
}

TEST(TabulatedTest, OneLobeBetweenTwoLayers) {
    // alpha = .05 and layers 20 degrees apart: in the plane of incidence the lobe of the blend has
    // one maximum, at the mirror angle, where a plain blend has two, 10 degrees to either side.
    const auto model = parse_brdf_spec("beckmann:alpha=0.05");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({20, 40}, {0}, 256)));
    const Vec3 wi = from_spherical(radians(30), 0);
    int maxima = 0;
    double before = 0, here = 0, peak = 0, at = 0;
    for (double deg = 0; deg < 89; deg += 0.5) {
        const double next = value(*table, wi, from_spherical(radians(deg), kPi));
        if (here > before && here >= next && here > 0.01) ++maxima;
        if (next > peak) peak = next, at = deg;
        before = here;
        here = next;
    }
    EXPECT_EQ(maxima, 1);
    EXPECT_NEAR(at, 30, 1);
    EXPECT_NEAR(peak, value(*model, wi, from_spherical(radians(30), kPi)), 0.05 * peak);
}

TEST(TabulatedTest, CellsComeBackAsMeasured) {
    for (const DetectorKind kind : {DetectorKind::LatLong, DetectorKind::EqualArea}) {
        const auto model = parse_brdf_spec("ggx:alpha=0.3,alpha_y=0.5");
        const Measurement m = test::measurement_of(*model, layers_at({50}, {0, 180}, 64, kind));
        const auto table = make_tabulated_brdf(m);
        for (const LayerComparison& layer : compare(m, *table, 2).layers) {
            EXPECT_LT(layer.l1, 0.01) << degrees(layer.theta_i);
            EXPECT_NEAR(layer.albedo_difference, 0, 2e-3);
        }
    }
}

TEST(TabulatedTest, AlbedoIsTheBlendOfTheLayersAlbedos) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.5,f0=0.9/0.5/0.1");
    const Measurement m = test::measurement_of(*model, layers_at({0, 30, 60, 84}, {0}, 64));
    const auto table = make_tabulated_brdf(m);
    ASSERT_EQ(table->channels(), 3);
    for (const double theta_deg : {0.0, 15.0, 45.0, 72.0, 84.0, 88.0}) {
        // Layers stand in the order of theta here: blend by hand.
        std::size_t k = 0;
        while (k + 2 < 4 && degrees(m.layers[k + 1].theta_i) <= theta_deg) ++k;
        const double a = degrees(m.layers[k].theta_i), b = degrees(m.layers[k + 1].theta_i);
        const double t = std::clamp((theta_deg - a) / (b - a), 0.0, 1.0);
        const CellAverages averages =
            average_over_cells(*table, m.detector, radians(theta_deg), 1, false, 2);
        std::vector<double> promised(3);
        table->albedo(from_spherical(radians(theta_deg), 1), promised);
        for (int c = 0; c < 3; ++c) {
            const double blend =
                (1 - t) * m.albedo(m.layers[k], c) + t * m.albedo(m.layers[k + 1], c);
            const std::size_t channel = static_cast<std::size_t>(c);
            EXPECT_NEAR(promised[channel], blend, 1e-9);
            EXPECT_NEAR(averages.albedo[channel], blend, 5e-3 * blend) << theta_deg;
        }
    }
}

// At grazing incidence a lobe of alpha 0.1 is 0.85 degrees wide across the plane of incidence, a
// cell 2.8: what light from above shows of the facets is in the table of every layer.
TEST(TabulatedTest, GrazingLobesNarrowerThanCells) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.1");
    const Detector detector{DetectorSettings{}};
    const auto with_normal =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 72, 78, 84}, {0}, 128)));
    const auto without =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({72, 78, 84}, {0}, 128)));
    struct Row {
        double theta_deg, most, without;
    };
    for (const Row& row :
         {Row{84, 0.01, 0.1}, {75, 0.01, 0.05}, {81, 0.015, 0.15}, {87, 0.03, 0.05}}) {
        EXPECT_LT(relative_l1(*model, *with_normal, row.theta_deg, 0, 128), row.most)
            << row.theta_deg;
        EXPECT_GT(relative_l1(*model, *without, row.theta_deg, 0, 128), row.without)
            << row.theta_deg;  // or the test shows nothing
        double promised = 0;
        with_normal->albedo(from_spherical(radians(row.theta_deg), 1), {&promised, 1});
        const CellAverages averages =
            average_over_cells(*with_normal, detector, radians(row.theta_deg), 1, false, 2);
        EXPECT_NEAR(averages.albedo[0], promised, 1e-3) << row.theta_deg;
    }
}

// At 89.35 degrees the lobe of alpha 0.1 is 0.13 degrees wide across the plane of incidence, a
// twentieth of a cell, and lies along the edge of two: it comes back, with its layer and between.
TEST(TabulatedTest, RidgesTwentyTimesNarrowerThanCells) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.1");
    const auto table = make_tabulated_brdf(
        test::measurement_of(*model, layers_at({0, 88.9, 89.35, 89.65}, {0}, 128)));
    for (const double theta_deg : {88.9, 89.35, 89.5, 89.65})
        EXPECT_LT(relative_l1(*model, *table, theta_deg, 0, 128), 0.02) << theta_deg;
}

// Broad lobes, too, are followed to the horizon, where they are narrow over directions.
TEST(TabulatedTest, TheIntegralIsTheAlbedoTowardsTheHorizon) {
    const auto model = parse_brdf_spec("ggx:alpha=0.3");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 30, 60, 78, 84}, {0}, 64)));
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 64, 1});
    for (const double theta_deg : {45.0, 81.0, 87.0, 89.0, 89.5}) {
        double promised = 0;
        table->albedo(from_spherical(radians(theta_deg), 1), {&promised, 1});
        const CellAverages averages =
            average_over_cells(*table, detector, radians(theta_deg), 1, false, 2);
        EXPECT_NEAR(averages.albedo[0], promised, 1e-3) << theta_deg;
    }
}

TEST(TabulatedTest, LambertStaysLambert) {
    const auto model = parse_brdf_spec("lambert:albedo=0.6");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 40, 80}, {0}, 64)));
    // At the layers exactly; elsewhere the tilt towards the horizon, balanced in the albedo.
    for (const double theta_o : {0.0, 0.4, 1.0, 1.5, 1.57})
        EXPECT_NEAR(value(*table, from_spherical(radians(40), 2), from_spherical(theta_o, 1)),
                    0.6 / kPi, 2e-3);
}

TEST(TabulatedTest, OneAzimuthStandsForAll) {
    // Measured with light from 30 degrees only: azimuths count from the light.
    const auto model = parse_brdf_spec("ggx:alpha=0.3");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 20, 40, 60}, {30}, 128)));
    EXPECT_TRUE(table->isotropic());
    for (const double turn : {0.0, 1.0, 2.5, 4.0}) {
        const Vec3 wi = from_spherical(0.9, turn), wo = from_spherical(0.6, turn + 2.8);
        EXPECT_NEAR(value(*table, wi, wo), value(*model, wi, wo), 0.02 * value(*model, wi, wo));
    }
}

TEST(TabulatedTest, AnisotropyIsInterpolatedOverAzimuth) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.2,alpha_y=0.5");
    const auto table = make_tabulated_brdf(
        test::measurement_of(*model, layers_at({40}, {0, 45, 90, 135, 180, 225, 270, 315}, 64)));
    EXPECT_FALSE(table->isotropic());
    // At a measured azimuth, and half way between two of them, 22.5 degrees off.
    EXPECT_LT(relative_l1(*model, *table, 40, 90, 64), 0.01);
    EXPECT_LT(relative_l1(*model, *table, 40, 67.5, 64), 0.05);
    EXPECT_LT(relative_l1(*model, *table, 40, 337.5, 64), 0.05);
    // The two axes do differ: taking one for the other would miss by far more.
    EXPECT_GT(relative_l1(*model, *parse_brdf_spec("beckmann:alpha=0.5,alpha_y=0.2"), 40, 90, 64),
              0.5);
}

TEST(TabulatedTest, FacetsMeanTheSameForManyLights) {
    // With a guide and without, azimuths relative and not; facets that some light sees from below
    const auto narrow = parse_brdf_spec("beckmann:alpha=0.1,f0=0.9/0.5/0.1");
    const auto broad = parse_brdf_spec("beckmann:alpha=0.5");
    const std::vector<Vec3> wi = {
        from_spherical(0.2, 1), from_spherical(1.2, 1), from_spherical(0.7, 4), {0, 0, 1}};
    std::vector<Vec3> wm;
    for (const double theta : {0.0, 0.1, 0.4, 1.0})
        for (int k = 0; k < 5; ++k) wm.push_back(from_spherical(theta, 1.3 * k));
    for (const Bsdf* model : {narrow.get(), broad.get()}) {
        for (const std::vector<double>& phis : {std::vector{25.0}, {0.0, 90.0, 180.0, 270.0}}) {
            const auto table =
                make_tabulated_brdf(test::measurement_of(*model, layers_at({5, 40, 70}, phis, 32)));
            const auto channels = static_cast<std::size_t>(table->channels());
            std::vector<double> all(wi.size() * wm.size() * channels), one(channels);
            table->eval_at_facets(wi, wm, all);
            for (std::size_t k = 0; k < all.size(); ++k) {
                const Vec3 light = wi[k / channels / wm.size()];
                table->eval(light, reflect(light, wm[k / channels % wm.size()]), one);
                const double f = one[k % channels];
                ASSERT_NEAR(all[k], f, 1e-9 * f) << k;
            }
        }
    }
}

TEST(TabulatedTest, BeyondTheLastLayerItsLobeMovesOn) {
    const auto model = parse_brdf_spec("beckmann:alpha=0.2");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 30, 60}, {0}, 128)));
    const Vec3 wi = from_spherical(radians(70), 0);
    double peak = 0, at = 0;
    for (double deg = 0; deg < 90; deg += 0.5) {
        const double f_cos =
            value(*table, wi, from_spherical(radians(deg), kPi)) * std::cos(radians(deg));
        if (f_cos > peak) peak = f_cos, at = deg;
    }
    EXPECT_NEAR(at, 70, 4);
    std::vector<double> a(1), last(1);
    table->albedo(wi, a);
    table->albedo(from_spherical(radians(60), 0), last);
    EXPECT_EQ(a, last);
}

TEST(TabulatedTest, SamplesFollowTheirDensity) {
    const auto smooth = parse_brdf_spec("beckmann:alpha=0.4");
    const auto one_azimuth =
        make_tabulated_brdf(test::measurement_of(*smooth, layers_at({0, 30, 60, 84}, {0}, 32)));
    const auto brushed = parse_brdf_spec("ggx:alpha=0.2,alpha_y=0.6");
    const auto many_azimuths = make_tabulated_brdf(
        test::measurement_of(*brushed, layers_at({20, 50}, {0, 90, 180, 270}, 32)));
    // The density has steps where the cells of the tables end: either the test's cells fall in with
    // them (no layer is bent at theta 0), or each is integrated over very many points.
    struct Case {
        const Bsdf* brdf;
        double theta_deg, phi_deg;
        int rows, columns, steps;
    };
    const Case cases[] = {{one_azimuth.get(), 0, 0, 32, 64, 4},
                          {one_azimuth.get(), 45, 77, 23, 30, 24},
                          {one_azimuth.get(), 88, 200, 23, 30, 40},
                          {many_azimuths.get(), 35, 45, 23, 30, 24}};
    const double significance = 1 - std::pow(1 - 0.01, 1.0 / std::size(cases));
    for (const Case& c : cases) {
        test::SamplerTest settings;
        settings.wi = from_spherical(radians(c.theta_deg), radians(c.phi_deg));
        settings.rows = c.rows;
        settings.columns = c.columns;
        settings.steps = c.steps;
        settings.samples = 400000;
        const test::SamplerReport report = test::test_sampler(*c.brdf, settings);
        EXPECT_GT(report.p_value, significance) << c.theta_deg;
        EXPECT_EQ(report.impossible, 0);
        EXPECT_NEAR(report.integral, 1 - report.none_share, 1e-3);
        const Detector detector({DetectorKind::LatLong, 64, 1});
        const double albedo = average_over_cells(*c.brdf, detector, radians(c.theta_deg),
                                                 radians(c.phi_deg), false, 2)
                                  .albedo[0];
        EXPECT_NEAR(report.mean_weight, albedo, 4 * report.mean_weight_error + 3e-4);
    }
}

TEST(TabulatedTest, BlackLayersAreBlack) {
    const auto model = parse_brdf_spec("lambert:albedo=0");
    const auto table =
        make_tabulated_brdf(test::measurement_of(*model, layers_at({0, 45}, {0}, 16)));
    const Vec3 wi = from_spherical(0.4, 0);
    EXPECT_EQ(value(*table, wi, from_spherical(1, 1)), 0);
    const auto s = table->sample(wi, 0.7, 0.3);
    ASSERT_TRUE(s);
    EXPECT_GT(s->pdf, 0);
}

TEST(TabulatedTest, UsesTheThreadsAndTheStopOfItsRun) {
    const Measurement m =
        test::measurement_of(*parse_brdf_spec("ggx:alpha=0.3"), layers_at({0, 40, 80}, {0}, 32));
    const auto one = make_tabulated_brdf(m, asperity::Run(1)),
               three = make_tabulated_brdf(m, asperity::Run(3));
    for (const double theta : {5.0, 33.0, 71.0})
        EXPECT_EQ(value(*one, from_spherical(radians(theta), 1), from_spherical(0.3, 2)),
                  value(*three, from_spherical(radians(theta), 1), from_spherical(0.3, 2)));
    asperity::Run stopped(2);
    stopped.request_stop();
    try {
        make_tabulated_brdf(m, stopped);
        FAIL() << "it went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Stopped);
    }
}

TEST(TabulatedTest, RefusesWhatIsNoGrid) {
    const auto model = parse_brdf_spec("lambert");
    const Measurement good = test::measurement_of(*model, layers_at({0, 45}, {0, 90}, 8));
    const auto message = [](const Measurement& m) {
        try {
            make_tabulated_brdf(m);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::InvalidInput);
            return e.message();
        }
        return std::string("accepted");
    };
    EXPECT_EQ(message(good), "accepted");
    Measurement bad = good;
    bad.layers.clear();
    EXPECT_EQ(message(bad), "has no layers");
    bad = good;
    bad.layers.pop_back();
    EXPECT_EQ(message(bad), "its layers do not form a grid: none at theta 45, phi 90 degrees");
    bad = good;
    bad.layers[1].rays = 0;
    EXPECT_EQ(message(bad), "layer 2 has no rays");
}

}  // namespace
}  // namespace asperity

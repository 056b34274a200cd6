// SPDX-License-Identifier: Apache-2.0
// The numbers of plots, by their tables, beside what is known by hand.
#include <asperity/bsdf/models/cook_torrance.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/analytic_measurement.h>
#include <asperity/plots/plot_curves.h>
#include <asperity/plots/plot_kinds.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace asperity::plots {
namespace {

PlotSubject model(const std::string& spec) {
    return {.name = spec, .model = parse_brdf_spec(spec)};
}

PlotSubject surface(Heightfield heights) {
    return {.name = heights.name,
            .surface = std::make_shared<const Heightfield>(std::move(heights))};
}

/// A measurement without noise, at 0, 30 and 60 degrees.
PlotSubject measured(const std::string& spec, int resolution = 32) {
    Experiment experiment;
    experiment.detector.resolution = resolution;
    experiment.illumination.theta_deg = {0, 30, 60};
    return {.name = "result",
            .measurement = std::make_shared<const Measurement>(
                test::measurement_of(*parse_brdf_spec(spec), experiment))};
}

PlotTable table_of(const std::vector<PlotSubject>& subjects, const PlotSettings& settings) {
    Run run(2);
    return make_plot(subjects, settings, run)->table();
}

const std::vector<double>& column(const PlotTable& table, const std::string& header) {
    for (const PlotTable::Column& column : table.columns)
        if (column.header == header) return column.values;
    ADD_FAILURE() << "no column " << header;
    return table.columns.front().values;
}

Heightfield cosine(double waves, double amplitude, const std::string& unit, double dx) {
    Heightfield h;
    h.nx = 64;
    h.ny = 48;
    h.dx = h.dy = dx;
    h.unit = unit;
    h.name = "cosine";
    for (int j = 0; j < h.ny; ++j)
        for (int i = 0; i < h.nx; ++i)
            h.heights.push_back(
                static_cast<float>(amplitude * std::cos(2 * kPi * waves * i / h.nx)));
    return h;
}

ErrorCode code_of(const std::vector<PlotSubject>& subjects, const PlotSettings& settings) {
    try {
        table_of(subjects, settings);
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode{};
}

TEST(Figures, LambertIsOneOverPiEverywhere) {
    const PlotTable alone = table_of({model("lambert")}, {});
    for (const double f : column(alone, "lambert: f [1/sr]")) EXPECT_DOUBLE_EQ(f, 1 / kPi);
    const PlotTable both = table_of({measured("lambert"), model("lambert")}, {});
    EXPECT_EQ(both.columns.front().values.size(), 32u);  // 16 rows on either side
    for (const double f : column(both, "result: f [1/sr]")) EXPECT_NEAR(f, 1 / kPi, 1e-6);
    for (const double f : column(both, "lambert: f [1/sr]")) EXPECT_NEAR(f, 1 / kPi, 1e-6);
}

TEST(Figures, AnAnisotropicModelIsCutInTheAskedPlane) {
    const std::string spec = "ggx:alpha=0.1,alpha_y=0.4";
    PlotSettings settings;
    settings.theta = {20};
    settings.plane = 90;
    const PlotTable table = table_of({model(spec)}, settings);
    const auto brdf = parse_brdf_spec(spec);
    const std::vector<double>& theta = column(table, "theta_o [deg]");
    const std::vector<double>& f = column(table, spec + ": f [1/sr]");
    ASSERT_EQ(theta.size(), 719u);
    for (const std::size_t k : {std::size_t{100}, std::size_t{359}, std::size_t{500}}) {
        double expected = 0;
        // Light from azimuth 0; the plane's far side lies at 270 degrees, its near side at 90
        const double azimuth = theta[k] < 0 ? kPi / 2 : 1.5 * kPi;
        brdf->eval(from_spherical(radians(20), 0),
                   from_spherical(radians(std::abs(theta[k])), azimuth), {&expected, 1});
        EXPECT_NEAR(f[k], expected, 1e-12 * expected);
    }
    // Normal to the plane of incidence the lobe is the same on both sides
    EXPECT_NEAR(f[100], f[718 - 100], 1e-12 * f[100]);
}

TEST(Figures, LayersAreChosenByAngleAndNumber) {
    const PlotSubject result = measured("ggx:alpha=0.4");
    const auto largest_at = [&](const PlotSettings& settings) {
        const PlotTable table = table_of({result}, settings);
        const std::vector<double>& f = table.columns[1].values;
        const auto most = std::max_element(f.begin() + 1, f.end() - 4) - f.begin();
        return table.columns[0].values[static_cast<std::size_t>(most)];
    };
    PlotSettings settings;
    settings.theta = {0};
    EXPECT_NEAR(largest_at(settings), 0, 4);
    settings.theta.clear();
    settings.layer = {static_cast<double>(result.measurement->layers.front().number)};
    EXPECT_NEAR(largest_at(settings), 0, 4);
    settings.layer.clear();
    settings.theta = {0, 30, 60};
    EXPECT_GE(table_of({result}, settings).columns.size(), 4u);
    settings.theta = {45};
    EXPECT_EQ(code_of({result}, settings), ErrorCode::Usage);
    settings.theta.clear();
    settings.layer = {99};
    EXPECT_EQ(code_of({result}, settings), ErrorCode::Usage);
}

TEST(Figures, WrongSubjectsAndSettingsAreRefused) {
    PlotSettings settings;
    EXPECT_EQ(code_of({}, settings), ErrorCode::Usage);
    EXPECT_EQ(code_of({surface(cosine(4, 1, "cell", 1))}, settings), ErrorCode::Usage);
    settings.channel = "green";
    EXPECT_EQ(code_of({measured("lambert")}, settings), ErrorCode::Usage);
    settings = {};
    settings.kind = "psd";
    EXPECT_EQ(code_of({model("lambert")}, settings), ErrorCode::Usage);
    EXPECT_EQ(
        code_of({surface(cosine(4, 1, "cell", 1)), surface(cosine(4, 1, "m", 1e-6))}, settings),
        ErrorCode::Usage);
    settings.kind = "pie";
    EXPECT_EQ(code_of({model("lambert")}, settings), ErrorCode::Usage);
}

TEST(Figures, AProfileIsTheHeightsInTheirUnits) {
    PlotSettings settings;
    settings.kind = "profile";
    const PlotTable table = table_of({surface(cosine(2, 3e-7, "m", 1e-6))}, settings);
    const std::vector<double>& x = column(table, "x [um]");
    const std::vector<double>& z = column(table, "cosine: z [nm]");
    ASSERT_EQ(x.size(), 64u);
    for (std::size_t k = 0; k < x.size(); ++k) {
        EXPECT_NEAR(x[k], static_cast<double>(k), 1e-9);
        EXPECT_NEAR(z[k], 300 * std::cos(2 * kPi * 2 * static_cast<double>(k) / 64), 1e-4);
    }
    settings.line = ProfileLine::Y;  // constant: the wave runs along x
    const PlotTable across = table_of({surface(cosine(2, 3, "cell", 1))}, settings);
    for (const double height : column(across, "cosine: z [cell]")) EXPECT_NEAR(height, 0, 1e-6);
}

TEST(Figures, TheSpectrumOfAWaveStandsAtItsFrequency) {
    PlotSettings settings;
    settings.kind = "psd";
    const PlotTable table = table_of({surface(cosine(8, 1, "m", 0.5e-6))}, settings);
    const std::vector<double>& frequency = column(table, "frequency [1/um]");
    const std::vector<double>& psd = column(table, "cosine: PSD [um^4]");
    const auto most = std::max_element(psd.begin(), psd.end()) - psd.begin();
    // 8 waves on 64 samples of half a micrometre
    EXPECT_NEAR(frequency[static_cast<std::size_t>(most)], 8 / 32.0, 0.02);
}

TEST(Figures, TheHemisphereKeepsTheAlbedo) {
    PlotSettings settings;
    settings.kind = "hemisphere";
    settings.theta = {30};
    settings.average = 2;
    const PlotSubject result = measured("lambert:albedo=0.6", 64);
    const PlotTable table = table_of({result}, settings);
    const std::vector<double>& f = column(table, "f [1/sr]");
    const Detector& detector = result.measurement->detector;
    double albedo = 0;
    for (int cell = 0; cell < detector.cells(); ++cell)
        albedo += f[static_cast<std::size_t>(cell)] *
                  detector.projected_solid_angle(cell / detector.columns());
    EXPECT_NEAR(albedo, 0.6, 1e-6);
}

TEST(Figures, AlbedoOfAModelIsItsOwn) {
    PlotSettings settings;
    settings.kind = "albedo";
    const PlotTable table = table_of({model("lambert:albedo=0.25")}, settings);
    EXPECT_EQ(table.columns.front().values.size(), 30u);  // every 3 degrees
    for (const double a : column(table, "lambert:albedo=0.25: albedo [1]"))
        EXPECT_NEAR(a, 0.25, 1e-3);
}

TEST(Figures, ASpikeAtTheHorizonDoesNotStretchTheAxis) {
    PlotCurve curve;
    curve.name = "lobe";
    for (int k = 0; k < 20; ++k) {
        curve.x.push_back(k);
        curve.y.push_back(1 + 0.01 * k);
    }
    curve.y.back() = 50;
    CurveSet set;
    set.x_name = "θₒ";
    set.curves = {curve};
    EXPECT_NEAR(set.top(), 1.18, 1e-12);
    EXPECT_EQ(set.cut_off(1.5), "Cut off: lobe reaches 50 at θₒ = 19");
    EXPECT_EQ(set.cut_off(60), "");
    set.curves.front().y.back() = 1.9;  // rises, but does not spike
    EXPECT_NEAR(set.top(), 1.9, 1e-12);
}

TEST(Figures, NoiseWidensTheStripAndThePlotSaysSo) {
    // Every second cell of a row has all the light of two
    PlotSubject result = measured("lambert", 128);
    auto noisy = std::make_shared<Measurement>(*result.measurement);
    const int columns = noisy->detector.columns();
    for (Layer& layer : noisy->layers)
        for (int cell = 0; cell < noisy->detector.cells(); ++cell)
            layer.energy[static_cast<std::size_t>(cell)] *=
                static_cast<std::uint64_t>((cell * 7919 + cell / columns * 104729) % 11 % 3);
    PlotSettings settings;
    settings.kind = "lobe";
    const auto roughness = [&](double average) {
        settings.average = average;
        const std::vector<double> f =
            table_of({{.name = "noisy", .measurement = noisy}}, settings).columns[1].values;
        double sum = 0;
        for (std::size_t k = 1; k < f.size(); ++k) sum += std::abs(f[k] - f[k - 1]);
        return sum;
    };
    EXPECT_LT(roughness(0), 0.8 * roughness(1));
}

}  // namespace
}  // namespace asperity::plots

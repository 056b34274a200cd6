// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/fit/fit.h>
#include <asperity/fit/verdict.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/compare.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/surface_text.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace asperity {
namespace {

constexpr double kRays = 1e5;

Experiment small_experiment() {
    Experiment e;
    e.illumination.theta_deg = {30};
    e.detector.resolution = 32;
    e.run.rays = static_cast<std::uint64_t>(kRays);
    return e;
}

/// Counts `kRays` rays that fall into the cells as `energy` has it, and their errors as batches
/// would show them, known to a sixth.
Measurement counted(const Experiment& e, const std::vector<double>& energy, int channels,
                    unsigned seed) {
    Measurement m;
    m.experiment = e;
    m.experiment.run.bounces = 1;
    m.detector = Detector(e.detector);
    for (int c = 0; c < channels; ++c) m.channel_names.push_back("c" + std::to_string(c));
    Layer layer;
    layer.theta_i = radians(e.illumination.theta_deg[0]);
    layer.rays = e.run.rays;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (const double share : energy) {
        const double rays =
            share > 0 ? double(std::poisson_distribution<int>(share * kRays)(random)) : 0;
        layer.energy.push_back(static_cast<std::uint64_t>(rays * double(kRayEnergy)));
        layer.stderr_energy.push_back(
            static_cast<float>(std::sqrt(rays) / kRays * (1 + normal(random) / 6)));
    }
    m.layers.push_back(layer);
    return m;
}

struct Pulls {
    std::vector<Fit> fits;            ///< a trial
    std::vector<double> pulls, chi2;  ///< (found - true) / error, a parameter and trial
    double share_within_3 = 0, mean = 0, mean_chi2 = 0;
};

/// Tables made of `truth` with noise, each fitted by `model`; `values`: of its free parameters.
Pulls trials(const std::string& truth, const std::string& model, const std::vector<double>& values,
             std::size_t count) {
    const Experiment e = small_experiment();
    const auto bsdf = parse_brdf_spec(truth);
    const CellAverages exact =
        average_over_cells(*bsdf, Detector(e.detector), radians(30), 0, false, 2);
    Pulls result;
    result.fits.resize(count);
    parallel_for(count, 2, [&](std::size_t trial) {
        const Measurement m = counted(e, exact.energy, 1, static_cast<unsigned>(trial + 1));
        const FitData data = fit_data(m, FitLight::All, radians(90));
        result.fits[trial] =
            fit_model(data, free_model(model, data, FitReflectance::Run, {}), FitMetric::Chi2, 1);
    });
    for (const Fit& fit : result.fits) {
        result.chi2.push_back(fit.chi2_per_dof);
        for (std::size_t k = 0; k < values.size(); ++k)
            result.pulls.push_back((fit.params[k].value - values[k]) / fit.params[k].error);
    }
    for (const double pull : result.pulls) {
        result.share_within_3 += (std::abs(pull) <= 3) / double(result.pulls.size());
        result.mean += pull / double(result.pulls.size());
    }
    for (const double chi2 : result.chi2) result.mean_chi2 += chi2 / double(result.chi2.size());
    return result;
}

void expect_truth(const Pulls& pulls) {
    EXPECT_GE(pulls.share_within_3, 0.95);
    EXPECT_GT(pulls.mean_chi2, 0.9);
    EXPECT_LT(pulls.mean_chi2, 1.1);
}

TEST(Fit, NoisyTablesGiveGgxBack) {
    const Pulls pulls = trials("ggx:alpha=0.25", "ggx", {0.25}, 100);
    expect_truth(pulls);
    // Weights by what was counted would draw the fit to the low side of the noise.
    EXPECT_LT(std::abs(pulls.mean), 0.4);
}

TEST(Fit, NoisyTablesGiveBeckmannBack) {
    const Pulls pulls = trials("beckmann:alpha=0.4", "beckmann", {0.4}, 100);
    expect_truth(pulls);
    EXPECT_LT(std::abs(pulls.mean), 0.4);
}

TEST(Fit, NoisyTablesGiveStudentTBack) {
    expect_truth(trials("student-t:alpha=0.3,gamma=3", "student-t", {0.3, 3}, 100));
}

TEST(Fit, NoisyTablesGiveAbgBack) {
    expect_truth(trials("abg:a=0.05,b=0.02,g=1.8", "abg", {0.05, 0.02, 1.8}, 40));
}

/// A model that is wrong has a best value, too, and its error tells how that would fall out with
/// other rays; not more because it fits badly.
TEST(Fit, ErrorsOfAWrongModelAreThoseOfTheRays) {
    const Pulls tables = trials("beckmann:alpha=0.4", "ggx", {}, 200);
    EXPECT_GT(tables.mean_chi2, 4);
    const auto count = static_cast<double>(tables.fits.size());
    double mean = 0, found = 0, quoted = 0;
    for (const Fit& fit : tables.fits) {
        mean += fit.params[0].value / count;
        quoted += fit.params[0].error * fit.params[0].error / count;
    }
    for (const Fit& fit : tables.fits)
        found += (fit.params[0].value - mean) * (fit.params[0].value - mean) / (count - 1);
    EXPECT_NEAR(std::sqrt(quoted / found), 1, 0.15);  // known to a twentieth
}

TEST(Fit, NoisyTablesGiveGgxPlusLambertBack) {
    const Experiment e = small_experiment();
    const auto bsdf = parse_brdf_spec("ggx:alpha=0.25,f0=0.3,lambert=0.2");
    const CellAverages exact =
        average_over_cells(*bsdf, Detector(e.detector), radians(30), 0, false, 2);
    FitSettings with, without;
    with.models = "ggx";
    without.models = "ggx,beckmann";
    with.reflectance = without.reflectance = FitReflectance::F0;
    with.lambert = true;
    int within = 0;
    constexpr unsigned kTrials = 10;
    for (unsigned trial = 1; trial <= kTrials; ++trial) {
        const FitData data =
            fit_data(counted(e, exact.energy, 1, trial), FitLight::All, radians(90));
        const Fit fit = fit_models(data, with, 2).fits.front();
        EXPECT_EQ(fit.text, "ggx plus lambert");
        EXPECT_EQ(grade(fit), FitGrade::WithinErrors);
        ASSERT_EQ(fit.params.size(), 3u);
        const double truth[] = {0.25, 0.3, 0.2};
        for (std::size_t k = 0; k < 3; ++k)
            within += std::abs(fit.params[k].value - truth[k]) <= 3 * fit.params[k].error;
        EXPECT_EQ(fit.params[2].key, "lambert");
        // Some twenty thousand of the rays are diffuse: one percent of it, and little more.
        EXPECT_LT(fit.params[2].error, 0.01);
        EXPECT_EQ(parse_brdf_spec(fit.spec)->name(), fit.spec);
        // Facets alone are not this.
        const FitReport alone = fit_models(data, without, 2);
        EXPECT_EQ(grade(alone.fits.front()), FitGrade::No) << alone.verdict;
    }
    EXPECT_GE(within, 0.95 * 3 * kTrials);
}

TEST(Fit, ADiffusePartNeedsAModelToBeAddedTo) {
    const Experiment e = small_experiment();
    const FitData data = fit_data(*parse_brdf_spec("lambert:albedo=0.5"), e, 1.5, 2);
    FitSettings settings;
    settings.lambert = true;
    const auto where = [&](const char* models) {
        settings.models = models;
        try {
            fit_models(data, settings, 2);
        } catch (const Error& error) {
            return error.where();
        }
        return std::string();
    };
    EXPECT_EQ(where("lambert"), "lambert");
    EXPECT_EQ(where("ggx:alpha=0.3,lambert=0.1"), "free");
}

TEST(Fit, GgxIsNoBeckmann) {
    const Experiment e = small_experiment();
    const CellAverages exact = average_over_cells(*parse_brdf_spec("ggx:alpha=0.3"),
                                                  Detector(e.detector), radians(30), 0, false, 2);
    const FitData data = fit_data(counted(e, exact.energy, 1, 7), FitLight::All, radians(90));
    FitSettings settings;
    settings.models = "beckmann,ggx";
    const FitReport report = fit_models(data, settings, 2);
    EXPECT_EQ(report.fits[0].text, "ggx");
    EXPECT_EQ(grade(report.fits[0]), FitGrade::WithinErrors);
    EXPECT_EQ(grade(report.fits[1]), FitGrade::No);
    EXPECT_EQ(report.verdict.find("as good as the data: ggx"), 0u) << report.verdict;
    EXPECT_NE(report.verdict.find("not beckmann"), std::string::npos) << report.verdict;
    // What it says is what every verb reads.
    EXPECT_EQ(parse_brdf_spec(report.fits[0].spec)->name(), report.fits[0].spec);
}

/// Light of a simulated surface, and the fits of two models.
FitReport fits_to_surface(const std::string& surface, FitLight light) {
    Experiment e;
    e.illumination.theta_deg = {0, 25, 50};
    e.illumination.isotropic = true;
    e.detector.resolution = 48;
    e.run.jitter = 8;
    apply_surface_spec(e.surface, surface);
    Run run(2);
    const Measurement m = measure(make_surface(e.surface, run), e, run);
    FitSettings settings;
    settings.models = "ggx,beckmann";
    return fit_models(fit_data(m, light, radians(85)), settings, 2);
}

Measurement small_gaussian(double alpha, std::uint64_t surfaces) {
    Experiment e;
    e.illumination.theta_deg = {0, 25, 50};
    e.illumination.isotropic = true;
    e.detector.resolution = 32;
    e.run.rays = 400000;
    e.run.surfaces = surfaces;
    apply_surface_spec(e.surface, fmt::format("gaussian:alpha={},size=128", alpha));
    Run run(2);
    return measure(make_surface(e.surface, run), e, run);
}

/// Of one small surface the errors are those of the rays, and its speckle shows in chi^2; those of
/// a class of surfaces hold both.
TEST(Fit, ErrorsOfAClassHoldTheSpeckleOfItsSurfaces) {
    FitSettings settings;
    settings.models = "beckmann";
    const auto fit_to = [&](std::uint64_t surfaces) {
        const Measurement m = small_gaussian(0.3, surfaces);
        return fit_models(fit_data(m, FitLight::Single, radians(85)), settings, 2);
    };
    const FitReport one = fit_to(1), many = fit_to(16);
    EXPECT_GT(one.fits[0].chi2_per_dof, 4);
    EXPECT_LT(many.fits[0].chi2_per_dof, 2.5);
    EXPECT_NEAR(many.fits[0].params[0].value, 0.3, 0.003);
    EXPECT_NE(one.note.find("may be its speckle; simulate --surfaces"), std::string::npos)
        << one.note;
    EXPECT_EQ(many.note, "");
}

/// At normal incidence each batch of a smooth surface meets each facet: the errors of this layer
/// are 0, and those of the others count.
TEST(Fit, ALayerWhoseBatchesAgreeLeavesTheErrorsOfOthers) {
    const Measurement m = small_gaussian(0.1, 1);
    const Layer& normal = m.layers.front();
    ASSERT_EQ(normal.theta_i, 0);
    ASSERT_TRUE(std::all_of(normal.stderr_energy.begin(), normal.stderr_energy.end(),
                            [](float e) { return e == 0; }));
    FitSettings settings;
    settings.models = "beckmann";
    const FitReport report = fit_models(fit_data(m, FitLight::Single, radians(85)), settings, 2);
    EXPECT_EQ(report.metric, FitMetric::Chi2);
    EXPECT_GT(report.fits[0].chi2_per_dof, 1);
    EXPECT_NEAR(report.fits[0].params[0].value, 0.1, 0.003);
}

TEST(Fit, SimulatedSurfacesFitTheirOwnModel) {
    const FitReport gaussian =
        fits_to_surface("gaussian:alpha=0.3,size=512,correlation-length=6", FitLight::Single);
    EXPECT_EQ(gaussian.fits[0].text, "beckmann");
    EXPECT_NEAR(gaussian.fits[0].params[0].value, 0.3, 0.009);
    EXPECT_EQ(gaussian.verdict.find("close to the data"), 0u) << gaussian.verdict;
    EXPECT_NE(gaussian.verdict.find("not ggx"), std::string::npos) << gaussian.verdict;

    const FitReport ggx =
        fits_to_surface("ggx:alpha=0.3,size=512,correlation-length=6", FitLight::Single);
    EXPECT_EQ(ggx.fits[0].text, "ggx");
    EXPECT_NEAR(ggx.fits[0].params[0].value, 0.3, 0.009);
    EXPECT_NE(ggx.verdict.find("not beckmann"), std::string::npos) << ggx.verdict;

    const FitReport noise = fits_to_surface("thesis:roughness=0.2,size=256", FitLight::All);
    EXPECT_EQ(noise.verdict.find("no model of the list describes the data"), 0u) << noise.verdict;
}

TEST(Fit, ChannelsHaveTheirOwnReflectance) {
    Experiment e = small_experiment();
    e.illumination.theta_deg = {20, 60};
    const auto bsdf = parse_brdf_spec("ggx:alpha=0.35,f0=0.2/0.5/0.8");
    const FitData data = fit_data(*bsdf, e, radians(85), 2);
    for (const FitMetric metric : {FitMetric::L2, FitMetric::Log, FitMetric::CubeRoot}) {
        const Fit fit = fit_model(data, free_model("ggx", data, FitReflectance::F0, {}), metric, 2);
        ASSERT_EQ(fit.params.size(), 4u);
        EXPECT_NEAR(fit.params[0].value, 0.35, 2e-3);
        EXPECT_NEAR(fit.params[1].value, 0.2, 5e-3);
        EXPECT_NEAR(fit.params[2].value, 0.5, 5e-3);
        EXPECT_NEAR(fit.params[3].value, 0.8, 5e-3);
        EXPECT_EQ(fit.params[3].entry, 2);
        EXPECT_LT(fit.mean_l1, 0.01);
    }
}

TEST(Fit, ThreadsDoNotMatter) {
    const Experiment e = small_experiment();
    const FitData data = fit_data(*parse_brdf_spec("student-t:alpha=0.4,gamma=4"), e, 1.5, 1);
    const FreeModel model = free_model("ggx", data, FitReflectance::F0, {});
    const Fit one = fit_model(data, model, FitMetric::Log, 1);
    const Fit three = fit_model(data, model, FitMetric::Log, 3);
    EXPECT_EQ(one.spec, three.spec);
    EXPECT_EQ(one.energy, three.energy);
    EXPECT_EQ(one.params[0].error, three.params[0].error);
}

TEST(Fit, AnEndOfARangeIsSaid) {
    Experiment e = small_experiment();
    const FitData data = fit_data(*parse_brdf_spec("lambert:albedo=1"), e, 1.5, 2);
    const Fit fit =
        fit_model(data, free_model("lambert", data, FitReflectance::F0, {}), FitMetric::L2, 2);
    EXPECT_TRUE(fit.params[0].at_end);
    EXPECT_TRUE(std::isnan(fit.params[0].error));
    EXPECT_EQ(fit.params[0].value, 1);
}

TEST(Fit, ALayerWithoutNoiseIsOneOfMany) {
    // At normal incidence each batch of 131072 rays meets each of 131072 facets once: batches agree
    // to a rounding, and the layer would have a million times the weight of the others.
    Experiment e;
    e.illumination.theta_deg = {0, 30, 60};
    e.illumination.isotropic = true;
    e.run.rays = 2'000'000;
    apply_surface_spec(e.surface, "gaussian:alpha=0.3,size=256");
    asperity::Run run(2);
    const Measurement m = measure(make_surface(e.surface, run), e, run);
    FitSettings settings;
    settings.models = "beckmann";
    settings.lambert = true;
    const FitReport report = fit_models(fit_data(m, FitLight::Single, radians(85)), settings, 2);
    const Fit& fit = report.fits.front();
    EXPECT_NEAR(fit.params[0].value, 0.3, 0.003);
    EXPECT_EQ(fit.params[1].value, 0);
    EXPECT_TRUE(fit.params[1].at_end);
    EXPECT_LT(fit.chi2_per_dof, 100);
    EXPECT_LT(fit.mean_l1, 0.03);
}

TEST(Fit, BlocksHoldAllLight) {
    const Experiment e = small_experiment();
    const auto bsdf = parse_brdf_spec("ggx:alpha=0.05");
    const FitData data = fit_data(*bsdf, e, radians(90), 2);
    double energy = 0, solid_angle = 0, lambert = 0;
    for (const double x : data.energy) energy += x;
    for (const FitBlock& block : data.blocks) solid_angle += block.solid_angle;
    for (const double x : predict(data, *parse_brdf_spec("lambert:albedo=1"), 2)) lambert += x;
    const double albedo =
        average_over_cells(*bsdf, data.detector, radians(30), 0, false, 2).albedo[0];
    EXPECT_NEAR(energy, albedo, 1e-12);
    EXPECT_NEAR(solid_angle, 2 * kPi, 1e-9);
    EXPECT_NEAR(lambert, 1, 1e-12);
    // A lobe of three degrees in cells of six: the nodes still find it.
    double predicted = 0;
    for (const double x : predict(data, *bsdf, 2)) predicted += x;
    EXPECT_NEAR(predicted, albedo, 2e-3);
}

TEST(Verdict, SharesAreReadable) {
    Fit fit;
    fit.text = "ggx";
    const auto says = [&](double l1, double chi2) {
        fit.mean_l1 = l1;
        fit.chi2_per_dof = chi2;
        const std::string text = verdict_of({fit});
        return text.substr(text.find("ggx"));
    };
    EXPECT_EQ(says(0.00523, 1.04), "ggx (L1 of f cos 0.52 %, chi2/dof 1.04)");
    EXPECT_EQ(says(0.0994, 80), "ggx (L1 of f cos 9.9 %, chi2/dof 80)");
    EXPECT_EQ(says(0.0996, 999), "ggx (L1 of f cos 10 %, chi2/dof 999)");
    EXPECT_EQ(says(0.998, 123456), "ggx (L1 of f cos 100 %, chi2/dof 123456)");
    EXPECT_EQ(says(1.3, NAN), "ggx (L1 of f cos more than 100 %)");
}

TEST(FreeParams, SplitsModelsAndTheirKeys) {
    const std::vector<std::string> expected = {"ggx", "cook-torrance:metallic=1,k=ibl", "beckmann"};
    EXPECT_EQ(split_models("ggx,cook-torrance:metallic=1,k=ibl,beckmann"), expected);
}

TEST(FreeParams, WhatIsGivenIsFixed) {
    FitData data;
    data.channels = 3;
    const FreeModel model = free_model("cook-torrance:metallic=1", data, FitReflectance::F0, {});
    ASSERT_EQ(model.free.size(), 4u);
    EXPECT_EQ(model.free[0].key, "roughness");
    EXPECT_EQ(model.free[1].key, "albedo");
    EXPECT_EQ(model.free[3].entry, 2);
    EXPECT_EQ(free_model("ggx:material=Au", data, FitReflectance::F0, {}).free.size(), 1u);
    EXPECT_EQ(free_model("ggx", data, FitReflectance::Conductor, {"alpha_y"}).free.size(), 8u);
}

TEST(FreeParams, RefusesWhatCannotBeFree) {
    FitData data;
    const auto refused = [&](const std::string& text, const std::string& where,
                             FitReflectance reflectance, const std::vector<std::string>& also) {
        try {
            free_model(text, data, reflectance, also);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), where) << error.what();
        }
    };
    refused("phong", "model", FitReflectance::F0, {});
    refused("ggx:alpha", "ggx:alpha", FitReflectance::F0, {});
    refused("ggx:alpha=0.1,material=Au", "model", FitReflectance::F0, {});
    refused("ggx", "free", FitReflectance::F0, {"masking"});
    refused("ggx", "reflectance", FitReflectance::Run, {});
}

}  // namespace
}  // namespace asperity

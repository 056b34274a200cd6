// SPDX-License-Identifier: Apache-2.0
// Error bars, lobes of rough surfaces, analytic models, and tables between their layers.
#include "expect.h"
#include "facet_cases.h"
#include "run_check.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/tabulated.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

namespace asperity::checks {

namespace {

/// Independent rays onto grooves take one of two ways, so the variance of a cell and of the albedo
/// is that of N throws of a coin: what 400 layers of few batches quote must be that in the mean,
/// and they must spread like that.
std::string error_bars_failure(Run& run) {
    constexpr int kLayers = 400;
    constexpr double kSlope = 0.3, kTheta = 25, kN = 1.0, kK = 2.0;
    Experiment e;
    e.illumination.theta_deg.assign(kLayers, kTheta);
    e.detector.resolution = 16;
    e.run.rays = 301;  // batches of unlike size
    e.run.batches = 2;
    e.run.launch = LaunchPattern::Random;
    e.optics = metal(kN, kK);
    const Measurement m = measure(four_slopes(kSlope, 0), e, run);
    const std::vector<Beam> beams = beams_of(kSlope, 0, from_spherical(radians(kTheta), 0));
    const double p = beams[0].share + beams[1].share;
    const double a = reflectance(beams[0].cosine, kN, kK), b = reflectance(beams[2].cosine, kN, kK);
    const double per_ray = p * (1 - p) / static_cast<double>(e.run.rays);
    const double of_cell = per_ray * a * a, of_albedo = per_ray * (a - b) * (a - b);

    const auto cell = static_cast<std::size_t>(m.detector.cell_of(beams[0].wo));
    double quoted_cell = 0, quoted_albedo = 0, spread_cell = 0, spread_albedo = 0;
    for (const Layer& layer : m.layers) {
        quoted_cell += std::pow(double{layer.stderr_energy[cell]}, 2) / kLayers;
        quoted_albedo += std::pow(layer.stderr_albedo[0], 2) / kLayers;
        const double energy = m.energy(layer, 0, static_cast<int>(cell));
        spread_cell += std::pow(energy - p * a, 2) / kLayers;
        spread_albedo += std::pow(m.albedo(layer, 0) - (p * a + (1 - p) * b), 2) / kLayers;
    }
    // A variance from two batches has a relative spread of sqrt 2, so the mean of 400 has 0.07; one
    // around a known mean as much
    constexpr double kFiveSigma = 0.36;
    return first_of({expect_near("quoted variance of a cell, of the true one,",
                                 quoted_cell / of_cell, 1, kFiveSigma),
                     expect_near("quoted variance of the albedo, of the true one,",
                                 quoted_albedo / of_albedo, 1, kFiveSigma),
                     expect_near("variance of a cell among 400 layers, of the true one,",
                                 spread_cell / of_cell, 1, kFiveSigma),
                     expect_near("variance of the albedo among 400 layers, of the true one,",
                                 spread_albedo / of_albedo, 1, kFiveSigma)});
}

Measurement gaussian_measurement(double alpha, const std::vector<double>& theta_deg, Run& run) {
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.size = 256;
    settings.alpha_x = settings.alpha_y = alpha;
    Experiment e;
    e.surface = settings;
    e.illumination.theta_deg = theta_deg;
    e.detector.resolution = 64;
    e.run.rays = 200000;
    return measure(make_surface(settings, run), e, run);
}

/// Light down onto gentle slopes leaves at twice the angle of its facet, so what leaves within an
/// angle is the share of facets less than half as steep: 1 - exp(-tan^2 / alpha^2).
std::string gaussian_lobe_failure(Run& run) {
    constexpr double kAlpha = 0.15;
    const Measurement m = gaussian_measurement(kAlpha, {0}, run);
    double within = 0;
    const int columns = m.detector.columns();
    for (int row = 0; row < m.detector.rows(); ++row) {
        for (int column = 0; column < columns; ++column)
            within += m.energy(m.layers.at(0), 0, row * columns + column);
        const double half = std::tan(m.detector.theta_edge(row + 1) / 2);
        const std::string failure = expect_near(
            fmt::format("the share within {:.1f} degrees", degrees(m.detector.theta_edge(row + 1))),
            within, 1 - std::exp(-half * half / (kAlpha * kAlpha)), 0.02);
        if (!failure.empty()) return failure;
    }
    return {};
}

/// The energy of single reflection that another program, which shares no code with this one, finds
/// on Gaussian surfaces of alpha 0.5 (docs/validation.md): 0.952 along the normal, 0.875 at 60.
std::string single_reflection_failure(Run& run) {
    const Measurement m = gaussian_measurement(0.5, {0, 60}, run);
    return first_of(
        {expect_near("one reflection from 0 degrees", m.albedo(m.layers.at(0), 0, 0), 0.952, 0.01),
         expect_near("one reflection from 60 degrees", m.albedo(m.layers.at(1), 0, 0), 0.875,
                     0.01)});
}

Measurement thesis_measurement(const char* engine, Run& run) {
    SurfaceSettings settings;
    settings.kind = "thesis";
    settings.size = 256;
    settings.roughness = 0.2;
    Experiment e;
    e.illumination.theta_deg = {0, 60, 80};
    e.illumination.phi_deg = {0, 45, 135};
    e.detector.resolution = 16;
    e.run.rays = 65536;
    e.run.launch = LaunchPattern::Random;
    e.run.engine = engine;
    return measure(make_surface(settings, run), e, run);
}

/// The thesis' surface of roughness 0.2: what leaves after one and after two reflections, as that
/// other program finds it; the two engines, which share no step of the way, agree much better.
std::string thesis_failure(Run& run) {
    const Measurement wide = thesis_measurement("wide", run),
                      plain = thesis_measurement("plain", run);
    for (std::size_t k = 0; k < wide.layers.size(); ++k)
        for (const int order : {0, 1}) {
            const double share = wide.albedo(wide.layers[k], order, 0);
            const double error =
                std::sqrt(2 * share * (1 - share) / static_cast<double>(wide.layers[k].rays));
            const std::string failure = expect_near(
                fmt::format("light from {:.0f}, {:.0f} degrees after {} reflections, plain engine,",
                            degrees(wide.layers[k].theta_i), degrees(wide.layers[k].phi_i),
                            order + 1),
                plain.albedo(plain.layers.at(k), order, 0), share, 5 * error);
            if (!failure.empty()) return failure;
        }
    const auto one = [&](std::size_t layer) { return wide.albedo(wide.layers.at(layer), 0, 0); };
    constexpr double kTolerance = 0.015;
    return first_of(
        {expect_near("one reflection from 0 degrees", one(0), 0.337, kTolerance),
         expect_near("two reflections from 0 degrees", wide.albedo(wide.layers.at(0), 1, 0), 0.511,
                     kTolerance),
         expect_near("one reflection from 60 degrees along x", one(3), 0.744, kTolerance),
         expect_near("one reflection from 60 degrees across the ridges", one(4), 0.874, kTolerance),
         expect_near("one reflection from 60 degrees along the ridges", one(5), 0.599,
                     kTolerance)});
}

/// Between layers at 42 and 54 degrees, whose albedos differ, a quarter of the way.
std::string interpolated_failure(Run& run) {
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.size = 128;
    settings.alpha_x = settings.alpha_y = 0.3;
    Experiment e;
    e.illumination.theta_deg = {42, 54};
    e.detector.resolution = 32;
    e.run.rays = 400000;
    e.optics.fresnel = FresnelKind::Dielectric;
    e.optics.ior = {1.5};
    const Heightfield surface = make_surface(settings, run);
    const Measurement layers = measure(surface, e, run);
    e.illumination.theta_deg = {45};
    const Measurement between = measure(surface, e, run);
    const std::unique_ptr<Bsdf> table = make_tabulated_brdf(layers);

    const double blend =
        0.75 * layers.albedo(layers.layers.at(0), 0) + 0.25 * layers.albedo(layers.layers.at(1), 0);
    const Comparison c = compare(between, *table, run.threads());
    const double albedo = between.albedo(between.layers.at(0), 0);
    return first_of(
        {expect_near("the albedo at 45 degrees", albedo_at(*table, radians(45), 0), blend, 1e-6),
         expect_near("the integral of the lobe at 45 degrees, of the albedo,",
                     c.layers.at(0).albedo_b / blend, 1, 0.005),
         expect_near("the distance of the lobe at 45 degrees from a measured one",
                     c.layers.at(0).l1 / albedo, 0, 0.1),
         expect_near("the albedo of the layer at 54 degrees", albedo_at(*table, radians(54), 0),
                     layers.albedo(layers.layers.at(1), 0), 1e-6)});
}

/// GGX of alpha 1 sends out 1 - ln 2 of light along the normal; models are reciprocal; what is
/// sampled has the density that is said.
std::string models_failure() {
    const std::unique_ptr<Bsdf> ggx = parse_brdf_spec("ggx:alpha=1"),
                                lambert = parse_brdf_spec("lambert:albedo=0.3");
    double one[1], other[1];
    for (const char* spec : {"ggx:alpha=0.4", "beckmann:alpha=0.4", "lambert:albedo=0.3"}) {
        const std::unique_ptr<Bsdf> model = parse_brdf_spec(spec);
        const Vec3 wi = from_spherical(0.4, 1), wo = from_spherical(1.2, 3);
        model->eval(wi, wo, one);
        model->eval(wo, wi, other);
        if (!(one[0] > 0) || std::abs(one[0] / other[0] - 1) > 1e-12)
            return fmt::format("{} is not reciprocal", spec);
    }
    // Along the normal nothing is hidden: f = D / 4, and D = 1 / (pi alpha_x alpha_y)
    for (const char* spec : {"ggx:alpha=0.3,alpha_y=0.6", "beckmann:alpha=0.3,alpha_y=0.6"}) {
        parse_brdf_spec(spec)->eval({0, 0, 1}, {0, 0, 1}, one);
        const std::string failure = expect_near(fmt::format("f of {} along the normal", spec),
                                                one[0], 1 / (4 * kPi * 0.3 * 0.6), 1e-12);
        if (!failure.empty()) return failure;
    }
    lambert->eval({0, 0, 1}, from_spherical(1, 1), one);
    return first_of(
        {expect_near("the albedo of GGX, alpha 1", albedo_at(*ggx, 0, 0), 1 - std::log(2.0), 1e-3),
         expect_near("pi f of Lambert", kPi * one[0], 0.3, 1e-12),
         expect_near("the albedo of Lambert", albedo_at(*lambert, 1, 0), 0.3, 1e-6)});
}

}  // namespace

void check_statistics(Run& run, const CheckReport& report) {
    run_check(run, report, "Error bars: variance of 400 layers as N throws of a coin",
              [&] { return error_bars_failure(run); });
    run_check(run, report, "Gaussian, alpha 0.15: the lobe along the normal is that of its slopes",
              [&] { return gaussian_lobe_failure(run); });
    run_check(run, report, "Gaussian, alpha 0.5: energy of single reflection",
              [&] { return single_reflection_failure(run); });
    run_check(run, report, "Thesis, roughness 0.2: reflections one by one, two engines alike",
              [&] { return thesis_failure(run); });
    run_check(run, report, "Between layers: albedo and lobe at 45 degrees from 42 and 54",
              [&] { return interpolated_failure(run); });
    run_check(run, report, "Models: 1 - ln 2 of GGX, reciprocity, Lambert",
              [&] { return models_failure(); });
}

}  // namespace asperity::checks

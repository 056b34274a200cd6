// SPDX-License-Identifier: Apache-2.0
//
// Errors of figures that are told from several cells at once: how often 95 % intervals of a fitted
// width, of L1, of its RMS and of a gloss hold the truth, the mean over all seeds: of one surface
// that is the figure of as many rays as all seeds have, of a class that of all its surfaces.
//
//   several_cells [--seeds N] [--large]
//
// Prints the table of docs/validation.md, "Figures of several cells". A test with few seeds: exits
// with 1 where intervals hold too rarely, or errors are far too wide.
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/parallel.h>
#include <asperity/fit/fit.h>
#include <asperity/gonio/measure.h>
#include <asperity/instruments/glossmeter.h>
#include <asperity/measured/compare.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace asperity;

/// 97.5 % of Student's t with 15 degrees of freedom: 16 batches, or groups of them.
constexpr double kInterval = 2.131;

constexpr int kSurfaces = 48;

struct Case {
    const char* name;
    const char* kind;
    double width;
    const char* model;    ///< that is fitted
    const char* distant;  ///< that L1 is told to
    double theta_deg;
    bool isotropic;
};
constexpr Case kCases[] = {
    {"Gaussian 0.3, 45°, isotropic", "gaussian", 0.3, "beckmann", "beckmann:alpha=0.4", 45, true},
    {"Gaussian 0.5, 30°", "gaussian", 0.5, "beckmann", "beckmann:alpha=0.7", 30, false},
    {"GGX 0.3, 45°", "ggx", 0.3, "ggx", "ggx:alpha=0.4", 45, false},
    {"thesis noise 0.2, 45°", "thesis", 0.2, "ggx", "ggx:alpha=0.4", 45, false}};
constexpr int kCasesOfClass = 2;  ///< that a short run fits to many surfaces, too

struct Value {
    double value = 0, error = 0;
};

/// A figure by seed.
struct Figure {
    std::string name;
    std::vector<Value> values;
    bool checked = true;
};

/// Shares of intervals that hold the mean over all seeds, and how large errors are beside the
/// spread of what they belong to.
struct Held {
    double share = 0, quoted_over_found = 0;
};

Held held(const std::vector<Value>& values) {
    const double n = static_cast<double>(values.size());
    double mean = 0, squares = 0, quoted = 0;
    for (const Value& v : values) mean += v.value / n;
    for (const Value& v : values) {
        squares += (v.value - mean) * (v.value - mean) / (n - 1);
        quoted += v.error * v.error / n;
    }
    Held result;
    result.quoted_over_found = std::sqrt(quoted / squares);
    // The mean holds a share of each value: that is what is nearer to it than to the truth
    const double nearer = std::sqrt(n / (n - 1));
    for (const Value& v : values)
        result.share += (nearer * std::abs(v.value - mean) <= kInterval * v.error) / n;
    return result;
}

Experiment experiment_of(const Case& c, int resolution) {
    Experiment e;
    e.surface.kind = c.kind;
    e.surface.size = 64;
    e.surface.alpha_x = e.surface.alpha_y = e.surface.roughness = c.width;
    e.detector.resolution = resolution;
    e.illumination.theta_deg = {c.theta_deg};
    e.illumination.isotropic = c.isotropic;
    return e;
}

Value fitted(const Measurement& m, const Case& c) {
    const FitData data = fit_data(m, FitLight::Single, radians(85));
    const Fit fit =
        fit_model(data, free_model(c.model, data, FitReflectance::Run, {}), FitMetric::Chi2, 1);
    return {fit.params.front().value, fit.params.front().error};
}

/// As results of older versions have it: blocks of cells that know nothing of each other.
Measurement without_groups(Measurement m) {
    m.layers[0].spread.groups = {};
    return m;
}

/// Surface `k` of the class, or `surfaces` from it on, of fewer rays each.
Measurement of_class(Experiment e, std::size_t k, int surfaces) {
    e.surface.seed = 1 + 100 * k;
    e.run.seed = k + 1;
    e.run.surfaces = surfaces;
    e.run.jitter = surfaces > 1 ? 4 * surfaces : 16;
    asperity::Run run(1);
    return measure(make_surface(e.surface, run), e, run);
}

/// Of the class, of one surface after the other or of many at once.
void add_class(std::vector<Figure>& figures, const Case& c, const Experiment& e,
               std::size_t seeds) {
    Figure many{"width, 48 surfaces", std::vector<Value>(seeds)};
    // For comparison: what errors were, and what one surface tells of its class
    Figure blocks{"the same, blocks alone", std::vector<Value>(seeds), false};
    Figure one{"class from one surface", std::vector<Value>(seeds), false};
    parallel_for(seeds, asperity::Run(0).threads(), [&](std::size_t seed) {
        const Measurement several = of_class(e, seed, kSurfaces);
        many.values[seed] = fitted(several, c);
        blocks.values[seed] = fitted(without_groups(several), c);
        one.values[seed] = fitted(of_class(e, seed, 1), c);
    });
    for (Figure* figure : {&many, &blocks, &one}) figures.push_back(std::move(*figure));
}

/// Of one surface, with other rays each time.
void add_surface(std::vector<Figure>& figures, const Case& c, const Experiment& e,
                 std::size_t seeds) {
    asperity::Run run(0);
    const Heightfield surface = make_surface(e.surface, run);
    const auto distant = parse_brdf_spec(c.distant);
    const std::size_t first = figures.size();
    for (const char* name : {"width, this surface", "L1", "RMS", "gloss"})
        figures.push_back({name, std::vector<Value>(seeds)});
    parallel_for(seeds, run.threads(), [&](std::size_t seed) {
        Experiment own = e;
        own.run.seed = seed + 1;
        asperity::Run one(1);
        const Measurement m = measure(surface, own, one);
        const auto value = [&](std::size_t k) -> Value& { return figures[first + k].values[seed]; };
        value(0) = fitted(m, c);
        const LayerComparison apart = compare(m, *distant, 1).layers.front();
        value(1) = {apart.l1, apart.l1_error};
        value(2) = {apart.rms, apart.rms_error};
        GlossSettings settings;
        settings.angles_deg = {60};
        settings.all_azimuths = c.isotropic;
        settings.run = own.run;
        const WithError gloss =
            measure_gloss(surface, own.optics, settings, one).readings.front().gloss.front();
        value(3) = {gloss.value, gloss.error};
    });
}

}  // namespace

int main(int argc, char** argv) {
    std::size_t seeds = 40;
    bool large = false;
    for (int k = 1; k < argc; ++k) {
        const std::string name = argv[k];
        if (name == "--large")
            large = true;
        else if (name == "--seeds" && k + 1 < argc)
            seeds = static_cast<std::size_t>(std::max(2, std::atoi(argv[++k])));
    }
    // Three standard deviations of a share of so many seeds
    const double chance = 3 * std::sqrt(0.95 * 0.05 / static_cast<double>(seeds));
    int missed = 0;
    fmt::print("| surface, light | columns | figure | held | quoted / found |\n");
    fmt::print("|---|---|---|---|---|\n");
    for (const Case& c : kCases)
        for (const int resolution : {32, 128}) {
            if (!large && resolution != 32) continue;
            const Experiment e = experiment_of(c, resolution);
            std::vector<Figure> figures;
            add_surface(figures, c, e, seeds);
            if (large || &c - kCases < kCasesOfClass) add_class(figures, c, e, seeds);
            for (const Figure& figure : figures) {
                const Held h = held(figure.values);
                fmt::print("| {} | {} | {} | {:.3f} | {:.2f} |\n", c.name, resolution, figure.name,
                           h.share, h.quoted_over_found);
                if (!figure.checked) continue;
                missed += h.share < 0.94 - chance || h.quoted_over_found > 1.4;
            }
            std::fflush(stdout);
        }
    return missed > 0 ? 1 : 0;
}

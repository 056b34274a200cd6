// SPDX-License-Identifier: Apache-2.0
//
// What a table says between its layers, held against a measurement at those very angles:
//
//   between_layers table [--layers N|auto] [--jitter J] [--large]
//   between_layers reciprocity [--layers N|auto] [--jitter J] [--large]
//
// Prints the tables of docs/validation.md, "Between the layers", in isotropic light; without
// --large of smaller surfaces and as a test, which exits with 1 where layers set by the lobe miss
// what the page says.
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/tabulated.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace asperity;

struct Case {
    const char* name;
    const char* kind;
    double width;
};
constexpr Case kCases[] = {{"Gaussian 0.1", "gaussian", 0.1},
                           {"Gaussian 0.3", "gaussian", 0.3},
                           {"Gaussian 0.6", "gaussian", 0.6},
                           {"GGX 0.3", "ggx", 0.3},
                           {"thesis 0.2", "thesis", 0.2}};
const std::vector<double> kAngles = {3, 27, 51, 75, 81, 87, 89.5};

struct Options {
    int layers = 0;  ///< 0: set by the lobe
    double jitter = 16;
    bool large = false;
};

struct Measured {
    Measurement m;
    double seconds = 0;
};

Measured measured(const Case& c, const Options& options, const IlluminationSettings& light,
                  double jitter, std::uint64_t seed) {
    Experiment e;
    e.surface.kind = c.kind;
    e.surface.size = options.large ? 512 : 256;
    e.surface.alpha_x = e.surface.alpha_y = e.surface.roughness = c.width;
    e.detector.resolution = options.large ? 256 : 64;
    e.detector.orders = 1;
    e.illumination = light;
    e.illumination.isotropic = true;
    e.run.jitter = jitter;
    e.run.seed = seed;
    asperity::Run run(0);
    const auto begin = std::chrono::steady_clock::now();
    Measurement m = measure(make_surface(e.surface, run), e, run);
    return {std::move(m),
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

Measured table_of(const Case& c, const Options& options) {
    IlluminationSettings light;
    light.layers = options.layers;
    return measured(c, options, light, options.jitter, 1);
}

/// What the errors of the reference and of the two layers around it would make of L1.
double noise(const Measurement& reference, const Layer& at, const Measurement& table) {
    std::vector<const Layer*> layers;
    for (const Layer& layer : table.layers) layers.push_back(&layer);
    std::sort(layers.begin(), layers.end(),
              [](const Layer* a, const Layer* b) { return a->theta_i < b->theta_i; });
    std::size_t above = 0;
    while (above + 1 < layers.size() && layers[above]->theta_i < at.theta_i) ++above;
    const Layer &high = *layers[above], &low = *layers[above == 0 ? 0 : above - 1];
    const double step = high.theta_i - low.theta_i;
    const double t = step > 0 ? std::clamp((at.theta_i - low.theta_i) / step, 0.0, 1.0) : 1.0;
    double sum = 0;
    for (std::size_t k = 0; k < at.stderr_energy.size(); ++k) {
        const double own = double{at.stderr_energy[k]};
        const double other =
            std::hypot((1 - t) * double{low.stderr_energy[k]}, t * double{high.stderr_energy[k]});
        sum += std::sqrt(2 / kPi) * std::hypot(own, other);
    }
    return sum / reference.albedo(at, 0);
}

int table(const Options& options) {
    int missed = 0;
    fmt::print("| surface | layers | seconds |");
    for (const double theta : kAngles) fmt::print(" {}° |", theta);
    fmt::print(" integral |\n|---|---|---|");
    for (std::size_t k = 0; k <= kAngles.size(); ++k) fmt::print("---|");
    fmt::print("\n");
    for (const Case& c : kCases) {
        const Measured made = table_of(c, options);
        IlluminationSettings light;
        light.theta_deg = kAngles;
        const Measurement reference = measured(c, options, light, 8 * options.jitter, 99).m;
        const auto brdf = make_tabulated_brdf(made.m);
        const Comparison comparison = compare(reference, *brdf, 0);
        fmt::print("| {} | {} | {:.1f} |", c.name, made.m.layers.size(), made.seconds);
        double off = 0;
        for (std::size_t k = 0; k < reference.layers.size(); ++k) {
            const LayerComparison& layer = comparison.layers[k];
            const double l1 = layer.l1 / layer.albedo_a;
            const double by_chance = noise(reference, reference.layers[k], made.m);
            double promised = 0;
            brdf->albedo(from_spherical(layer.theta_i, 0), {&promised, 1});
            off = std::max(off, std::abs(layer.albedo_b - promised));
            fmt::print(" {:.3f} ({:.3f}) |", l1, by_chance);
            if (l1 > by_chance + (degrees(layer.theta_i) < 84 ? 0.02 : 0.05)) ++missed;
        }
        fmt::print(" {:.1e} |\n", off);
        if (off > 1e-3) ++missed;
        std::fflush(stdout);
    }
    return missed;
}

/// Mean of |f(i, o) - f(o, i)| over pairs of directions, weighted by both cosines, as a share of
/// the mean of f; and the systematic part of it is what is left with many rays.
double reciprocity_defect(const Bsdf& brdf) {
    constexpr int kPolar = 40, kAzimuths = 48;
    double differences = 0, sum = 0;
    const auto theta_of = [](int k) {  // even in sin^2, to 85 degrees
        const double most = std::sin(radians(85));
        return std::asin(most * std::sqrt((k + 0.5) / kPolar));
    };
    for (int a = 0; a < kPolar; ++a) {
        for (int b = 0; b < a; ++b) {
            for (int j = 0; j < kAzimuths; ++j) {
                const double phi = kPi * (j + 0.5) / kAzimuths;
                const Vec3 wi = from_spherical(theta_of(a), 0),
                           wo = from_spherical(theta_of(b), phi);
                double there = 0, back = 0;
                brdf.eval(wi, wo, {&there, 1});
                brdf.eval(wo, wi, {&back, 1});
                differences += std::abs(there - back);
                sum += 0.5 * (there + back);
            }
        }
    }
    return differences / sum;
}

int reciprocity(const Options& options) {
    fmt::print("| surface | rays a sample | defect |\n|---|---|---|\n");
    for (const Case& c : kCases) {
        const auto brdf = make_tabulated_brdf(table_of(c, options).m);
        fmt::print("| {} | {} | {:.2f} % |\n", c.name, options.jitter,
                   100 * reciprocity_defect(*brdf));
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    Options options;
    for (int k = 2; k < argc; ++k) {
        const std::string name = argv[k];
        if (name == "--large")
            options.large = true;
        else if (name == "--layers" && k + 1 < argc)
            options.layers = std::atoi(argv[++k]);  // 0 for auto
        else if (name == "--jitter" && k + 1 < argc)
            options.jitter = std::atof(argv[++k]);
    }
    if (what == "table") return table(options) > 0 && options.layers == 0 ? 1 : 0;
    if (what == "reciprocity") return reciprocity(options);
    fmt::print(stderr,
               "between_layers table|reciprocity [--layers N|auto] [--jitter J] [--large]\n");
    return 2;
}

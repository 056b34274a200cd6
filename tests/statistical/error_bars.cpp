// SPDX-License-Identifier: Apache-2.0
//
// Do 95 % intervals hold the truth 95 % of the time? Measures it over many seeds, the truth being
// the mean of all of them:
//
//   error_bars coverage [--seeds N] [--large]      cells, by the light they got
//   error_bars until [--seeds N] [--batches K]     albedos of runs that decided when to stop
//
// Prints a table, and exits with 1 where it is not what docs/validation.md says: with a few hundred
// seeds, the default, as a test.
#include <asperity/gonio/measure.h>
#include <asperity/gonio/region.h>
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

/// Half of a 95 % interval, in standard errors, from so many batches: Student's t in inverse powers
/// of the degrees of freedom (Abramowitz & Stegun 26.7.5); 1e-3 from 8 on.
double student(int batches) {
    const double z = 1.959964, z2 = z * z, n = batches - 1;
    return z * (1 + (z2 + 1) / (4 * n) + ((5 * z2 + 16) * z2 + 3) / (96 * n * n) +
                (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * n * n * n));
}

struct Case {
    const char* name;
    SurfaceSettings surface;
    Experiment experiment;
};

SurfaceSettings surface_of(const char* kind, int size, double width) {
    SurfaceSettings s;
    s.kind = kind;
    s.size = size;
    s.alpha_x = s.alpha_y = s.roughness = width;
    return s;
}

Experiment experiment_of(double theta_deg, double phi_deg, int resolution) {
    Experiment e;
    e.illumination.theta_deg = {theta_deg};
    e.illumination.phi_deg = {phi_deg};
    e.detector.resolution = resolution;
    e.detector.orders = 1;
    return e;
}

/// Small ones as a test, large ones as people measure.
std::vector<Case> cases(bool large) {
    const int size = large ? 128 : 32, resolution = large ? 256 : 64;
    std::vector<Case> all = {
        {"gaussian 0.3, 60", surface_of("gaussian", size, 0.3), experiment_of(60, 30, resolution)},
        {"gaussian 0.5, 30", surface_of("gaussian", size, 0.5), experiment_of(30, 0, resolution)},
        {"thesis 0.2, 45", surface_of("thesis", size, 0.2), experiment_of(45, 20, resolution)},
        {"ggx 0.4, 70, metal", surface_of("ggx", size, 0.4), experiment_of(70, 0, resolution)},
        {"gaussian 0.4, 45, isotropic", surface_of("gaussian", size, 0.4),
         experiment_of(45, 0, resolution / 2)},
    };
    all[3].experiment.optics.fresnel = FresnelKind::Conductor;
    all[3].experiment.optics.ior = {0.424};
    all[3].experiment.optics.k = {2.472};
    all[4].experiment.illumination.isotropic = true;
    return all;
}

/// A figure of many runs, and its standard errors.
struct Figure {
    std::vector<float> values, errors;
    double mean() const {
        double sum = 0;
        for (const float x : values) sum += double{x};
        return sum / static_cast<double>(values.size());
    }
};

/// Many runs of a case: cells, regions, and what all of them have in common.
struct Runs {
    std::vector<Figure> cells, regions;
    double rays = 0;
    int batches = 0;
};

Runs runs_of(const Case& c, int seeds) {
    asperity::Run run(0);
    const Heightfield surface = make_surface(c.surface, run);
    Runs runs;
    std::vector<std::vector<int>> regions;
    for (int theta = 5; theta < 80; theta += 15)
        for (int phi = 7; phi < 360; phi += 35)
            regions.push_back(
                cells_in(Detector(c.experiment.detector),
                         {radians(theta), radians(theta + 15), radians(phi), radians(phi + 35)}));
    runs.regions.resize(regions.size());
    for (int k = 0; k < seeds; ++k) {
        Experiment e = c.experiment;
        e.run.seed = static_cast<std::uint64_t>(1000 + k);
        const Measurement m = measure(surface, e, run);
        const Layer& layer = m.layers[0];
        runs.cells.resize(static_cast<std::size_t>(m.detector.cells()));
        for (int cell = 0; cell < m.detector.cells(); ++cell) {
            Figure& figure = runs.cells[static_cast<std::size_t>(cell)];
            figure.values.push_back(static_cast<float>(m.energy(layer, 0, cell)));
            figure.errors.push_back(layer.stderr_energy[static_cast<std::size_t>(cell)]);
        }
        for (std::size_t r = 0; r < regions.size(); ++r) {
            const EnergyOfCells sum = energy_of_cells(m, layer, 0, regions[r]);
            runs.regions[r].values.push_back(static_cast<float>(sum.energy));
            runs.regions[r].errors.push_back(static_cast<float>(sum.error));
        }
        runs.rays = static_cast<double>(layer.rays);
        runs.batches = layer.batches;
    }
    return runs;
}

/// Rays that a cell is worth, which puts it into a class, from one to the next.
constexpr double kClasses[] = {3, 10, 30, 100, 300, 1e300};

struct Class {
    int cells = 0, rarely = 0;  ///< of the latter less than 90 % of the intervals hold the truth
    double held = 0, quoted = 0, spread = 0;
};

/// A cell is worth as many rays of full energy as it got, and no more than would count with the
/// error that it has: clumps are single rays then.
void add_to_class(std::vector<Class>& classes, const Figure& cell, const Runs& runs) {
    const double mean = cell.mean(), t = student(runs.batches);
    const double seeds = static_cast<double>(cell.values.size());
    double held = 0, quoted = 0, spread = 0;
    for (std::size_t k = 0; k < cell.values.size(); ++k) {
        const double off = std::abs(double{cell.values[k]} - mean);
        if (off <= t * double{cell.errors[k]}) held += 1 / seeds;
        spread += off * off / (seeds - 1);
        quoted += double{cell.errors[k]} * double{cell.errors[k]} / seeds;
    }
    const double worth = std::min(mean * runs.rays, mean * mean / spread);
    const auto above = std::upper_bound(std::begin(kClasses), std::end(kClasses), worth);
    if (mean <= 0 || above == std::begin(kClasses) || above == std::end(kClasses)) return;
    Class& all = classes[static_cast<std::size_t>(above - std::begin(kClasses)) - 1];
    ++all.cells;
    all.rarely += held < 0.9;
    all.held += held;
    all.quoted += quoted;
    all.spread += spread;
}

bool intervals_hold(const std::string& name, const std::vector<Figure>& figures, const Runs& runs) {
    std::vector<Class> classes(std::size(kClasses) - 1);
    for (const Figure& figure : figures) add_to_class(classes, figure, runs);
    bool good = true;
    for (std::size_t k = 0; k < classes.size(); ++k) {
        const Class& x = classes[k];
        if (x.cells == 0) continue;
        const double held = x.held / x.cells;
        fmt::print(
            "{:36} {:>4.4g} rays and more: {:5}, {:.4f} held, {:4} below 0.9, "
            "error quoted / found {:.3f}\n",
            name, kClasses[k], x.cells, held, x.rarely, std::sqrt(x.quoted / x.spread));
        // A class of few cells has little to say
        if (kClasses[k] >= 10 && x.cells >= 20) good = good && held > 0.93 && held < 0.97;
    }
    std::fflush(stdout);
    return good;
}

/// Albedos of runs that go on until their error is small, and where they should have come to.
class Refinement {
  public:
    Refinement(int batches, int seeds)
        : run_(0),
          surface_(make_surface(surface_of("gaussian", 32, 0.7), run_)),
          experiment_(experiment_of(50, 20, 4)),
          batches_(batches) {
        experiment_.optics.fresnel = FresnelKind::Dielectric;
        experiment_.optics.ior = {1.5};
        // The cells of this detector are more than half the hemisphere: they have no say
        experiment_.run.until_cells = 0.9;
        // Eight times the rays of all runs that stop early
        truth_ = albedo(1, static_cast<std::uint64_t>(seeds) << 17, 64, 0).value;
    }

    bool is_honest(double until, int seeds) {
        int held = 0;
        double sum = 0, squares = 0, quoted = 0, found = 0, batches = 0;
        for (int k = 0; k < seeds; ++k) {
            const Albedo a = albedo(static_cast<std::uint64_t>(1000 + k),
                                    1024 * static_cast<std::uint64_t>(batches_), batches_, until);
            const double off = a.value - truth_;
            held += std::abs(off) <= student(a.batches) * a.error;
            sum += off;
            squares += off * off;
            // Of one batch, as runs have different numbers of them
            found += off * off * a.batches;
            quoted += a.error * a.error * a.batches;
            batches += a.batches;
        }
        const double z = sum / std::sqrt(squares), share = static_cast<double>(held) / seeds;
        fmt::print(
            "until {:.2f} %, {:2} batches at first: {:5.1f} in the end, {:.4f} held, "
            "mean {:+.2f} of its errors off, error quoted / found {:.3f}\n",
            100 * until, batches_, batches / seeds, share, z, std::sqrt(quoted / found));
        std::fflush(stdout);
        // 94 to 96 %, and what as many runs may be off by chance
        const double chance = 2 * std::sqrt(0.95 * 0.05 / seeds);
        return std::abs(share - 0.95) < std::max(0.01, chance) && std::abs(z) < 2;
    }

  private:
    struct Albedo {
        double value, error;
        int batches;
    };
    Albedo albedo(std::uint64_t seed, std::uint64_t rays, int batches, double until) {
        experiment_.run.seed = seed;
        experiment_.run.rays = rays;
        experiment_.run.batches = batches;
        experiment_.run.until = until;
        const Measurement m = measure(surface_, experiment_, run_);
        return {m.albedo(m.layers[0], 0), m.layers[0].stderr_albedo[0], m.layers[0].batches};
    }

    asperity::Run run_;
    const Heightfield surface_;
    Experiment experiment_;
    const int batches_;
    double truth_ = 0;
};

struct Options {
    std::string what;
    int seeds = 400, batches = 16;
    bool large = false;
};

Options options_of(int argc, char** argv) {
    Options options;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        if (word == "--large")
            options.large = true;
        else if (word == "--seeds" && k + 1 < argc)
            options.seeds = std::max(2, std::atoi(argv[++k]));
        else if (word == "--batches" && k + 1 < argc)
            options.batches = std::max(2, std::atoi(argv[++k]));
        else
            options.what += word;
    }
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    const Options options = options_of(argc, argv);
    bool good = true;
    if (options.what == "coverage") {
        for (const Case& c : cases(options.large)) {
            const Runs runs = runs_of(c, options.seeds);
            good = intervals_hold(c.name, runs.cells, runs) && good;
            good = intervals_hold(std::string(c.name) + ", regions", runs.regions, runs) && good;
        }
    } else if (options.what == "until") {
        Refinement refinement(options.batches, options.seeds);
        for (const double until : {0.01, 0.005, 0.002})
            good = refinement.is_honest(until, options.seeds) && good;
    } else {
        fmt::print(stderr,
                   "error_bars coverage [--seeds N] [--large] | until [--seeds N] "
                   "[--batches K]\n");
        return 2;
    }
    return good ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
//
// Engines have nothing in common but their seams, and must give the same means: for every kind of
// surface and every law of its facets, cell by cell, in units of both standard errors.
#include <asperity/gonio/measure.h>
#include <asperity/optics/scattering_law.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/surface_kinds.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace asperity {
namespace {

OpticsSettings optics_of(FresnelKind law) {
    OpticsSettings optics;
    optics.fresnel = law;
    if (law == FresnelKind::Schlick) optics.f0 = {0.04, 0.5, 0.9};
    if (law == FresnelKind::Dielectric) optics.ior = {1.5};
    if (law == FresnelKind::Conductor) optics.material = "Cu";
    return optics;
}

Experiment experiment_of(const std::string& kind, FresnelKind law) {
    Experiment e;
    e.surface.kind = kind;
    e.surface.size = 48;
    e.surface.roughness = 0.3;
    e.surface.alpha_x = e.surface.alpha_y = 0.5;
    e.surface.tilt_deg = 30;
    e.optics = optics_of(law);
    // No reflection of a flat facet along an edge of a cell, where rounding decides
    e.illumination.theta_deg = {23.7, 71.3};
    e.illumination.phi_deg = {17.1};
    e.detector.resolution = 16;
    e.run.rays = 64000;
    e.run.batches = 64;
    return e;
}

/// Differences in units of their standard errors, and how many are looked at.
struct Distance {
    double sum_of_squares = 0, largest = 0;
    int count = 0;

    void add(double a, double b, double error_a, double error_b) {
        const double error = std::hypot(error_a, error_b);
        // What both know exactly differs by rounding alone
        if (error < 1e-6) {
            EXPECT_NEAR(a, b, 1e-5);
            return;
        }
        const double z = (a - b) / error;
        sum_of_squares += z * z;
        largest = std::max(largest, std::abs(z));
        ++count;
    }
};

Distance distance(const Measurement& a, const Measurement& b) {
    Distance d;
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
        const Layer &x = a.layers[k], &y = b.layers[k];
        for (int c = 0; c < a.channels(); ++c) {
            const auto channel = static_cast<std::size_t>(c);
            d.add(a.albedo(x, c), b.albedo(y, c), x.stderr_albedo[channel],
                  y.stderr_albedo[channel]);
            for (int cell = 0; cell < a.detector.cells(); ++cell) {
                const std::size_t place = channel * static_cast<std::size_t>(a.detector.cells()) +
                                          static_cast<std::size_t>(cell);
                // Some hundred rays: fewer are not normally distributed
                if (b.energy(y, c, cell) < 0.004) continue;
                d.add(a.energy(x, c, cell), b.energy(y, c, cell), double{x.stderr_energy[place]},
                      double{y.stderr_energy[place]});
            }
        }
    }
    return d;
}

class EnginesAgree : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, EnginesAgree, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const SurfaceKind& kind : surface_kinds())
                                 names.push_back(kind.name);
                             return names;
                         }()),
                         [](const auto& tested) { return tested.param; });

TEST_P(EnginesAgree, OnEveryLaw) {
    asperity::Run run(2);
    Distance all;
    std::uint64_t seed = 0;
    for (const ScatteringLaw& law : scattering_laws())
        for (int repeat = 0; repeat < 2; ++repeat) {
            Experiment e = experiment_of(GetParam(), law.kind);
            const Heightfield surface = make_surface(e.surface, run);
            e.run.seed = ++seed;
            const Measurement wide = measure(surface, e, run);
            e.run.engine = "plain";
            e.run.seed = ++seed;
            const Distance d = distance(wide, measure(surface, e, run));
            EXPECT_LT(d.largest, 5.5) << law.name;
            all.sum_of_squares += d.sum_of_squares;
            all.count += d.count;
        }
    RecordProperty("cells", all.count);
    // About 1 for independent rays; colours of a cell have their rays in common, and so count once
    const double independent = all.count / 3.0;
    if (independent > 10) {
        EXPECT_LT(all.sum_of_squares / all.count, 1.05 + 4 * std::sqrt(2 / independent));
    }
}

/// Light from all around: sweeps of the wide engine, each from one azimuth, or rays that have one
/// each where facets look into few; straight down, where all azimuths are one.
TEST_P(EnginesAgree, OnIsotropicLight) {
    asperity::Run run(2);
    Distance all;
    std::uint64_t seed = 100;
    for (const FresnelKind law : {FresnelKind::None, FresnelKind::Conductor}) {
        Experiment e = experiment_of(GetParam(), law);
        e.illumination.theta_deg = {0, 23.7, 71.3};
        // Along the normal there is no azimuth to tell from
        if (e.surface.kind == "flat")
            e.illumination.theta_deg.erase(e.illumination.theta_deg.begin());
        e.illumination.isotropic = true;
        e.illumination.phi_deg = {0};
        // Odd, or the mirror direction of a flat surface would be the edge of a cell
        e.detector.resolution = 17;
        const Heightfield surface = make_surface(e.surface, run);
        e.run.rays = 128000;
        e.run.seed = ++seed;
        const Measurement wide = measure(surface, e, run);
        e.run.engine = "plain";
        e.run.seed = ++seed;
        const Distance d = distance(wide, measure(surface, e, run));
        EXPECT_LT(d.largest, 5.5);
        all.sum_of_squares += d.sum_of_squares;
        all.count += d.count;
    }
    RecordProperty("cells", all.count);
    const double independent = all.count / 3.0;
    if (independent > 10) {
        EXPECT_LT(all.sum_of_squares / all.count, 1.05 + 4 * std::sqrt(2 / independent));
    }
}

/// Rays that start at the same random points take the same ways, but for those that pass an edge
/// within rounding.
TEST_P(EnginesAgree, RayByRay) {
    asperity::Run run(2);
    Experiment e = experiment_of(GetParam(), FresnelKind::Conductor);
    e.run.launch = LaunchPattern::Random;
    const Heightfield surface = make_surface(e.surface, run);
    const Measurement wide = measure(surface, e, run);
    e.run.engine = "plain";
    const Measurement plain = measure(surface, e, run);
    for (std::size_t k = 0; k < wide.layers.size(); ++k)
        for (int c = 0; c < wide.channels(); ++c)
            for (int cell = 0; cell < wide.detector.cells(); ++cell)
                ASSERT_NEAR(wide.energy(wide.layers[k], c, cell),
                            plain.energy(plain.layers[k], c, cell), 5e-4)
                    << k << ' ' << c << ' ' << cell;
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// Light on shapes whose reflection is known by hand: directions, shares, metals, grazing light.
#include "expect.h"
#include "facet_cases.h"
#include "run_check.h"

#include <asperity/core/energy.h>
#include <asperity/gonio/measure.h>
#include <asperity/optics/fresnel.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::checks {

namespace {

constexpr double kGoldN = 0.424, kGoldK = 2.472;  // at 550 nm, Johnson & Christy 1972

/// A way to launch and follow rays.
struct Way {
    const char* name;
    const char* engine;
    LaunchPattern launch;
    std::uint64_t rays;
    double tolerance;  ///< of shares of the light
};
// Five standard errors at most; where the light of facets is solved, rounding alone
constexpr Way kWays[] = {
    {"solved facets", "wide", LaunchPattern::LowDiscrepancy, 4 * kSide* kSide, 2e-6},
    {"in strata", "wide", LaunchPattern::Stratified, 16384, 0.005},
    {"at random", "wide", LaunchPattern::Random, 16384, 0.017},
    {"plain engine", "plain", LaunchPattern::Random, 16384, 0.017},
};

Experiment experiment_of(const Way& way, double theta_deg, double phi_deg) {
    Experiment e;
    e.illumination.theta_deg = {theta_deg};
    e.illumination.phi_deg = {phi_deg};
    e.detector.resolution = 64;
    e.run.rays = way.rays;
    e.run.engine = way.engine;
    e.run.launch = way.launch;
    return e;
}

/// Four facets of slopes unlike in x and y: what each sends where, and what a metal keeps of it.
std::string four_slopes_failure(const Way& way, bool of_metal, Run& run) {
    constexpr double kA = 0.13, kB = 0.21;
    Experiment e = experiment_of(way, 20, 25);
    if (of_metal) e.optics = metal(kGoldN, kGoldK);
    const Measurement m = measure(four_slopes(kA, kB), e, run);
    const Layer& layer = m.layers.at(0);
    double albedo = 0;
    for (const Beam& beam : beams_of(kA, kB, from_spherical(layer.theta_i, layer.phi_i))) {
        const double wanted =
            beam.share * (of_metal ? reflectance(beam.cosine, kGoldN, kGoldK) : 1);
        albedo += wanted;
        const std::string failure =
            expect_near(fmt::format("the share towards {:.1f}, {:.1f} degrees",
                                    degrees(polar_angle(beam.wo)), degrees(azimuth(beam.wo))),
                        energy_towards(m, layer, 0, beam.wo), wanted, way.tolerance);
        if (!failure.empty()) return failure;
    }
    // The four reflect nearly alike, so the albedo is known ten times better than the shares
    return first_of(
        {expect_near("the albedo", m.albedo(layer, 0), albedo, way.tolerance / 10 + 1e-7),
         expect_near("what one reflection sends out", m.albedo(layer, 0, 0), albedo,
                     way.tolerance / 10 + 1e-7)});
}

/// All of the light of a level mirror is in one cell; its BRDF is 1 / (integral of the cosine).
std::string lobe_cell_failure(Run& run) {
    for (const DetectorKind kind : {DetectorKind::LatLong, DetectorKind::EqualArea}) {
        Experiment e = experiment_of(kWays[0], 40, 13);
        e.detector.kind = kind;
        const Measurement m = measure(four_slopes(0, 0), e, run);
        const int cell = m.detector.cell_of(from_spherical(radians(40), radians(193)));
        // Rows are equal in theta or in sin^2 theta; a cell is 1/64 of a turn wide
        const int row = cell / 64;
        const auto sine2 = [&](int edge) {
            return kind == DetectorKind::EqualArea ? edge / 32.0
                                                   : std::pow(std::sin(kPi / 2 * edge / 32), 2);
        };
        const double projected = (sine2(row + 1) - sine2(row)) / 2 * (2 * kPi / 64);
        const std::string failure =
            expect_near("the BRDF of the mirror's cell times its cosine",
                        m.brdf(m.layers.at(0), 0, cell) * projected, 1, 1e-9);
        if (!failure.empty()) return failure;
    }
    return {};
}

/// Down into grooves of 45 degrees, along y or along x: off one wall, off the other, back out.
std::string two_walls_failure(const Way& way, Run& run) {
    Experiment e = experiment_of(way, 0, 0);
    e.optics = metal(kGoldN, kGoldK);
    const double wall = reflectance(std::sqrt(0.5), kGoldN, kGoldK);
    e.run.bounces = 2;
    for (const double along_y : {1.0, 0.0}) {
        const Measurement m = measure(four_slopes(along_y, 1 - along_y), e, run);
        const std::string failure =
            first_of({expect_near("the albedo", m.albedo(m.layers.at(0), 0), wall * wall, 1e-6),
                      expect_near("what two reflections send out", m.albedo(m.layers.at(0), 1, 0),
                                  wall * wall, 1e-6)});
        if (!failure.empty()) return failure;
    }
    // One reflection is not enough to get out
    e.run.bounces = 1;
    const Measurement m = measure(four_slopes(1, 0), e, run);
    return expect_near("what one reflection sends out", m.albedo(m.layers.at(0), 0), 0, 0);
}

/// Grooves of 45 degrees send tan 30 of light from 30 degrees back at 60, and all of light from 60
/// degrees back at 30: times the cosine of where it came from, that is the same both ways.
std::string reciprocity_failure(const Way& way, Run& run) {
    const auto back = [&](double from, double to) {
        const Measurement m = measure(four_slopes(1, 0), experiment_of(way, from, 0), run);
        return energy_of_row(m, m.layers.at(0), 0, radians(to), 0);
    };
    const double there = back(30, 60), again = back(60, 30);
    return first_of(
        {expect_near("from 30 to 60 degrees", there, std::tan(radians(30)), 0.02),
         expect_near("from 60 to 30 degrees", again, 1, 1e-6),
         expect_near("there and back, times cosines, the ratio",
                     there * std::cos(radians(30)) / (again * std::cos(radians(60))), 1, 0.03)});
}

/// 0.06 % of grazing light is absorbed where it meets the level; a trench takes 3 of 64 cells.
std::string trench_failure(const Way& way, Run& run) {
    constexpr double kDepth = 100, kN = 0.156, kK = 3.602;
    Experiment e = experiment_of(way, 89.9, 90);
    e.optics = metal(kN, kK);
    e.run.rays = 8192;
    const Measurement m = measure(trench(kDepth), e, run);
    const double cosine = std::cos(radians(89.9));
    const double level = reflectance(cosine, kN, kK),
                 wall = reflectance(cosine / std::hypot(1.0, kDepth), kN, kK);
    const double in_walls = 2.0 / kSide;
    const double absorbed = 1 - level * (1 - in_walls + in_walls * wall * wall);
    return expect_near("what is absorbed, of what should be,",
                       (1 - m.albedo(m.layers.at(0), 0)) / absorbed, 1, 0.003);
}

/// A slope that rises towards +x, in light from all azimuths: as much leaves to the left of the
/// mirror direction as to the right.
std::string isotropic_failure(const Way& way, Run& run) {
    constexpr double kSlope = 0.05, kTheta = 30;
    Heightfield surface = four_slopes(0, 0);
    for (int k = 0; k < kSide * kSide; ++k)
        surface.heights[static_cast<std::size_t>(k)] = static_cast<float>(kSlope * (k % kSide));
    surface.boundary = Boundary::Finite;
    Experiment e = experiment_of(way, kTheta, 0);
    e.illumination.isotropic = true;
    const Measurement m = measure(surface, e, run);
    double left = 0, right = 0, forward = 0;
    const int columns = m.detector.columns();
    for (int cell = 0; cell < m.detector.cells(); ++cell) {
        const double energy = m.energy(m.layers.at(0), 0, cell);
        (cell % columns < columns / 2 ? left : right) += energy;
        const double aside = std::abs(m.detector.phi_centre(cell % columns) - kPi);
        if (aside < radians(20)) forward += energy;
    }
    const double out = left + right;
    return first_of({expect_near("the share to one side", left / out, 0.5, 0.02),
                     expect_near("the share within 20 degrees of the mirror direction",
                                 forward / out, 1, 1e-9)});
}

/// Reflectances along the normal, from refractiveindex.info's Rakic 1995 (Al) and Johnson & Christy
/// 1972 (Ag, Au, Cu) and 1974 (Cr), at 650, 550 and 450 nm.
std::string metal_table_failure() {
    struct Row {
        const char* name;
        double r[3];
    };
    constexpr Row kRows[] = {{"Al", {.906, .915, .922}},
                             {"Ag", {.990, .983, .980}},
                             {"Au", {.957, .792, .408}},
                             {"Cu", {.935, .624, .538}},
                             {"Cr", {.556, .555, .555}}};
    for (const Row& row : kRows) {
        OpticsSettings optics;
        optics.fresnel = FresnelKind::Conductor;
        optics.material = row.name;
        double r[3];
        Fresnel(optics).eval(1, r);
        for (int c = 0; c < 3; ++c) {
            const std::string failure =
                expect_near(fmt::format("{} in channel {}", row.name, c), r[c], row.r[c], 0.003);
            if (!failure.empty()) return failure;
        }
    }
    return {};
}

/// Glass reflects 4 % along the normal; at Brewster's angle half of ((n^2 - 1) / (n^2 + 1))^2.
std::string glass_failure(Run& run) {
    Experiment e = experiment_of(kWays[0], 0, 0);
    e.illumination.theta_deg = {0, degrees(std::atan(1.5)), 75};
    e.optics.fresnel = FresnelKind::Dielectric;
    e.optics.ior = {1.5};
    const Measurement m = measure(four_slopes(0, 0), e, run);
    return first_of({expect_near("along the normal", m.albedo(m.layers.at(0), 0), 0.04, 1e-6),
                     expect_near("at Brewster's angle", m.albedo(m.layers.at(1), 0),
                                 std::pow(1.25 / 3.25, 2) / 2, 1e-6),
                     expect_near("at 75 degrees", m.albedo(m.layers.at(2), 0),
                                 reflectance(std::cos(radians(75)), 1.5, 0), 1e-6)});
}

}  // namespace

void check_reflection(Run& run, const CheckReport& report) {
    run_check(run, report, "Level mirror: the BRDF of its cell, on both detectors",
              [&] { return lobe_cell_failure(run); });
    run_check(run, report, "Metals: reflectances along the normal are the published ones",
              [&] { return metal_table_failure(); });
    run_check(run, report, "Glass: 4 % along the normal, Brewster's angle, 75 degrees",
              [&] { return glass_failure(run); });
    for (const Way& way : kWays) {
        const auto named = [&](const char* what) { return fmt::format("{}, {}", what, way.name); };
        run_check(run, report, named("Four slopes, mirrors: each share in its direction"),
                  [&] { return four_slopes_failure(way, false, run); });
        run_check(run, report, named("Four slopes, metal: each share, and the albedo"),
                  [&] { return four_slopes_failure(way, true, run); });
        run_check(run, report, named("Grooves of 45 degrees, metal: R(45)^2 comes back"),
                  [&] { return two_walls_failure(way, run); });
        run_check(run, report, named("Grooves of 45 degrees: reciprocal from 30 to 60 degrees"),
                  [&] { return reciprocity_failure(way, run); });
        run_check(run, report, named("Trench, metal, light at 89.9 degrees: 0.06 % are absorbed"),
                  [&] { return trench_failure(way, run); });
    }
    for (const Way& way : {kWays[2], kWays[3]})
        run_check(run, report, fmt::format("Light from all azimuths: left as right, {}", way.name),
                  [&] { return isotropic_failure(way, run); });
}

}  // namespace asperity::checks

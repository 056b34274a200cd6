// SPDX-License-Identifier: Apache-2.0
// The glossmeter against exact cases, and against a direct integral of Smith's model.
#include <asperity/instruments/glossmeter.h>

#include <asperity/bsdf/smith.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>
#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

double angle_of(std::size_t k) {
    return GlossSettings().angles_deg[k];
}

Heightfield flat() {
    Heightfield s;
    s.nx = s.ny = 4;
    s.heights.assign(16, 2.0F);
    return s;
}

/// Grooves along y of facets tilted along x.
Heightfield grooves(double tilt_deg) {
    SurfaceSettings settings;
    settings.kind = "vgroove";
    settings.size = 64;
    settings.tilt_deg = tilt_deg;
    asperity::Run run(1);
    return make_surface(settings, run);
}

GlossReport read(const Heightfield& surface, const OpticsSettings& optics = {},
                 std::uint64_t rays = 4000, int threads = 1) {
    GlossSettings settings;
    settings.run.rays = rays;
    asperity::Run run(threads);
    return measure_gloss(surface, optics, settings, run);
}

// ISO 2813: 100 over the reflectance of glass of index 1.567 at the angle.
TEST(Glossmeter, APerfectMirror) {
    const GlossReport report = read(flat());
    ASSERT_EQ(report.readings.size(), 3u);
    const double expected[] = {2037.6, 999.4, 161.5};
    for (std::size_t k = 0; k < 3; ++k) {
        const GlossReading& r = report.readings[k];
        EXPECT_NEAR(r.gloss[0].value, expected[k], 2.5e-3 * expected[k]);
        EXPECT_EQ(r.gloss[0].error, 0);
        EXPECT_NEAR(r.reflectance[0].value, 1, 1e-12);
        EXPECT_EQ(r.rays, 4000u);
    }
    EXPECT_EQ(report.readings[0].haze[0].value, 0);
    EXPECT_TRUE(report.readings[1].haze.empty());
    // To the digits given the aperture must shrink: half a degree changes the glass' reflectance
    for (std::size_t k = 0; k < 3; ++k) {
        GlossGeometry narrow = standard_gloss_geometry(angle_of(k));
        narrow.source = {1e-4, 1e-4};
        EXPECT_NEAR(100 / GlossOptics(narrow).glass(kGlossIndex), expected[k], 0.05);
    }
}

TEST(Glossmeter, FlatGlass) {
    OpticsSettings glass;
    glass.fresnel = FresnelKind::Dielectric;
    glass.ior = {1.567, 1.5};
    const double expected[] = {82.05, 89.14, 98.97};
    const GlossReport report = read(flat(), glass);
    for (std::size_t k = 0; k < 3; ++k) {
        // The directions are drawn, the reference is their mean
        EXPECT_NEAR(report.readings[k].gloss[0].value, 100, 0.3);
        EXPECT_NEAR(report.readings[k].gloss[1].value / report.readings[k].gloss[0].value,
                    expected[k] / 100, 1e-4);
    }
}

// ASTM D4039: of glass of 100 gloss units everywhere 0, of index 1.5 the 89.14 - 82.05 above.
TEST(Glossmeter, TheHazeIndexIsTheGlossAtSixtyLessThatAtTwenty) {
    OpticsSettings glass;
    glass.fresnel = FresnelKind::Dielectric;
    glass.ior = {1.567, 1.5};
    const GlossReport report = read(flat(), glass);
    ASSERT_EQ(report.haze_index.size(), 2u);
    EXPECT_NEAR(report.haze_index[0].value, 0, 0.4);
    EXPECT_NEAR(report.haze_index[1].value, 89.14 - 82.05, 0.4);
    EXPECT_EQ(report.haze_index[1].error,
              std::hypot(report.readings[0].gloss[1].error, report.readings[1].gloss[1].error));
    EXPECT_TRUE(read(flat()).haze_index.empty());  // a mirror is no coating
}

// Facets tilted by t send light to 20 + 2 t degrees, the source blurs it by 0.375 to either side:
// from 1.275 to 2.525 off the mirror direction the receptors at 1.9, of 0.9 to either side, see all
// of it. Of 0.225 to 0.975 off, nine tenths lie within the 0.9 of the receptor for the gloss.
TEST(Glossmeter, HazeIsWhatTwoReceptorsSeeTogether) {
    GlossSettings gloss;
    gloss.angles_deg = {20};
    gloss.run.rays = 20000;
    asperity::Run run(1);
    for (const double tilt : {0.3, 0.95, 2.0}) {
        const GlossReading r = measure_gloss(grooves(tilt), {}, gloss, run).readings[0];
        const double glass = GlossOptics(standard_gloss_geometry(20)).glass(kGlossIndex);
        EXPECT_NEAR(r.haze[0].value, tilt == 0.95 ? 100 / glass : 0, 0.02 * 100 / glass) << tilt;
        EXPECT_NEAR(r.gloss[0].value, tilt == 0.3 ? 90 / glass : 0, 0.01 * 100 / glass) << tilt;
    }
}

GlossReport read_doi(const Heightfield& surface, const DoiSettings& doi, std::uint64_t rays) {
    GlossSettings settings;
    settings.angles_deg = {20};
    settings.run.rays = rays;
    settings.doi = doi;
    asperity::Run run(2);
    return measure_gloss(surface, {}, settings, run);
}

// Facets tilted by 0.08 degrees send light 0.16 aside, the source of 0.2 spreads it over 0.06 to
// 0.26: a fifth of it meets the mirror's receptor (to 0.1), three tenths that on its own side (from
// 0.2) and none the other. 1 - 0.5 * 0.3 / 0.2 = 0.25.
TEST(Glossmeter, DistinctnessOfImageOfGrooves) {
    EXPECT_EQ(read_doi(flat(), {0.14, 0.14}, 4000).doi->doi[0].value, 100);
    const DoiReading r = *read_doi(grooves(0.08), {0.2, 0.2}, 400000).doi;
    EXPECT_GT(r.doi[0].error, 0);
    EXPECT_LT(r.doi[0].error, 1);
    EXPECT_NEAR(r.doi[0].value, 25, 4 * r.doi[0].error);
    // Tilted by 0.15 all light goes to the receptors aside
    const GlossReport aside = read_doi(grooves(0.15), {0.14, 0.14}, 4000);
    EXPECT_TRUE(aside.doi->doi.empty());
    EXPECT_NE(aside.notes.back().find("no DOI"), std::string::npos);
    EXPECT_FALSE(read(flat()).doi);
}

TEST(Glossmeter, RefusesAnInstrumentWhoseMirrorHasNoHundred) {
    for (const DoiSettings& wrong :
         {DoiSettings{0.3, 0.3}, {0.1, 0}, {-0.1, 0.2}, {0.1, 0.1, 2}, {0.1, 0.1, 85}})
        EXPECT_THROW(read_doi(flat(), wrong, 4000), Error) << wrong.source_deg;
}

// A white that scatters alike in all directions: f = 1 / pi.
TEST(GlossOptics, ALambertianWhite) {
    const double expected[] = {1.203, 2.485, 0.0327};
    for (std::size_t k = 0; k < 3; ++k) {
        const GlossOptics optics(standard_gloss_geometry(angle_of(k)));
        const double share = optics.share([](Vec3, Vec3) { return 1 / kPi; });
        EXPECT_NEAR(100 * share / optics.glass(kGlossIndex), expected[k], 3e-3 * expected[k]);
    }
}

Heightfield gaussian(double alpha, int size) {
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.size = size;
    settings.alpha_x = settings.alpha_y = alpha;
    settings.correlation_x = settings.correlation_y = 4;
    asperity::Run run(2);
    return make_surface(settings, run);
}

/// The share of a band of width `from` around `aside` that lies within one of width `into` around
/// 0.
double overlap(double aside, double from, double into) {
    const double low = std::max(aside - 0.5 * from, -0.5 * into),
                 high = std::min(aside + 0.5 * from, 0.5 * into);
    return std::max(0.0, high - low) / from;
}

// Where slopes are so small that no facet hides another, the light of each goes where its own slope
// sends it: what the receptors see is a sum over the surface's facets.
TEST(Glossmeter, DistinctnessOfImageIsThatOfTheFacets) {
    const Heightfield surface = gaussian(0.004, 256);
    const DoiSettings doi = {0.1, 0.2, 30};
    const double theta = radians(doi.angle_deg);
    const Vec3 wi = {std::sin(theta), 0, std::cos(theta)};
    double mirror = 0, aside = 0;
    for (int cell = 0; cell < surface.nx * surface.ny; ++cell) {
        const int x = cell % surface.nx, y = cell / surface.nx;
        const auto at = [&](int i, int j) {
            return double{surface.heights[static_cast<std::size_t>((y + j) % surface.ny) *
                                              static_cast<std::size_t>(surface.nx) +
                                          static_cast<std::size_t>((x + i) % surface.nx)]};
        };
        // Two facets a cell, either diagonal: their slopes are differences along its sides
        const Vec3 facets[] = {{at(0, 0) - at(1, 0), at(0, 0) - at(0, 1), 1},
                               {at(0, 1) - at(1, 1), at(1, 0) - at(1, 1), 1}};
        for (const Vec3& n : facets) {
            const Vec3 wo = reflect(wi, normalize(n));
            const double off = degrees(std::atan2(-wo.x, wo.z)) - doi.angle_deg;
            const double light = dot(n, wi);
            mirror += light * overlap(off, doi.source_deg, doi.receptor_deg);
            for (const double side : {-0.3, 0.3})
                aside += 0.5 * light * overlap(off - side, doi.source_deg, doi.receptor_deg);
        }
    }
    const double expected = 100 * (1 - aside / mirror);
    const WithError r = read_doi(surface, doi, 1 << 19).doi->doi[0];
    EXPECT_LT(r.error, 1.5);
    EXPECT_NEAR(r.value, expected, 4 * r.error);
    EXPECT_NEAR(expected, 30, 20);  // neither nothing nor all
}

// f = D G2 / (4 cos cos) of a mirroring Gaussian surface over the apertures. Smith has the facets
// hide each other as if they knew nothing of their neighbours, and leaves out light that meets
// several: nothing of that counts where little is hidden, and up to a fifth at grazing angles.
TEST(Glossmeter, AgreesWithSmithOverTheApertures) {
    for (const double alpha : {0.05, 0.1, 0.3}) {
        const GlossReport report = read(gaussian(alpha, 1024), {}, 1 << 20, 2);
        const SmithSurface smith = {SlopeFamily::Beckmann, alpha, alpha};
        const auto f = [&](Vec3 wi, Vec3 wo) {
            const double g2 = 1 / (1 + smith.lambda(wi) + smith.lambda(wo));
            return smith.normal_density(normalize(wi + wo)) * g2 / (4 * wi.z * wo.z);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const GlossOptics optics(standard_gloss_geometry(angle_of(k)));
            const double expected = 100 * optics.share(f, 12) / optics.glass(kGlossIndex);
            const WithError gloss = report.readings[k].gloss[0];
            const bool hidden = k == 2 || (k == 1 && alpha == 0.3);
            EXPECT_NEAR(gloss.value, expected, 4 * gloss.error + (hidden ? 0.2 : 0.01) * expected)
                << alpha << " at " << angle_of(k);
        }
    }
}

// Where Smith is not to be trusted: what the gonioreflectometer's other engine sorts into fine
// cells, added up over those in the receptor.
TEST(Glossmeter, AgreesWithTheGonioreflectometer) {
    const Heightfield surface = gaussian(0.3, 512);
    Experiment experiment;
    experiment.illumination.theta_deg = {60, 85};
    experiment.detector.resolution = 1440;
    experiment.detector.orders = 1;
    experiment.run.rays = 1 << 20;
    asperity::Run run(2);
    const Measurement m = measure(surface, experiment, run);
    const GlossReport report = read(surface, {}, 1 << 20, 2);
    for (const Layer& layer : m.layers) {
        const std::size_t k = layer.theta_i < radians(70) ? 1 : 2;
        const GlossOptics optics(standard_gloss_geometry(angle_of(k)));
        double share = 0;
        for (int cell = 0; cell < m.detector.cells(); ++cell)
            if (optics.receives(m.detector.centre(cell))) share += m.energy(layer, 0, cell);
        const double expected = 100 * share / optics.glass(kGlossIndex);
        const WithError gloss = report.readings[k].gloss[0];
        EXPECT_NEAR(gloss.value, expected, 6 * gloss.error + 0.01 * expected) << angle_of(k);
    }
}

TEST(Glossmeter, GivesTheSameBitsForAnyNumberOfThreads) {
    SurfaceSettings settings;
    settings.kind = "ggx";
    settings.size = 64;
    asperity::Run run(1);
    const Heightfield surface = make_surface(settings, run);
    const GlossReport one = read(surface, {}, 30000, 1), four = read(surface, {}, 30000, 4);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(one.readings[k].gloss[0].value, four.readings[k].gloss[0].value);
        EXPECT_EQ(one.readings[k].gloss[0].error, four.readings[k].gloss[0].error);
        EXPECT_EQ(one.readings[k].reflectance[0].value, four.readings[k].reflectance[0].value);
    }
}

// Grooves that tilt every facet by 20 degrees along x send nothing into the receptor from the
// azimuth 0; turned by 90 degrees, across the plane, neither. A tilt of 0.5 degrees stays inside.
TEST(Glossmeter, KnowsWhereTheInstrumentStands) {
    const Heightfield surface = grooves(0.7);
    asperity::Run run(1);
    GlossSettings gloss;
    gloss.angles_deg = {20};
    gloss.run.rays = 20000;
    // In the plane light goes 1.4 degrees aside and 0.9 are received; across, 1.4 cos 20 of 1.8
    EXPECT_NEAR(measure_gloss(surface, {}, gloss, run).readings[0].gloss[0].value, 0, 1e-9);
    EXPECT_GT(measure_gloss(surface, {}, gloss, run).readings[0].haze[0].value, 1000);
    gloss.azimuth_deg = 90;
    EXPECT_GT(measure_gloss(surface, {}, gloss, run).readings[0].gloss[0].value, 1000);
    gloss.all_azimuths = true;
    const double all = measure_gloss(surface, {}, gloss, run).readings[0].gloss[0].value;
    EXPECT_GT(all, 300);
    EXPECT_LT(all, 1900);
}

TEST(Glossmeter, RefinesUntilTheErrorIsSmall) {
    SurfaceSettings surface;
    surface.kind = "gaussian";
    surface.size = 64;
    asperity::Run run(1);
    GlossSettings settings;
    settings.angles_deg = {60};
    settings.run.rays = 4000;
    settings.run.until = 0.05;
    const GlossReport report = measure_gloss(make_surface(surface, run), {}, settings, run);
    EXPECT_LE(report.readings[0].gloss[0].error, 0.05 * report.readings[0].gloss[0].value);
    EXPECT_GT(report.readings[0].rays, 4000u);
    settings.angles_deg = {45};
    EXPECT_THROW(measure_gloss(flat(), {}, settings, run), Error);
}

// 50 angstrom at 0.5 um: FRED's help says 0.015791.
TEST(TotalIntegratedScatter, OfASmoothSurface) {
    EXPECT_NEAR(total_integrated_scatter(5e-9, 0.5e-6, 0), 0.0156674, 1e-6);
    EXPECT_NEAR(std::pow(4 * kPi * 5e-9 / 0.5e-6, 2), 0.015791, 1e-6);
    EXPECT_NEAR(total_integrated_scatter(1e-4, 0.5e-6, 0), 1, 1e-12);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
//
// Surfaces whose reflection can be worked out with pencil and paper. Each test carries its
// derivation. Angles in the plane of incidence are counted from z towards +x: a mirror whose normal
// stands at angle n turns light from angle i into light to angle 2 n - i.
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace asperity {
namespace {

/// Two roundings to single precision: directions and weights of paths are carried in it.
constexpr double kSingle = 1.2e-7;

constexpr double kShare = 3e-3;  // asked accuracy of order energies

Heightfield heights_of(int nx, int ny, const std::function<double(int, int)>& h,
                       Diagonal diagonal = Diagonal::Anti) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    s.diagonal = diagonal;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) s.heights.push_back(static_cast<float>(h(i, j)));
    return s;
}

Heightfield groove(double tilt_deg, int period = 32) {
    return heights_of(2 * period, 8, [=](int i, int) {
        const int x = i % period;
        return std::tan(radians(tilt_deg)) * std::min(x, period - x);
    });
}

Measurement measured(const Heightfield& surface, double theta_deg, double phi_deg, int bounces = 8,
                     const OpticsSettings& optics = {}) {
    Experiment e;
    e.optics = optics;
    e.illumination.theta_deg = {theta_deg};
    e.illumination.phi_deg = {phi_deg};
    e.detector.resolution = 90;  // rows and columns of 2 and 4 degrees
    e.run.rays = 1000000;
    e.run.bounces = bounces;
    asperity::Run run(2);
    return measure(surface, e, run);
}

double order_share(const Measurement& m, int order) {
    return m.albedo(m.layers[0], order - 1, 0);
}

/// Energy of one order that left within 2 degrees of a direction.
double towards(const Measurement& m, int order, double theta_deg, double phi_deg) {
    const Vec3 w = from_spherical(radians(theta_deg), radians(phi_deg));
    double sum = 0;
    for (int cell = 0; cell < m.detector.cells(); ++cell) {
        const double row_centre = m.detector.theta_centre(cell / m.detector.columns());
        const bool near_pole = row_centre < radians(2) && theta_deg < 2;
        if (near_pole || dot(m.detector.centre(cell), w) > std::cos(radians(3)))
            sum += m.energy(m.layers[0], order - 1, 0, cell);
    }
    return sum;
}

double truncated(const Measurement& m) {
    return static_cast<double>(m.layers[0].truncated[0]) /
           (4294967296.0 * static_cast<double>(m.layers[0].rays));
}

// --- flat mirror: one facet orientation, one reflection, all energy in the mirror direction
// --------

TEST(FlatMirror, SendsEverythingIntoOneCell) {
    const Heightfield flat = heights_of(8, 8, [](int, int) { return 1.0; });
    const Measurement m = measured(flat, 35, 20);
    const int cell = m.detector.cell_of(from_spherical(radians(35), radians(200)));
    EXPECT_EQ(m.energy(m.layers[0], 0, cell), 1.0);
    EXPECT_EQ(m.albedo(m.layers[0], 0), 1.0);
    EXPECT_EQ(m.layers[0].stderr_albedo[0], 0.0);
    EXPECT_EQ(m.layers[0].segments, 2 * m.layers[0].rays);
    EXPECT_EQ(m.layers[0].reflections, m.layers[0].rays);
}

TEST(FlatMirror, ReflectsWhatFresnelSays) {
    const Heightfield flat = heights_of(8, 8, [](int, int) { return 0.0; });
    OpticsSettings schlick;
    schlick.fresnel = FresnelKind::Schlick;
    schlick.f0 = {0.04, 0.5, 0.9};
    // 0.04 + 0.96 (1 - 1/2)^5 = 0.07; 0.5 + 0.5 / 32; 0.9 + 0.1 / 32 at 60 degrees
    const Measurement m = measured(flat, 60, 0, 8, schlick);
    EXPECT_NEAR(m.albedo(m.layers[0], 0), 0.07, kSingle);
    EXPECT_NEAR(m.albedo(m.layers[0], 1), 0.515625, kSingle);
    EXPECT_NEAR(m.albedo(m.layers[0], 2), 0.903125, kSingle);

    OpticsSettings glass;
    glass.fresnel = FresnelKind::Dielectric;
    glass.ior = {1.5};
    // At Brewster's angle atan 1.5 the p wave is gone; s: ((1 - n^2) / (1 + n^2))^2 = (1.25/3.25)^2
    const double brewster = degrees(std::atan(1.5));
    const double s_wave = std::pow(1.25 / 3.25, 2);
    const Measurement g = measured(flat, brewster, 0, 8, glass);
    EXPECT_NEAR(g.albedo(g.layers[0], 0), 0.5 * s_wave, kSingle);

    OpticsSettings metal;
    metal.fresnel = FresnelKind::Conductor;
    metal.ior = {0.2};
    metal.k = {3.0};
    // ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2) along the normal = 9.64 / 10.44
    const Measurement c = measured(flat, 0, 0, 8, metal);
    EXPECT_NEAR(c.albedo(c.layers[0], 0), 9.64 / 10.44, kSingle);
}

// --- saw tooth: one long facet tilted by t (normal at -t), rising along x for N - 1 of N cells
// -----

TEST(TiltedFacets, LightFromTwiceTheTiltLeavesStraightUp) {
    // Light from -2 t (azimuth 180 degrees): the falling wall faces away from it, so all of it
    // meets long facets: 2 (-t) - (-2 t) = 0, straight up. Nothing stands in the way.
    const double t = 20;
    const Heightfield s = heights_of(64, 4, [=](int i, int) { return i * std::tan(radians(t)); });
    const Measurement m = measured(s, 2 * t, 180);
    EXPECT_NEAR(towards(m, 1, 0, 0), 1, 1e-9);
}

TEST(TiltedFacets, LightFromAboveIsPartlyBlockedByTheNextTooth) {
    // The way back: a ray starting at x0 on the facet, height x0 tan t, climbs 1 / tan 2t per cell
    // towards -x and must pass the crest at x = -1, height (N - 1) tan t:
    //   x0 > ((N - 1) tan t - cot 2t) / (tan t + cot 2t),  and (N - 1 - x0) / N = cos 2t,
    // as reciprocity asks: E(0 -> 2t) cos 0 = E(2t -> 0) cos 2t = cos 2t.
    const double t = 20;
    const Heightfield s = heights_of(64, 4, [=](int i, int) { return i * std::tan(radians(t)); });
    const Measurement m = measured(s, 0, 0);
    EXPECT_NEAR(towards(m, 1, 2 * t, 180), std::cos(radians(2 * t)), kShare);
}

// --- 45 degree V-groove along y. wi = (sx, sy, cz); tan psi = tan(theta) cos(phi) is the angle in
// the plane across. The wall facing the light sends (sx, sy, cz) to (cz, -sy, sx): out at once for
// a share tan psi, onto the other wall else. Both walls: (sx, -sy, cz), back to where it came from
// across the groove. The derivation: walls h = |x|, depth d, width 2 d. Light at height d and entry
// point x meets the lit wall at (-x0, x0), x = d tan psi - x0 (1 + tan psi); its mirror image
// climbs tan psi per unit towards the other wall and clears it if x0 > d (1 - tan psi) / (1 + tan
// psi): a strip of width 2 d tan psi in x out of 2 d.

TEST(RightAngleGroove, ReturnsNormalLightAfterTwoReflections) {
    const Measurement m = measured(groove(45), 0, 0);
    EXPECT_NEAR(order_share(m, 2), 1, 1e-9);
    EXPECT_NEAR(towards(m, 2, 0, 0), 1, 1e-9);
}

TEST(RightAngleGroove, SharesAcrossTheGroove) {
    for (const double theta : {10.0, 20.0, 30.0, 40.0}) {
        const Measurement m = measured(groove(45), theta, 0);
        const double single = std::tan(radians(theta));
        EXPECT_NEAR(order_share(m, 1), single, kShare);
        EXPECT_NEAR(order_share(m, 2), 1 - single, kShare);
        EXPECT_NEAR(towards(m, 1, 90 - theta, 0), single, kShare);  // on the light's own side
        EXPECT_NEAR(towards(m, 2, theta, 0), 1 - single, kShare);   // retro-reflection
    }
}

TEST(RightAngleGroove, BeyondHalfItsOpeningEverythingLeavesAtOnce) {
    const Measurement m = measured(groove(45), 60, 0);
    EXPECT_NEAR(towards(m, 1, 30, 0), 1, 1e-9);
}

TEST(RightAngleGroove, SharesAtObliqueAzimuths) {
    for (const double phi : {30.0, 60.0, 75.0}) {
        const double theta = 35;
        const Measurement m = measured(groove(45), theta, phi);
        const Vec3 wi = from_spherical(radians(theta), radians(phi));
        const double single = std::tan(radians(theta)) * std::cos(radians(phi));
        const Vec3 once = {wi.z, -wi.y, wi.x};
        EXPECT_NEAR(order_share(m, 1), single, kShare);
        EXPECT_NEAR(towards(m, 1, degrees(polar_angle(once)), degrees(azimuth(once))), single,
                    kShare);
        EXPECT_NEAR(towards(m, 2, theta, 360 - phi), 1 - single, kShare);
    }
}

TEST(RightAngleGroove, LightAlongTheGrooveLeavesLikeFromAMirror) {
    const Measurement m = measured(groove(45), 50, 90);  // psi = 0: two reflections, (0, -sy, cz)
    EXPECT_NEAR(towards(m, 2, 50, 270), 1, 1e-9);
}

TEST(RightAngleGroove, CutAtOneReflectionTheDoubleShareIsTruncated) {
    const double single = std::tan(radians(20));
    const Measurement m = measured(groove(45), 20, 0, /*bounces=*/1);
    EXPECT_NEAR(m.albedo(m.layers[0], 0), single, kShare);
    EXPECT_NEAR(truncated(m), 1 - single, kShare);
    EXPECT_EQ(m.layers[0].escaped[0] + m.layers[0].truncated[0], m.layers[0].rays << 32);
}

TEST(RightAngleGroove, EveryReflectionTakesItsShare) {
    // Constant F (Schlick with all weight in F0 = 1 has none; a conductor turns with angle): at
    // normal incidence both reflections happen at 45 degrees: E2 = F(45)^2.
    OpticsSettings schlick;
    schlick.fresnel = FresnelKind::Schlick;
    schlick.f0 = {0.5};
    const double f = 0.5 + 0.5 * std::pow(1 - std::sqrt(0.5), 5);
    const Measurement m = measured(groove(45), 0, 0, 8, schlick);
    EXPECT_NEAR(order_share(m, 2), f * f, kSingle);
    EXPECT_NEAR(static_cast<double>(m.layers[0].absorbed[0]) /
                    (4294967296.0 * static_cast<double>(m.layers[0].rays)),
                1 - f * f, kSingle);
}

// --- 20 degree groove, light from 40 degrees: walls h = |x| T, T = tan 20.
// The wall facing the light (normal +20) catches (1 + T tan 40) / 2 and sends it to 2 20 - 40 = 0.
// The other (normal -20) catches (1 - T tan 40) / 2 and sends it to -80, elevation e = 10 degrees;
// from x it hits the facing wall unless x > d (T - tan e) / (T + tan e). What hits it comes from
// +100 degrees and goes to 2 20 - 100 = -60, over the crest.

TEST(ShallowGroove, ExitIsPartlyBlocked) {
    const double big_t = std::tan(radians(20)), tan_e = std::tan(radians(10));
    const double facing = 0.5 * (1 + big_t * std::tan(radians(40)));
    const double blocked = (big_t - tan_e) / (big_t + tan_e);
    const Measurement m = measured(groove(20), 40, 0);
    EXPECT_NEAR(towards(m, 1, 0, 0), facing, kShare);
    EXPECT_NEAR(towards(m, 1, 80, 180), (1 - facing) * (1 - blocked), kShare);
    EXPECT_NEAR(towards(m, 2, 60, 180), (1 - facing) * blocked, kShare);
    EXPECT_NEAR(order_share(m, 1) + order_share(m, 2), 1, 1e-9);
}

TEST(ShallowGroove, NormalLightLeavesToBothSides) {
    const Measurement m = measured(groove(20), 0, 0);
    EXPECT_NEAR(towards(m, 1, 40, 0), 0.5, kShare);
    EXPECT_NEAR(towards(m, 1, 40, 180), 0.5, kShare);
}

// --- pyramids h = s (tri x + tri y): four kinds of facet, slopes (+-s, +-s), equal areas
// ------------

TEST(Pyramids, NormalLightLeavesInFourBeams) {
    // Tilt 20 degrees: s = tan 20 / sqrt 2; beams at 40 degrees, azimuths 45 + 90 k. The steepest
    // rise along a beam is tan 20, its elevation 50 degrees: nothing in the way.
    const double slope = std::tan(radians(20)) / std::sqrt(2);
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        const Heightfield s = heights_of(
            32, 32,
            [=](int i, int j) {
                return slope * (std::min(i % 16, 16 - i % 16) + std::min(j % 16, 16 - j % 16));
            },
            diagonal);
        const Measurement m = measured(s, 0, 0);
        for (const double phi : {45.0, 135.0, 225.0, 315.0})
            EXPECT_NEAR(towards(m, 1, 40, phi), 0.25, kShare);
    }
}

// --- a chequerboard of heights 0 and c: its diagonal decides what it is. Cut from (i+1, j) to
// (i, j+1) every facet has slope +-(c, c): grooves along the anti-diagonal; cut the other way
// +-(c, -c). Tilt atan(c sqrt 2) = 20 degrees sends normal light to 40 degrees, across the grooves.

TEST(Chequerboard, TheDiagonalTurnsTheGrooves) {
    const double c = std::tan(radians(20)) / std::sqrt(2);
    const auto board = [=](Diagonal d) {
        return heights_of(
            16, 16, [=](int i, int j) { return c * ((i + j) % 2); }, d);
    };
    const Measurement anti = measured(board(Diagonal::Anti), 0, 0);
    EXPECT_NEAR(towards(anti, 1, 40, 45), 0.5, kShare);
    EXPECT_NEAR(towards(anti, 1, 40, 225), 0.5, kShare);
    const Measurement main = measured(board(Diagonal::Main), 0, 0);
    EXPECT_NEAR(towards(main, 1, 40, 135), 0.5, kShare);
    EXPECT_NEAR(towards(main, 1, 40, 315), 0.5, kShare);
}

// --- orientation: rows of the array are y
// -----------------------------------------------------------

TEST(Orientation, SlopeAlongYSendsLightAlongY) {
    // Heights rise with j: normals lean to -y, so normal light leaves to azimuth 270 degrees.
    const Heightfield s = heights_of(4, 64, [](int, int j) { return j * std::tan(radians(20)); });
    const Measurement m = measured(s, 0, 0);
    EXPECT_NEAR(towards(m, 1, 40, 270), std::cos(radians(40)), kShare);
}

}  // namespace
}  // namespace asperity

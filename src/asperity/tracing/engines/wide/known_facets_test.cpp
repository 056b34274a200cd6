// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/known_facets.h>

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/core/run.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

constexpr int kBounces = 8, kOrders = 4;

struct LitSurface {
    const char* name;
    const char* kind;
    Diagonal diagonal;
    const char* material;  ///< null: perfect mirrors
    double theta_deg, phi_deg;
};
void PrintTo(const LitSurface& c, std::ostream* out) {
    *out << c.name;
}

class KnownFacetsOf : public testing::TestWithParam<LitSurface> {
  protected:
    KnownFacetsOf()
        : surface_(make()),
          tracer_(surface_, 2),
          fresnel_(optics()),
          detector_(DetectorSettings{DetectorKind::LatLong, 64}) {}

    /// Four rays a cell, followed with what is known, or without.
    LayerSums sums(const KnownFacets* known) {
        const std::uint64_t rays = 4 * surface_.cell_count();
        const SumShape shape{.cells = cells(),
                             .channels = static_cast<std::size_t>(channels()),
                             .orders = kOrders,
                             .bounces = kBounces};
        BatchSums batch(shape);
        Follower follower;
        asperity::Run run(1);
        follower.follow(scene(known), {LaunchPattern::LowDiscrepancy, rays, 1, 0, 0}, batch, run);
        LayerSums all(shape, rays);
        all.add(0, batch);
        all.settle();
        return all;
    }
    KnownFacets known(int threads) { return {scene(nullptr), asperity::Run(threads), threads}; }
    /// Facets that are known, of all: lower and upper ones.
    double known_share(const KnownFacets& known) const {
        const CountedFacets counted = known.counted();
        int count = 0;
        for (int j = 0; j < surface_.cells_y(); ++j)
            for (int i = 0; i < surface_.cells_x(); ++i) {
                const std::uint8_t cell = counted.cells[j * counted.pitch + i];
                count +=
                    (cell & CountedFacets::kLower ? 1 : 0) + (cell & CountedFacets::kUpper ? 1 : 0);
            }
        return count / (2.0 * static_cast<double>(surface_.cell_count()));
    }
    std::size_t cells() const { return static_cast<std::size_t>(detector_.cells()); }
    int channels() const { return fresnel_.channels(); }
    const Heightfield& surface() const { return surface_; }

  private:
    Scene scene(const KnownFacets* known) const {
        return {surface_, tracer_, fresnel_, detector_, kBounces, light_, known};
    }
    static Heightfield make() {
        SurfaceSettings settings;
        settings.kind = GetParam().kind;
        settings.diagonal = GetParam().diagonal;
        settings.size = 64;
        settings.roughness = 0.05;
        settings.alpha_x = settings.alpha_y = 0.7;
        asperity::Run run(1);
        return make_surface(settings, run);
    }
    static OpticsSettings optics() {
        OpticsSettings settings;
        if (GetParam().material) {
            settings.fresnel = FresnelKind::Conductor;
            settings.material = GetParam().material;
        }
        return settings;
    }

    const Heightfield surface_;
    const WideTracer tracer_;
    const Fresnel fresnel_;
    const Detector detector_;
    const Incidence light_{1, radians(GetParam().theta_deg), radians(GetParam().phi_deg), false};
};

/// A ray that is counted must be one that would leave after one reflection, and no other may take
/// part in it: what happens to all rays is the same, reflection by reflection.
TEST_P(KnownFacetsOf, LeaveAllOtherRaysAsTheyAre) {
    const KnownFacets facets = known(2);
    EXPECT_GT(known_share(facets), 0.25);
    EXPECT_LT(known_share(facets), 1.0);

    const LayerSums with = sums(&facets), without = sums(nullptr);
    EXPECT_EQ(with.segments, without.segments);
    EXPECT_EQ(with.reflections, without.reflections);
    EXPECT_EQ(with.truncated, without.truncated);
    const std::size_t order = cells() * static_cast<std::size_t>(channels());
    for (std::size_t k = order; k < with.energy.size(); ++k)
        ASSERT_EQ(with.energy[k], without.energy[k]);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels()); ++c) {
        for (std::size_t b = 1; b < kBounces; ++b)
            EXPECT_EQ(with.escaped_by_bounce[c * kBounces + b],
                      without.escaped_by_bounce[c * kBounces + b]);
        const double first = static_cast<double>(with.escaped_by_bounce[c * kBounces]),
                     plain = static_cast<double>(without.escaped_by_bounce[c * kBounces]);
        if (channels() == 1)
            EXPECT_EQ(first, plain);
        else
            EXPECT_NEAR(first / plain, 1, 1e-3);
    }
    EXPECT_GT(with.escaped_by_bounce[1], 0u) << "no second reflection: the test tests nothing";
}

/// Their light goes where their rays go, but for the rays' noise: no cell is further off than some
/// thousand rays allow.
TEST_P(KnownFacetsOf, SendTheirLightWhereTheirRaysGo) {
    const KnownFacets facets = known(1);
    const LayerSums with = sums(&facets), without = sums(nullptr);
    const double rays = static_cast<double>(with.rays);
    double chi_square = 0;
    int cells_seen = 0;
    for (std::size_t k = 0; k < cells(); ++k) {
        const std::size_t red = k * static_cast<std::size_t>(channels());
        const double a = energy_fraction(with.energy[red], with.rays) * rays,
                     b = energy_fraction(without.energy[red], without.rays) * rays;
        if (a < 8) continue;
        chi_square += (a - b) * (a - b) / a;
        ++cells_seen;
    }
    ASSERT_GT(cells_seen, 20);
    // Of independent rays it would be about 1; a lattice does better
    EXPECT_LT(chi_square / cells_seen, 1.2);
}

TEST_P(KnownFacetsOf, DoNotDependOnTheThreads) {
    const KnownFacets one = known(1), three = known(3);
    EXPECT_EQ(one.light()->places, three.light()->places);
    EXPECT_EQ(one.light()->energy, three.light()->energy);
    const CountedFacets a = one.counted(), b = three.counted();
    for (int k = 0; k < a.pitch * surface().cells_y(); ++k) ASSERT_EQ(a.cells[k], b.cells[k]);
}

INSTANTIATE_TEST_SUITE_P(
    Surfaces, KnownFacetsOf,
    testing::Values(LitSurface{"normal", "gaussian", Diagonal::Anti, nullptr, 0, 0},
                    LitSurface{"slanted", "gaussian", Diagonal::Anti, nullptr, 45, 20},
                    LitSurface{"mirrored", "gaussian", Diagonal::Main, nullptr, 45, 200},
                    LitSurface{"mirrored_normal", "gaussian", Diagonal::Main, nullptr, 0, 0},
                    LitSurface{"copper", "gaussian", Diagonal::Anti, "Cu", 45, 20},
                    LitSurface{"copper_normal", "gaussian", Diagonal::Anti, "Cu", 0, 0},
                    LitSurface{"thesis", "thesis", Diagonal::Anti, nullptr, 60, 310}),
    [](const testing::TestParamInfo<LitSurface>& tested) {
        return std::string(tested.param.name);
    });

Heightfield make_mirror(asperity::Run& run) {
    SurfaceSettings settings;
    settings.kind = "flat";
    settings.size = 64;
    return make_surface(settings, run);
}

KnownFacets known_on(const Heightfield& surface, const WideTracer& tracer, const Detector& detector,
                     const Incidence& light, const Fresnel& fresnel = Fresnel{OpticsSettings{}}) {
    return {Scene{surface, tracer, fresnel, detector, 1, light, nullptr}, asperity::Run(1)};
}

TEST(KnownFacets, OfAMirrorAreAllKnown) {
    asperity::Run run(1);
    const Heightfield surface = make_mirror(run);
    const WideTracer tracer(surface, run);
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 64});
    const KnownFacets known =
        known_on(surface, tracer, detector, Incidence{1, radians(30), radians(40), false});
    const int mirror = detector.cell_of(from_spherical(radians(30), radians(220)));
    ASSERT_EQ(known.light()->places, std::vector{static_cast<std::uint32_t>(mirror)});
    EXPECT_EQ(known.light()->energy[0], kRayEnergy);
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i)
            ASSERT_EQ(known.counted().cells[j * known.counted().pitch + i],
                      CountedFacets::kLower | CountedFacets::kUpper);
}

/// Grooves of slope s in light across them take (1 + s tan theta) / 2 and (1 - s tan theta) / 2.
TEST(KnownFacets, OfAGrooveShareTheLightByTheirProjectedAreas) {
    asperity::Run run(1);
    SurfaceSettings settings;
    settings.kind = "vgroove";
    settings.size = 64;
    settings.tilt_deg = 5;
    const Heightfield surface = make_surface(settings, run);
    const WideTracer tracer(surface, run);
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 90});
    const double theta = radians(30.5), tilt = radians(5);
    const KnownFacets known = known_on(surface, tracer, detector, Incidence{1, theta, 0, false});
    const double lean = std::tan(tilt) * std::tan(theta);
    // The slopes towards the light and away from it mirror it to theta -+ 2 tilt beyond the normal
    const int towards = detector.cell_of(from_spherical(theta - 2 * tilt, kPi)),
              away = detector.cell_of(from_spherical(theta + 2 * tilt, kPi));
    const auto share = [&](int cell) {
        const auto& cells = known.light()->places;
        for (std::size_t k = 0; k < cells.size(); ++k)
            if (cells[k] == static_cast<std::uint32_t>(cell))
                return std::ldexp(static_cast<double>(known.light()->energy[k]), -32);
        return 0.0;
    };
    EXPECT_EQ(known.light()->places.size(), 2u);
    EXPECT_NEAR(share(towards), (1 + lean) / 2, 1e-6);
    EXPECT_NEAR(share(away), (1 - lean) / 2, 1e-6);
    EXPECT_EQ(known.light()->energy[0] + known.light()->energy[1], kRayEnergy);
}

/// However deep a trench beside it and however grazing the light, a level metal absorbs its 0.07 %
/// to four digits: a steep wall may take 60,000 times as much light as a level facet.
TEST(KnownFacets, TakeNoLessThanTheirShareBesideSteepOnes) {
    OpticsSettings gold;
    gold.fresnel = FresnelKind::Conductor;
    gold.ior = {0.156};
    gold.k = {3.602};
    const Fresnel fresnel(gold);
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 64});
    Heightfield surface;
    surface.nx = surface.ny = 64;
    for (const float depth : {1.0f, 10.0f, 100.0f, 10000.0f}) {
        surface.heights.assign(64 * 64, 0.0f);
        for (std::size_t k = 32; k < surface.heights.size(); k += 64) surface.heights[k] = -depth;
        const WideTracer tracer(surface, 1);
        const KnownFacets known = known_on(
            surface, tracer, detector, Incidence{1, radians(89.9), radians(90), false}, fresnel);
        const double absorbed = 1 - fresnel_conductor(std::cos(radians(89.9)), 0.156, 3.602);
        ASSERT_EQ(known.light()->places.size(), 1u) << depth;
        const double sent = std::ldexp(static_cast<double>(known.light()->energy[0]), -32);
        EXPECT_NEAR((1 - sent) / absorbed, 1, 3e-4) << depth;
    }
}

TEST(KnownFacets, AreLookedForOnlyWhereThatPays) {
    asperity::Run run(1);
    const Heightfield surface = make_mirror(run);
    const WideTracer tracer(surface, run);
    EXPECT_FALSE(KnownFacets::pay(tracer, 64 * 64 - 1));
    EXPECT_TRUE(KnownFacets::pay(tracer, 64 * 64));
    EXPECT_EQ(KnownFacets().counted().cells, nullptr);
}

}  // namespace
}  // namespace asperity

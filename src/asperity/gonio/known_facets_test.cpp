// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/known_facets.h>

#include <asperity/core/directions.h>
#include <asperity/core/run.h>
#include <asperity/gonio/test_measurements.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace asperity {
namespace {

constexpr int kBounces = 8;

struct Case {
    const char* name;
    SurfaceKind kind;
    Diagonal diagonal;
    const char* material;  ///< null: perfect mirrors
    double theta_deg, phi_deg;
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

class KnownFacetsOf : public testing::TestWithParam<Case> {
  protected:
    KnownFacetsOf()
        : surface_(make()),
          tracer_(surface_, run_),
          fresnel_(optics()),
          detector_(DetectorSettings{DetectorKind::LatLong, 64}) {}

    /// Four rays a cell, followed with what is known, or without.
    Layer layer(const KnownFacets* known) {
        const Scene scene{tracer_, fresnel_, detector_, kBounces, false, known};
        const std::uint64_t rays = 4 * surface_.cell_count();
        const LaunchBatch batch(surface_, double{tracer_.max_height()}, light_,
                                LaunchPattern::LowDiscrepancy, rays, 1, 0, 0);
        BatchSums sums(detector_.cells(), fresnel_.channels(), 4, kBounces);
        Follower follower;
        for (std::uint64_t k = 0; k < rays; k += Follower::kMost)
            follower.follow(scene, batch, k, std::min(k + Follower::kMost, rays), sums);
        LayerSums all(detector_.cells(), fresnel_.channels(), 4, kBounces, rays);
        all.add(sums);
        Layer result;
        all.write(result);
        return result;
    }
    KnownFacets known() {
        return {Scene{tracer_, fresnel_, detector_, kBounces, false, nullptr}, light_, run_};
    }
    std::size_t facets() const { return 2 * surface_.cell_count(); }

  private:
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

    asperity::Run run_{2};
    const Heightfield surface_;
    const WideTracer tracer_;
    const Fresnel fresnel_;
    const Detector detector_;
    const Incidence light_{1, radians(GetParam().theta_deg), radians(GetParam().phi_deg), false};
};

TEST_P(KnownFacetsOf, ChangeNoBit) {
    const KnownFacets facets_known = known();
    const auto answers = std::count_if(facets_known.cells(), facets_known.cells() + facets(),
                                       [](std::int32_t cell) { return cell >= 0; });
    EXPECT_GT(static_cast<std::size_t>(answers), facets() / 4);
    EXPECT_LT(static_cast<std::size_t>(answers), facets());

    const Layer with = layer(&facets_known), without = layer(nullptr);
    test::expect_same_bits(with, without);
    EXPECT_GT(with.escaped_by_bounce[0], 0u);
    EXPECT_GT(with.escaped_by_bounce[1], 0u) << "no second reflection: the test tests nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Surfaces, KnownFacetsOf,
    testing::Values(Case{"normal", SurfaceKind::Gaussian, Diagonal::Anti, nullptr, 0, 0},
                    Case{"slanted", SurfaceKind::Gaussian, Diagonal::Anti, nullptr, 45, 20},
                    Case{"mirrored", SurfaceKind::Gaussian, Diagonal::Main, nullptr, 45, 200},
                    Case{"mirrored_normal", SurfaceKind::Gaussian, Diagonal::Main, nullptr, 0, 0},
                    Case{"copper", SurfaceKind::Gaussian, Diagonal::Anti, "Cu", 45, 20},
                    Case{"copper_normal", SurfaceKind::Gaussian, Diagonal::Anti, "Cu", 0, 0},
                    Case{"thesis", SurfaceKind::Thesis, Diagonal::Anti, nullptr, 60, 310}),
    [](const testing::TestParamInfo<Case>& tested) { return std::string(tested.param.name); });

Heightfield make_mirror(asperity::Run& run) {
    SurfaceSettings settings;
    settings.kind = SurfaceKind::Flat;
    settings.size = 64;
    return make_surface(settings, run);
}

TEST(KnownFacets, OfAMirrorAreAllKnown) {
    asperity::Run run(1);
    const Heightfield surface = make_mirror(run);
    const WideTracer tracer(surface, run);
    const Fresnel fresnel{OpticsSettings{}};
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 64});
    const Incidence light{1, radians(30), radians(40), false};
    const KnownFacets known(Scene{tracer, fresnel, detector, 1, false, nullptr}, light, run);
    const int mirror = detector.cell_of(from_spherical(radians(30), radians(220)));
    for (int k = 0; k < 2 * 64 * 64; ++k) ASSERT_EQ(known.cells()[k], mirror) << k;
}

TEST(KnownFacets, AreLookedForOnlyWhereThatPays) {
    asperity::Run run(1);
    const Heightfield surface = make_mirror(run);
    const WideTracer tracer(surface, run);
    EXPECT_FALSE(KnownFacets::pay(tracer, 64 * 64));
    EXPECT_TRUE(KnownFacets::pay(tracer, 4 * 64 * 64));
    EXPECT_EQ(KnownFacets().cells(), nullptr);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/heightfield_view.h>

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <mutex>

namespace asperity {
namespace {

Heightfield field(int nx, int ny, std::vector<float> heights,
                  Boundary boundary = Boundary::Periodic) {
    Heightfield surface;
    surface.nx = nx;
    surface.ny = ny;
    surface.heights = std::move(heights);
    surface.boundary = boundary;
    return surface;
}

Heightfield flat(int nx, int ny, float height = 0) {
    return field(
        nx, ny,
        std::vector<float>(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), height));
}

WorldRay ray_to(Vec3 from, Vec3 to) {
    return {from, normalize(to - from)};
}

void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-12) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// A wall of height 2 along x = 2 in a patch of 4 x 2 cells: profile 0 0 2 0 0.
Heightfield ridge() {
    return field(5, 3, {0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0}, Boundary::Finite);
}

TEST(HeightfieldView, FlatTileShowsEachCellWhereItLies) {
    const Heightfield surface = flat(4, 3, 1.5F);
    const HeightfieldView view(surface);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) {
            const Vec3 lower{i + 0.25, j + 0.25, 1.5}, upper{i + 0.75, j + 0.75, 1.5};
            const WorldRay ray = ray_to({-3, 7, 9}, lower);
            const PatchHit hit = view.look(ray);
            ASSERT_EQ(hit.part, PatchPart::Facet);
            EXPECT_EQ(hit.i, i);
            EXPECT_EQ(hit.j, j);
            EXPECT_EQ(hit.triangle, Triangle::Lower);
            EXPECT_NEAR(hit.distance, length(lower - ray.origin), 1e-12);
            expect_near(hit.normal, {0, 0, 1});
            EXPECT_EQ(view.look(ray_to({-3, 7, 9}, upper)).triangle, Triangle::Upper);
        }
    }
    // One tile and no more.
    EXPECT_EQ(view.look(ray_to({-3, 7, 9}, {4.01, 1, 1.5})).part, PatchPart::None);
    EXPECT_EQ(view.look(ray_to({-3, 7, 9}, {1, -0.01, 1.5})).part, PatchPart::None);
    EXPECT_EQ(view.look(ray_to({-3, 7, 9}, {3.999, 2.999, 1.5})).part, PatchPart::Facet);
}

TEST(HeightfieldView, LastCellsOfAPeriodicTileLeadBackToItsFirstHeights) {
    const Heightfield surface = field(2, 2, {0, 1, 0, 1});
    const HeightfieldView view(surface);
    // Cell 1 falls from height 1 to the first sample's 0.
    const PatchHit hit = view.look(WorldRay{{1.25, 0.5, 5}, {0, 0, -1}});
    ASSERT_EQ(hit.part, PatchPart::Facet);
    EXPECT_EQ(hit.i, 1);
    EXPECT_NEAR(hit.distance, 5 - 0.75, 1e-12);
    expect_near(hit.normal, normalize({1, 0, 1}));
}

TEST(HeightfieldView, FiniteSurfaceKeepsItsCells) {
    const HeightfieldView view(ridge());
    EXPECT_EQ(view.patch().cells_x(), 4);
    EXPECT_EQ(view.patch().cells_y(), 2);
    EXPECT_EQ(view.look(WorldRay{{4.1, 1, 5}, {0, 0, -1}}).part, PatchPart::None);
    EXPECT_EQ(view.look(WorldRay{{3.9, 1, 5}, {0, 0, -1}}).part, PatchPart::Facet);
}

TEST(HeightfieldView, RidgeHidesWhatIsBehind) {
    const HeightfieldView view(ridge());
    // From the left at height 1, level with the middle of the ridge's slope: seen at x = 1.5.
    const PatchHit front = view.look(WorldRay{{-5, 1, 1}, {1, 0, 0}});
    ASSERT_EQ(front.part, PatchPart::Facet);
    EXPECT_EQ(front.i, 1);
    EXPECT_NEAR(front.distance, 6.5, 1e-12);
    expect_near(front.normal, normalize({-2, 0, 1}));
    // Towards the ground behind it: the ridge is in the way. Over its top: the ground is seen.
    EXPECT_EQ(view.look(ray_to({-2, 1.1, 1.5}, {3.5, 1.1, 0})).i, 1);
    EXPECT_EQ(view.look(ray_to({1, 1.1, 5}, {3.5, 1.1, 0})).i, 3);
    // Past the top without a touch.
    EXPECT_EQ(view.look(ray_to({-4, 1, 2.2}, {2, 1, 2.1})).part, PatchPart::None);
}

TEST(HeightfieldView, RaysEnterThroughTheSides) {
    const HeightfieldView view(ridge());
    // Along y, into the open end of the valley left of the ridge, down to its ground.
    const PatchHit valley = view.look(ray_to({0.5, -4, 0.5}, {0.5, 1.75, 0}));
    ASSERT_EQ(valley.part, PatchPart::Facet);
    EXPECT_EQ(valley.i, 0);
    EXPECT_EQ(valley.j, 1);
    expect_near(valley.normal, {0, 0, 1});
    // Along y into the ridge: the cut, at the edge of the patch, in profile.
    const PatchHit cut = view.look(WorldRay{{1.75, -4, 1.4}, {0, 1, 0}});
    ASSERT_EQ(cut.part, PatchPart::Side);
    EXPECT_NEAR(cut.distance, 4, 1e-12);
    expect_near(cut.normal, {0, -1, 0});
    // Above the profile, 1.5 there, and along the slope it never meets.
    EXPECT_EQ(view.look(WorldRay{{1.75, -4, 1.6}, {0, 1, 0}}).part, PatchPart::None);
    expect_near(view.look(WorldRay{{1.75, 8, 1.4}, {0, -1, 0}}).normal, {0, 1, 0});
}

TEST(HeightfieldView, FromBelowTheBottomIsSeen) {
    const HeightfieldView view(ridge());
    const PatchHit hit = view.look(WorldRay{{3, 1, -4}, {0, 0, 1}});
    EXPECT_EQ(hit.part, PatchPart::Underside);
    EXPECT_NEAR(hit.distance, 4, 1e-12);
    expect_near(hit.normal, {0, 0, -1});
    EXPECT_EQ(view.look(WorldRay{{4.5, 1, -4}, {0, 0, 1}}).part, PatchPart::None);
    const Heightfield level = flat(4, 4);
    EXPECT_EQ(HeightfieldView(level).look(WorldRay{{3, 1, -4}, {0, 0, 1}}).part,
              PatchPart::Underside);
}

TEST(HeightfieldView, EyeBetweenPeaksAndInsideTheMatter) {
    const HeightfieldView view(ridge());
    // In the valley, below the top of the ridge, looking at the slope.
    const PatchHit slope = view.look(WorldRay{{0.5, 1, 1}, {1, 0, 0}});
    ASSERT_EQ(slope.part, PatchPart::Facet);
    EXPECT_NEAR(slope.distance, 1, 1e-12);
    const PatchHit inside = view.look(WorldRay{{2, 1, 1}, {1, 0, 0}});
    EXPECT_EQ(inside.part, PatchPart::Side);
    EXPECT_EQ(inside.distance, 0);
}

TEST(HeightfieldView, PyramidTurnsAFacetToEachSide) {
    // One peak of height 1 in the middle of 2 x 2 cells, both diagonals.
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        Heightfield surface = field(3, 3, {0, 0, 0, 0, 1, 0, 0, 0, 0}, Boundary::Finite);
        surface.diagonal = diagonal;
        const HeightfieldView view(surface);
        const auto normal_at = [&](double x, double y) {
            return view.look(WorldRay{{x, y, 3}, {0, 0, -1}}).normal;
        };
        const bool anti = diagonal == Diagonal::Anti;
        // The cell at the origin: its corner (1, 1) is the peak.
        expect_near(normal_at(0.9, 0.6), anti ? normalize({-1, -1, 1}) : normalize({0, -1, 1}));
        expect_near(normal_at(0.6, 0.9), anti ? normalize({-1, -1, 1}) : normalize({-1, 0, 1}));
        expect_near(normal_at(0.2, 0.1), anti ? Vec3{0, 0, 1} : normalize({0, -1, 1}));
        // Opposite cell: mirrored.
        expect_near(normal_at(1.1, 1.4), anti ? normalize({1, 1, 1}) : normalize({0, 1, 1}));
    }
}

TEST(HeightfieldView, PictureMapsPixelsToCells) {
    const Heightfield surface = flat(8, 8);
    const HeightfieldView view(surface);
    // Straight down from the middle; the lower to the upper edge of the picture is the tile's side.
    Camera camera = look_at({4, 4, 4}, {4, 4, 0}, 90, {0, -1, 0});
    std::array<std::array<int, 8>, 8> i{}, j{};
    asperity::Run run(2);
    std::atomic<int> rows = 0;
    EXPECT_TRUE(look_at_heightfield(
        view, camera, 8, 8, 0.5, 0.5, run,
        [&](int y, std::span<const WorldRay> rays, std::span<const PatchHit> hits) {
            ++rows;
            ASSERT_EQ(rays.size(), 8U);
            for (std::size_t x = 0; x < 8; ++x) {
                ASSERT_EQ(hits[x].part, PatchPart::Facet);
                i[static_cast<std::size_t>(y)][x] = hits[x].i;
                j[static_cast<std::size_t>(y)][x] = hits[x].j;
            }
        }));
    EXPECT_EQ(rows, 8);
    // The picture's up is -y: row 0 of the surface on top. Seen from above, x runs to the left.
    for (std::size_t y = 0; y < 8; ++y) {
        for (std::size_t x = 0; x < 8; ++x) {
            EXPECT_EQ(j[y][x], static_cast<int>(y));
            EXPECT_EQ(i[y][x], 7 - static_cast<int>(x));
        }
    }
}

TEST(HeightfieldView, PictureStops) {
    const Heightfield surface = flat(8, 8);
    const HeightfieldView view(surface);
    asperity::Run run(1);
    int rows = 0;
    EXPECT_FALSE(
        look_at_heightfield(view, look_at({4, 4, 4}, {4, 4, 0}, 60), 10, 10, 0.5, 0.5, run,
                            [&](int, std::span<const WorldRay>, std::span<const PatchHit>) {
                                if (++rows == 3) run.request_stop();
                            }));
    EXPECT_EQ(rows, 3);
}

TEST(HeightfieldView, AgreesWithAFineStepAlongEveryRay) {
    // A bumpy tile with unequal spacings, from all sides: marching in small steps finds the same.
    Heightfield surface;
    surface.nx = 7;
    surface.ny = 5;
    surface.dx = 0.5;
    surface.dy = 0.8;
    for (int k = 0; k < 35; ++k)
        surface.heights.push_back(static_cast<float>(0.5 * std::sin(2.4 * k * k)));
    const HeightfieldView view(surface);
    const Vec3 middle{1.75, 2, 0};
    int facets = 0;
    for (int k = 0; k < 400; ++k) {
        const Vec3 from = middle + 6.0 * normalize({std::cos(0.7 * k), std::sin(0.7 * k),
                                                    0.15 + 0.5 * std::abs(std::sin(1.3 * k))});
        const Vec3 to = middle + Vec3{1.5 * std::sin(3.1 * k), 1.8 * std::cos(2.3 * k), 0};
        const WorldRay ray = ray_to(from, to);
        const PatchHit hit = view.look(ray);
        // No matter before the hit, matter behind it.
        const auto inside = [&](double t) {
            const Vec3 p = ray.origin + t * ray.direction;
            if (p.x < 0 || p.y < 0 || p.x > 3.5 || p.y > 4 || p.z < view.lowest()) return false;
            const PatchHit below = view.look(WorldRay{{p.x, p.y, 10}, {0, 0, -1}});
            return p.z < 10 - below.distance;
        };
        const double end = hit.part == PatchPart::None ? 12 : hit.distance;
        for (double t = 3; t < end - 1e-6; t += 0.01) ASSERT_FALSE(inside(t)) << k << " " << t;
        if (hit.part == PatchPart::Facet) {
            ++facets;
            EXPECT_TRUE(inside(hit.distance + 1e-6)) << k;
        }
    }
    EXPECT_GT(facets, 200);
}

}  // namespace
}  // namespace asperity

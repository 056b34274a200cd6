// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/heightfield.h>

#include <asperity/core/error.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace asperity {
namespace {

// One cell seen by hand: h(0,0) = 1, h(1,0) = 3, h(0,1) = 8, h(1,1) = 2, with dx = 2, dy = 4.
//   bottom edge (3 - 1) / 2 = 1, top edge (2 - 8) / 2 = -3,
//   left edge (8 - 1) / 4 = 1.75, right edge (2 - 3) / 4 = -0.25.
Heightfield spike() {
    Heightfield s = testing::flat_grid(3, 3);
    s.dx = 2;
    s.dy = 4;
    s.heights = {1, 3, 0, 8, 2, 0, 0, 0, 0};
    return s;
}

TEST(Validate, SpacingsHaveLimits) {
    Heightfield s = spike();
    for (const double good : {kLeastSpacing, 1.0, kMostSpacing}) {
        s.dx = s.dy = good;
        EXPECT_NO_THROW(validate(s, "a"));
    }
    for (const double bad : {0.9e-15, 1.1e15, 0.0, -1.0, 1e-320, std::nan(""), HUGE_VAL}) {
        s.dx = 1;
        s.dy = bad;
        EXPECT_THROW(validate(s, "a"), Error) << bad;
        std::swap(s.dx, s.dy);
        EXPECT_THROW(validate(s, "a"), Error) << bad;
    }
}

TEST(FacetSlope, AntiDiagonalPairsBottomWithLeftAndTopWithRight) {
    Heightfield s = spike();
    s.diagonal = Diagonal::Anti;
    const Slope lower = facet_slope(s, 0, 0, Triangle::Lower);
    const Slope upper = facet_slope(s, 0, 0, Triangle::Upper);
    EXPECT_EQ(lower.x, 1);
    EXPECT_EQ(lower.y, 1.75);
    EXPECT_EQ(upper.x, -3);
    EXPECT_EQ(upper.y, -0.25);
}

TEST(FacetSlope, MainDiagonalPairsBottomWithRightAndTopWithLeft) {
    Heightfield s = spike();
    s.diagonal = Diagonal::Main;
    const Slope lower = facet_slope(s, 0, 0, Triangle::Lower);
    const Slope upper = facet_slope(s, 0, 0, Triangle::Upper);
    EXPECT_EQ(lower.x, 1);
    EXPECT_EQ(lower.y, -0.25);
    EXPECT_EQ(upper.x, -3);
    EXPECT_EQ(upper.y, 1.75);
}

TEST(FacetSlope, LastCellOfAPeriodicSurfaceReachesTheFirstSample) {
    const Heightfield s = spike();
    // Cell (2, 0): from h(2,0) = 0 to h(3,0) = h(0,0) = 1 over dx = 2.
    EXPECT_EQ(facet_slope(s, 2, 0, Triangle::Lower).x, 0.5);
    // Cell (0, 2): from h(0,2) = 0 to h(0,3) = h(0,0) = 1 over dy = 4.
    EXPECT_EQ(facet_slope(s, 0, 2, Triangle::Lower).y, 0.25);
}

TEST(FacetSlope, NormalLeansAgainstTheSlope) {
    const Vec3 n = normal_of({1, 0});
    EXPECT_NEAR(n.x, -std::sqrt(0.5), 1e-15);
    EXPECT_EQ(n.y, 0);
    EXPECT_NEAR(n.z, std::sqrt(0.5), 1e-15);
}

TEST(VisitFacets, GivesTheSlopesOfFacetSlope) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main})
        for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
            Heightfield s = spike();
            s.diagonal = diagonal;
            s.boundary = boundary;
            int facets = 0;
            for (int j = 0; j < s.cells_y(); ++j)
                visit_facets(s, j, [&](int i, Triangle t, Slope slope) {
                    EXPECT_EQ(slope.x, facet_slope(s, i, j, t).x);
                    EXPECT_EQ(slope.y, facet_slope(s, i, j, t).y);
                    ++facets;
                });
            EXPECT_EQ(facets, boundary == Boundary::Periodic ? 18 : 8);
        }
}

void expect_invalid(const Heightfield& s, const std::string& part) {
    try {
        validate(s, "some.gsf");
        ADD_FAILURE() << "accepted, expected: " << part;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidInput);
        EXPECT_EQ(e.where(), "some.gsf");
        EXPECT_NE(e.message().find(part), std::string::npos) << e.message();
    }
}

TEST(Validate, AcceptsASoundSurface) {
    EXPECT_NO_THROW(validate(spike(), "some.gsf"));
}

TEST(Validate, RefusesWhatCannotBeTraced) {
    Heightfield s = spike();
    s.nx = 1;
    expect_invalid(s, "2 x 2");
    s = spike();
    s.ny = kMaxSurfaceSide + 1;
    expect_invalid(s, "32768");
    s = spike();
    s.heights.pop_back();
    expect_invalid(s, "8 heights");
    for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
        s = spike();
        s.dy = spacing;
        expect_invalid(s, "cell size");
    }
    s = spike();
    s.heights[5] = std::numeric_limits<float>::quiet_NaN();
    expect_invalid(s, "row 1, column 2");
}

}  // namespace
}  // namespace asperity

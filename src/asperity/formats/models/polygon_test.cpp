// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/polygon.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace asperity::io::detail {
namespace {

std::vector<std::uint32_t> in_order(std::size_t count) {
    std::vector<std::uint32_t> corners(count);
    for (std::uint32_t i = 0; i < count; ++i) corners[i] = i;
    return corners;
}

/// Twice the area of all triangles, as seen from +z.
double total_area(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  const std::vector<Vec3>& p, bool* turned_alike = nullptr) {
    double sum = 0;
    for (const auto& t : triangles) {
        const Vec3 a = p[t[0]];
        const double area = cross(p[t[1]] - a, p[t[2]] - a).z;
        if (turned_alike && area < 0) *turned_alike = false;
        sum += area;
    }
    return sum;
}

// A comb with many teeth: cut as a fan it would be covered several times, with some triangles
// turned over. Its area by the shoelace formula: a bar of 20 x 1 and ten teeth of 1 x 3.
TEST(Polygon, ConcaveOnesAreCutWithoutOverlap) {
    std::vector<Vec3> p = {{0, 0, 0}, {20, 0, 0}};
    for (int i = 9; i >= 0; --i) {
        const double x = 2 * i;
        p.insert(p.end(), {{x + 2, 1, 0}, {x + 1, 1, 0}, {x + 1, 4, 0}, {x, 4, 0}});
    }
    std::vector<std::uint32_t> corners(p.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EXPECT_TRUE(cut_polygon(corners, p, triangles));
    EXPECT_EQ(triangles.size(), corners.size() - 2);
    bool turned_alike = true;
    EXPECT_NEAR(total_area(triangles, p, &turned_alike), 2 * (20 + 30), 1e-9);
    EXPECT_TRUE(turned_alike);
}

TEST(Polygon, HopelessOnesAreCutAllTheSame) {
    const std::vector<Vec3> p = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    for (const std::vector<std::uint32_t>& corners :
         {std::vector<std::uint32_t>{0, 1, 2, 3}, {0, 0, 0, 0}, {4, 4, 1, 0, 3, 2, 1}}) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        EXPECT_TRUE(cut_polygon(corners, p, triangles));
        EXPECT_EQ(triangles.size(), corners.size() - 2);
    }
}

// The shoelace formula over 2 x 5000 corners of a star, every second of which turns inwards, and a
// convex outline of 100000, in time that a user does not notice.
TEST(Polygon, LargeOnesAreCutWithoutOverlap) {
    for (const bool star : {true, false}) {
        const int count = star ? 2000 : 100000;
        std::vector<Vec3> p;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * i / count, r = star && i % 2 ? 0.9 : 1;
            p.push_back({r * std::cos(angle), r * std::sin(angle), 0});
        }
        double expected = 0;
        for (std::size_t i = 0; i < p.size(); ++i) expected += cross(p[i], p[(i + 1) % p.size()]).z;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        EXPECT_TRUE(cut_polygon(in_order(p.size()), p, triangles));
        EXPECT_EQ(triangles.size(), p.size() - 2);
        bool turned_alike = true;
        EXPECT_NEAR(total_area(triangles, p, &turned_alike), expected, 1e-9);
        EXPECT_TRUE(turned_alike);
    }
}

// Points at random: the outline crosses itself everywhere and has few ears, so that each is looked
// for among all corners. The work stops at its limit, which is said.
TEST(Polygon, TimeStaysInProportionToTheCorners) {
    std::vector<Vec3> p;
    for (int i = 0; i < 20000; ++i) p.push_back({std::sin(i * 12.9), std::sin(i * 78.2), 0});
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_FALSE(cut_polygon(in_order(p.size()), p, triangles));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_EQ(triangles.size(), p.size() - 2);
}

}  // namespace
}  // namespace asperity::io::detail

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/polygon.h>

#include <cmath>
#include <cstddef>

namespace asperity::io::detail {
namespace {

constexpr std::size_t kMostCorners = 1000;  // clipping takes their square, at worst their cube

struct Point {
    double x = 0, y = 0;
};

/// Twice the area of a triangle, positive when it turns counter-clockwise.
double area(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// Newell's normal, the mean over the polygon's sides; not a unit vector.
Vec3 newell_normal(std::span<const std::uint32_t> corners, const std::vector<Vec3f>& positions) {
    const Vec3 first = to_double(positions[corners[0]]);
    Vec3 sum{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum = sum + cross(to_double(positions[corners[i]]) - first,
                          to_double(positions[corners[i + 1]]) - first);
    }
    return sum;
}

/// The corners seen along the axis the polygon faces most, so that it turns counter-clockwise.
std::vector<Point> flattened(std::span<const std::uint32_t> corners,
                             const std::vector<Vec3f>& positions) {
    const Vec3 n = newell_normal(corners, positions);
    const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
    std::vector<Point> points;
    for (const std::uint32_t corner : corners) {
        const Vec3 p = to_double(positions[corner]);
        if (ax >= ay && ax >= az)
            points.push_back(n.x > 0 ? Point{p.y, p.z} : Point{p.z, p.y});
        else if (ay >= az)
            points.push_back(n.y > 0 ? Point{p.z, p.x} : Point{p.x, p.z});
        else
            points.push_back(n.z > 0 ? Point{p.x, p.y} : Point{p.y, p.x});
    }
    return points;
}

/// Clips ears off a ring of points until three are left.
class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points) : points_(std::move(points)) {
        for (std::size_t i = 0; i < points_.size(); ++i) ring_.push_back(i);
    }

    /// Calls cut(a, b, c) with the triangles, in places of the ring given.
    template <typename Cut>
    void clip(Cut cut) {
        std::size_t at = 0;
        while (ring_.size() > 3) {
            std::size_t tried = 0;
            while (tried < ring_.size() && !is_ear(at)) {
                at = (at + 1) % ring_.size();
                ++tried;
            }
            // A polygon without ears crosses itself: any corner will do.
            cut(before(at), ring_[at], after(at));
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
            // On from the next corner but one: a fan from one corner would make slivers.
            at = (at + 1) % ring_.size();
        }
        cut(ring_[0], ring_[1], ring_[2]);
    }

  private:
    std::size_t before(std::size_t at) const {
        return ring_[(at + ring_.size() - 1) % ring_.size()];
    }
    std::size_t after(std::size_t at) const { return ring_[(at + 1) % ring_.size()]; }

    bool is_ear(std::size_t at) const {
        const Point a = points_[before(at)], b = points_[ring_[at]], c = points_[after(at)];
        if (!(area(a, b, c) > 0)) return false;
        for (const std::size_t other : ring_) {
            if (other == before(at) || other == ring_[at] || other == after(at)) continue;
            const Point p = points_[other];
            // A corner that lies at one of the ear's own does not stand in its way.
            if (same(p, a) || same(p, b) || same(p, c)) continue;
            if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
        }
        return true;
    }

    static bool same(Point p, Point q) { return p.x == q.x && p.y == q.y; }

    std::vector<Point> points_;
    std::vector<std::size_t> ring_;
};

}  // namespace

void cut_polygon(std::span<const std::uint32_t> corners, const std::vector<Vec3f>& positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto cut = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back({corners[a], corners[b], corners[c]});
    };
    if (corners.size() == 3 || corners.size() > kMostCorners) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) cut(0, i, i + 1);
        return;
    }
    EarClipper(flattened(corners, positions)).clip(cut);
}

}  // namespace asperity::io::detail

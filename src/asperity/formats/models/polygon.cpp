// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/polygon.h>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace asperity::io::detail {
namespace {

struct Point {
    double x = 0, y = 0;
};

/// Twice the area of a triangle, positive when it turns counter-clockwise.
double area(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// Newell's normal, the mean over the polygon's sides; not a unit vector.
Vec3 newell_normal(std::span<const std::uint32_t> corners, const std::vector<Vec3>& positions) {
    const Vec3 first = positions[corners[0]];
    Vec3 sum{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum = sum + cross(positions[corners[i]] - first, positions[corners[i + 1]] - first);
    }
    return sum;
}

/// The corners seen along the axis the polygon faces most, so that it turns counter-clockwise.
std::vector<Point> flattened(std::span<const std::uint32_t> corners,
                             const std::vector<Vec3>& positions) {
    const Vec3 n = newell_normal(corners, positions);
    const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
    std::vector<Point> points;
    for (const std::uint32_t corner : corners) {
        const Vec3 p = positions[corner];
        if (ax >= ay && ax >= az)
            points.push_back(n.x > 0 ? Point{p.y, p.z} : Point{p.z, p.y});
        else if (ay >= az)
            points.push_back(n.y > 0 ? Point{p.z, p.x} : Point{p.x, p.z});
        else
            points.push_back(n.z > 0 ? Point{p.x, p.y} : Point{p.y, p.x});
    }
    return points;
}

/// Clips ears off a ring of points until three are left, by Eberly's way: an ear is a corner that
/// turns to the left and whose triangle holds no corner that does not.
class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points)
        : points_(std::move(points)), corners_(points_.size()) {
        work_left_ = kFreeWork + kWorkACorner * points_.size();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            corners_[i].before = i == 0 ? corners_.size() - 1 : i - 1;
            corners_[i].after = i + 1 == corners_.size() ? 0 : i + 1;
        }
        for (std::size_t i = 0; i < corners_.size(); ++i) note_turn(i);
    }

    /// Calls cut(a, b, c) with the triangles, in places of the ring given. False when the work
    /// allowed ran out, and the last triangles may overlap.
    template <typename Cut>
    bool clip(Cut cut) {
        std::size_t at = 0;
        for (std::size_t left = corners_.size(); left > 3; --left) {
            at = next_ear(at, left);
            const std::size_t before = corners_[at].before, after = corners_[at].after;
            cut(before, at, after);
            forget(at);
            corners_[before].after = after;
            corners_[after].before = before;
            for (const std::size_t neighbour : {before, after}) {
                note_turn(neighbour);
                corners_[neighbour].state = Ear::Unknown;
            }
            // On from the next corner but one: a fan from one corner would make slivers.
            at = corners_[after].after;
        }
        cut(corners_[at].before, at, corners_[at].after);
        return work_left_ > 0;
    }

  private:
    // Testing a triangle takes a step for each corner that could lie in it. Honest outlines of
    // thousands of corners need a fraction of this.
    static constexpr std::size_t kFreeWork = 1 << 20, kWorkACorner = 512;

    enum class Ear { Unknown, Yes, No };
    struct Corner {
        std::size_t before = 0, after = 0;
        Ear state = Ear::Unknown;
        bool in_the_way = false;
        std::size_t place = 0;  ///< in in_the_way_
    };

    /// The next corner that is an ear. A polygon without ears crosses itself: any corner will do.
    std::size_t next_ear(std::size_t at, std::size_t left) {
        for (const bool again : {false, true}) {
            for (std::size_t tried = 0; tried < left && work_left_ > 0; ++tried) {
                --work_left_;
                Ear& state = corners_[at].state;
                if (state == Ear::Unknown || again) state = is_ear(at) ? Ear::Yes : Ear::No;
                if (state == Ear::Yes) return at;
                at = corners_[at].after;
            }
        }
        return at;
    }

    bool is_ear(std::size_t at) {
        const Corner& corner = corners_[at];
        if (corner.in_the_way) return false;
        const Point a = points_[corner.before], b = points_[at], c = points_[corner.after];
        for (const std::size_t other : in_the_way_) {
            if (work_left_ > 0) --work_left_;
            if (other == corner.before || other == corner.after) continue;
            const Point p = points_[other];
            if (area(a, b, p) < 0 || area(b, c, p) < 0 || area(c, a, p) < 0) continue;
            // A corner that lies at one of the ear's own does not stand in its way.
            if (!same(p, a) && !same(p, b) && !same(p, c)) return false;
        }
        return true;
    }

    /// Whether the corner turns to the left, kept in the list of those that do not.
    void note_turn(std::size_t at) {
        Corner& corner = corners_[at];
        const bool left = area(points_[corner.before], points_[at], points_[corner.after]) > 0;
        if (left) {
            forget(at);
        } else if (!corner.in_the_way) {
            corner.in_the_way = true;
            corner.place = in_the_way_.size();
            in_the_way_.push_back(at);
        }
    }

    /// Takes the corner off that list.
    void forget(std::size_t at) {
        Corner& corner = corners_[at];
        if (!corner.in_the_way) return;
        corner.in_the_way = false;
        const std::size_t last = in_the_way_.back();
        in_the_way_[corner.place] = last;
        corners_[last].place = corner.place;
        in_the_way_.pop_back();
    }

    static bool same(Point p, Point q) { return p.x == q.x && p.y == q.y; }

    std::vector<Point> points_;
    std::vector<Corner> corners_;
    std::vector<std::size_t> in_the_way_;  ///< corners that do not turn to the left
    std::size_t work_left_ = 0;
};

}  // namespace

bool cut_polygon(std::span<const std::uint32_t> corners, const std::vector<Vec3>& positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto cut = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back({corners[a], corners[b], corners[c]});
    };
    if (corners.size() == 3) {
        cut(0, 1, 2);
        return true;
    }
    return EarClipper(flattened(corners, positions)).clip(cut);
}

std::string remark_on_rough_polygons(std::uint64_t polygons) {
    return fmt::format(
        "{} polygons have too many corners that turn inwards: triangles of theirs "
        "may overlap",
        polygons);
}

}  // namespace asperity::io::detail

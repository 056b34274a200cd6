// SPDX-License-Identifier: Apache-2.0
// The ray marching of the thesis, section 3.4, as a competitor: as printed, and tuned.
//
// From block to block (code 3.5): take the block the point lies in, fill in its four vertices, test
// its two triangles (Moeller-Trumbore, code 3.6, back faces culled); a hit moves the point there
// and mirrors the direction; no hit moves the point to the border of the block, found by
// intersecting the ray with the four lines around it (code 3.7), and just across. All in single
// precision and absolute coordinates, in units of a cell, as the shader does. A ray that leaves
// through the side of the tile enters on the other one.
//
// As printed: code 3.6 and 3.7 word for word, but that a border may be further away than 1, or
// slanted rays would never reach it. Tuned: of the four lines only the two ahead are tried, with
// one division each; the tests of a triangle are made without branches, and the division only for a
// hit.
#include "rival.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace asperity::bench {

namespace {

struct Float3 {
    float x, y, z;
};
Float3 operator+(Float3 a, Float3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Float3 operator-(Float3 a, Float3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Float3 operator*(float s, Float3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
float dot(Float3 a, Float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Float3 cross(Float3 a, Float3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

constexpr float kEpsilon = 0.000001F;
/// Blocks a ray may visit before it counts as lost.
constexpr int kMaxBlocks = 1 << 20;

/// The four vertices of a block: (0, 0), (1, 0), (0, 1), (1, 1).
struct Vertices {
    Float3 v1, v2, v3, v4;
};

/// Code 3.6: true and the distance in `t` if the ray meets the front of the triangle.
inline bool ray_triangle_intersect(Float3 origin, Float3 direction, Float3 v0, Float3 v1, Float3 v2,
                                   float& t) {
    const Float3 v0v1 = v1 - v0;
    const Float3 v0v2 = v2 - v0;
    const Float3 pvec = cross(direction, v0v2);
    const float det = dot(v0v1, pvec);
    if (det < kEpsilon) return false;
    const float inv_det = 1 / det;
    const Float3 tvec = origin - v0;
    const float u = dot(tvec, pvec) * inv_det;
    if (u < 0 || u > 1) return false;
    const Float3 qvec = cross(tvec, v0v1);
    const float v = dot(direction, qvec) * inv_det;
    if (v < 0 || v + u > 1) return false;
    t = dot(v0v2, qvec) * inv_det;
    return t > 0;
}

/// Code 3.7, but for the end of the ray: true and the distance in `t` if the ray meets the line.
inline bool ray_line_intersect(Float3 origin, Float3 direction, Float3 start, Float3 end,
                               float& t) {
    const float line_x = end.x - start.x, line_y = end.y - start.y;
    const float d = direction.x * line_y - direction.y * line_x;
    if (d == 0) return false;
    const float u = ((start.x - origin.x) * direction.y - (start.y - origin.y) * direction.x) / d;
    t = ((start.x - origin.x) * line_y - (start.y - origin.y) * line_x) / d;
    return !(u < 0 || u > 1 || t < 0);
}

/// Code 3.6, its conditions times the determinant; true and the distance in `t` if the ray meets
/// the front of the triangle.
[[gnu::always_inline]] inline bool tuned_triangle_intersect(Float3 origin, Float3 direction,
                                                            Float3 v0, Float3 v1, Float3 v2,
                                                            float& t) {
    const Float3 v0v1 = v1 - v0, v0v2 = v2 - v0;
    const Float3 pvec = cross(direction, v0v2);
    const float det = dot(v0v1, pvec);
    const Float3 tvec = origin - v0;
    const float u = dot(tvec, pvec);
    const Float3 qvec = cross(tvec, v0v1);
    const float v = dot(direction, qvec);
    const float distance = dot(v0v2, qvec);
    if (!((det >= kEpsilon) & (u >= 0) & (v >= 0) & (u + v <= det) & (distance > 0))) return false;
    t = distance / det;
    return true;
}

template <bool kTuned>
class ThesisRival : public Rival {
  public:
    explicit ThesisRival(const Heightfield& surface) : surface_(surface) {
        if (surface.diagonal != Diagonal::Anti || surface.dx != 1 || surface.dy != 1) {
            throw std::invalid_argument("the marching of the thesis knows unit cells only");
        }
        const auto [low, high] =
            std::minmax_element(surface.heights.begin(), surface.heights.end());
        bottom_ = *low;
        top_ = *high;
    }

    std::string name() const override { return kTuned ? "tuned" : "thesis"; }
    std::size_t memory_bytes() const override { return 0; }

    Tally run(const Workload& workload) const override {
        Tally tally;
        const Vec3 d = workload.direction();
        for (const StartPoint& at : workload.points) {
            Path path{{static_cast<float>(at.i) + at.u, static_cast<float>(at.j) + at.v, top_},
                      {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}};
            march(path, workload.bounces, tally);
        }
        return tally;
    }

  private:
    struct Path {
        Float3 origin, direction;
    };

    /// Code 3.5: marches until the ray leaves the box around the surface or may not be reflected
    /// any more.
    void march(Path& path, int bounces, Tally& tally) const {
        int hits = 0;
        for (int blocks = 0; blocks < kMaxBlocks; ++blocks) {
            if (path.origin.z > top_) {
                tally.add_segments(static_cast<std::uint64_t>(hits) + 1);
                tally.add_escape(cells_, path.direction.x, path.direction.y, hits);
                return;
            }
            if (path.origin.z < bottom_) break;
            // Rounding may have put a hit just outside of the tile
            const int i = std::clamp(static_cast<int>(path.origin.x), 0, surface_.nx - 1);
            const int j = std::clamp(static_cast<int>(path.origin.y), 0, surface_.ny - 1);
            const Vertices block = fill_vertices(i, j);
            if (!reflect_at_triangle(path, block)) {
                if (kTuned || !update_cell(path, i, j, block)) cross_border(path, i, j);
            } else if (++hits > bounces) {
                tally.add_segments(static_cast<std::uint64_t>(hits));
                tally.add_truncated(1, static_cast<std::uint64_t>(bounces));
                return;
            }
        }
        tally.add_segments(static_cast<std::uint64_t>(hits) + 1);
        tally.add_lost();
    }

    Vertices fill_vertices(int i, int j) const {
        const auto x = static_cast<float>(i), y = static_cast<float>(j);
        return {{x, y, surface_.at(i, j)},
                {x + 1, y, surface_.at(i + 1, j)},
                {x, y + 1, surface_.at(i, j + 1)},
                {x + 1, y + 1, surface_.at(i + 1, j + 1)}};
    }

    static bool intersect(const Path& path, Float3 v0, Float3 v1, Float3 v2, float& t) {
        return kTuned ? tuned_triangle_intersect(path.origin, path.direction, v0, v1, v2, t)
                      : ray_triangle_intersect(path.origin, path.direction, v0, v1, v2, t);
    }
    static bool reflect_at_triangle(Path& path, const Vertices& b) {
        const auto& [origin, direction] = path;
        float t = 0;
        Float3 normal{};
        if (intersect(path, b.v1, b.v2, b.v3, t)) {
            normal = cross(b.v2 - b.v1, b.v3 - b.v1);
        } else if (intersect(path, b.v2, b.v4, b.v3, t)) {
            normal = cross(b.v4 - b.v2, b.v3 - b.v2);
        } else {
            return false;
        }
        path.origin = origin + t * direction;
        path.direction = direction - (2 * dot(direction, normal) / dot(normal, normal)) * normal;
        return true;
    }

    /// To the nearest of the four lines around the block that lies ahead, and across; false if
    /// rounding hides all of them.
    bool update_cell(Path& path, int i, int j, const Vertices& b) const {
        const Float3 ends[4][2] = {{b.v1, b.v2}, {b.v2, b.v4}, {b.v4, b.v3}, {b.v3, b.v1}};
        float nearest = std::numeric_limits<float>::infinity();
        int crossed = -1;
        for (int n = 0; n < 4; ++n) {
            float t = 0;
            if (ray_line_intersect(path.origin, path.direction, ends[n][0], ends[n][1], t) &&
                t < nearest &&
                (n % 2 == 0 ? path.direction.y > 0 : path.direction.x > 0) == (n == 1 || n == 2)) {
                nearest = t;
                crossed = n;
            }
        }
        if (crossed < 0) return false;
        path.origin = path.origin + nearest * path.direction;
        if (crossed % 2 == 1)
            path.origin.x = across(i, path.direction.x, surface_.nx);
        else
            path.origin.y = across(j, path.direction.y, surface_.ny);
        return true;
    }

    /// Code 3.7 for lines along the axes: to the nearer of the two borders ahead of the ray, and
    /// into the block behind it.
    void cross_border(Path& path, int i, int j) const {
        const Float3 d = path.direction;
        const float to_x = distance_to_border(path.origin.x, d.x, i);
        const float to_y = distance_to_border(path.origin.y, d.y, j);
        const float t = std::min(to_x, to_y);
        path.origin = path.origin + t * d;
        if (to_x <= to_y) {
            path.origin.x = across(i, d.x, surface_.nx);
        } else {
            path.origin.y = across(j, d.y, surface_.ny);
        }
    }

    static float distance_to_border(float x, float d, int block) {
        if (d > 0) return (static_cast<float>(block + 1) - x) / d;
        if (d < 0) return (static_cast<float>(block) - x) / d;
        return std::numeric_limits<float>::infinity();
    }

    /// The coordinate of the border that is crossed, seen from the other side; periodic.
    static float across(int block, float d, int side) {
        constexpr float kJustBelow = 1 - 0x1p-23F;
        if (d > 0) return static_cast<float>(block + 1 == side ? 0 : block + 1);
        return static_cast<float>(block == 0 ? side : block) * kJustBelow;
    }

    const Heightfield& surface_;
    DirectionCells cells_;
    float bottom_ = 0, top_ = 0;
};

}  // namespace

std::unique_ptr<Rival> make_thesis_rival(const Heightfield& surface, bool tuned) {
    if (tuned) return std::make_unique<ThesisRival<true>>(surface);
    return std::make_unique<ThesisRival<false>>(surface);
}

}  // namespace asperity::bench

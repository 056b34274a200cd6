// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/surface_sweep.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace asperity::detail {
namespace {

/// A circle's arc is cut into steps of at most this.
constexpr double kArcStep = radians(4);
/// A line into pieces of at most this.
constexpr double kLineStep = 0.04;

Vec3f to_float(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

int steps(double whole, double step) {
    return std::max(1, static_cast<int>(std::ceil(whole / step)));
}

/// A direction in the plane of a profile.
struct Heading {
    double r = 0, y = 0;
    double length = 0;  ///< of the line it was taken from

    // Out of the body is to the left, as the outline runs from the top to the bottom.
    ProfilePoint at(double place_r, double place_y) const { return {place_r, place_y, -y, r}; }
};

Heading heading(const ProfileCorner& from, const ProfileCorner& to) {
    const double r = to.r - from.r, y = to.y - from.y;
    const double length = std::hypot(r, y);
    return {r / length, y / length, length};
}

void add_line(std::vector<ProfilePoint>& profile, const Heading& d, double r, double y,
              double length) {
    const int n = steps(length, kLineStep);
    for (int i = 0; i <= n; ++i) {
        const double s = length * i / n;
        profile.push_back(d.at(r + s * d.r, y + s * d.y));
    }
}

/// From where the line along `from` touches the circle to where that along `to` does, ends left
/// out.
void add_arc(std::vector<ProfilePoint>& profile, const Heading& from, double turn, double r,
             double y, double radius) {
    const int n = steps(std::abs(turn), kArcStep);
    const double side = turn > 0 ? 1 : -1;
    const double centre_r = r - side * radius * from.y, centre_y = y + side * radius * from.r;
    for (int i = 1; i < n; ++i) {
        const double c = std::cos(turn * i / n), s = std::sin(turn * i / n);
        const Heading d{c * from.r - s * from.y, s * from.r + c * from.y, 0};
        profile.push_back(d.at(centre_r + side * radius * d.y, centre_y - side * radius * d.r));
    }
}

}  // namespace

TriangleMesh sweep(std::string name, const SweepGrid& grid, const SweptSurface& surface) {
    const int columns = grid.columns, rows = grid.rows;
    const bool poles = grid.ends == SweepEnds::Poles;
    TriangleMesh mesh;
    mesh.name = std::move(name);
    for (int j = 0; j <= rows; ++j) {
        const bool pole = poles && (j == 0 || j == rows);
        const double v = static_cast<double>(poles ? j : j % rows) / rows;
        for (int i = 0; i <= columns; ++i) {
            const double u = pole ? 0 : static_cast<double>(i % columns) / columns;
            const SweptVertex vertex = surface(u, v);
            mesh.positions.push_back(to_float(vertex.position));
            mesh.normals.push_back(to_float(vertex.normal));
        }
    }

    const auto index = [&](int i, int j) {
        return static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(columns + 1) +
               static_cast<std::uint32_t>(i);
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = index(i, j), b = index(i, j + 1);
            const std::uint32_t c = index(i + 1, j + 1), d = index(i + 1, j);
            if (!(poles && j == rows - 1)) mesh.triangles.push_back({a, b, c});
            if (!(poles && j == 0)) mesh.triangles.push_back({a, c, d});
        }
    }
    return mesh;
}

TriangleMesh lathe(std::string name, const std::vector<ProfilePoint>& profile, int columns) {
    const int rows = static_cast<int>(profile.size()) - 1;
    return sweep(std::move(name), {columns, rows, SweepEnds::Poles}, [&](double u, double v) {
        const ProfilePoint& p = profile[static_cast<std::size_t>(std::lround(v * rows))];
        const double s = std::sin(2 * kPi * u), c = std::cos(2 * kPi * u);
        return SweptVertex{{p.r * s, p.y, p.r * c}, {p.normal_r * s, p.normal_y, p.normal_r * c}};
    });
}

std::vector<ProfilePoint> rounded_profile(const std::vector<ProfileCorner>& corners) {
    std::vector<ProfilePoint> profile;
    double start = 0;  // of the next line, from its first corner
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const Heading d = heading(corners[i], corners[i + 1]);
        double end = 0, turn = 0;
        if (i + 2 < corners.size()) {
            const Heading next = heading(corners[i + 1], corners[i + 2]);
            turn = std::atan2(d.r * next.y - d.y * next.r, d.r * next.r + d.y * next.y);
            end = corners[i + 1].radius * std::tan(0.5 * std::abs(turn));
        }
        add_line(profile, d, corners[i].r + start * d.r, corners[i].y + start * d.y,
                 d.length - start - end);
        const ProfilePoint& touch = profile.back();
        if (end > 0) add_arc(profile, d, turn, touch.r, touch.y, corners[i + 1].radius);
        start = end;
    }
    return profile;
}

}  // namespace asperity::detail

// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/launch_line.h>

#include <asperity/tracing/wide.h>

#include <algorithm>
#include <cmath>

namespace asperity {

void LaunchLine::start(const PaddedHeights& heights, double u, double v, double z, Vec3 d) {
    rounds_.clear();
    triangles_.clear();
    pitch_ = heights.pitch();
    z_ = z;
    du_ = d.x / heights.dx();
    dv_ = d.y / heights.dy();
    const double rate = d.z / (du_ * du_ + dv_ * dv_);
    k_x_ = du_ * rate;
    k_y_ = dv_ * rate;

    // The kind of edge that is crossed every second time, and vertex A of the one next to the
    // start; worked out for du >= 0, the rest is the same picture after half a turn
    const bool turned = du_ < 0;
    const double cu = std::abs(du_), cv = turned ? -dv_ : dv_;
    const bool lower = (u + v < 1) != turned;
    const int sign = turned ? -1 : 1;
    int a_x = 0, a_y = 0;
    if (cv >= 0) {
        step_x_ = step(sign, 0);
        step_y_ = step(0, sign);
        a_y = 1;
    } else if (cu + cv >= 0) {
        step_x_ = step(sign, -sign);
        step_y_ = step(sign, 0);
        a_x = lower ? 0 : 1;
        a_y = 1;
    } else {
        step_x_ = step(0, -sign);
        step_y_ = step(sign, -sign);
        a_x = 1;
        a_y = lower ? 0 : 1;
    }
    if (turned) {
        a_x = 1 - a_x;
        a_y = 1 - a_y;
    }
    a_ = {a_x, a_y, du_ * (a_y - v) - dv_ * (a_x - u), z + k_x_ * (a_x - u) + k_y_ * (a_y - v)};
}

void LaunchLine::add_triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
    // Of two of the three corners x is the same, and of two y; where these meet is the right angle
    const int x = a.x == b.x || a.x == c.x ? a.x : b.x, y = a.y == b.y || a.y == c.y ? a.y : b.y;
    const Vertex& corner = a.x == x && a.y == y ? a : b.x == x && b.y == y ? b : c;
    const bool upper = a.x + b.x + c.x < 3 * x;
    triangles_.push_back({pack_vertex(x, y), upper ? -1.0f : 1.0f, static_cast<float>(corner.w),
                          static_cast<float>(corner.z)});
}

void LaunchLine::add_round() {
    Round& r = rounds_.emplace_back();
    const Vertex step_ab = step_x_ - step_y_;
    Vertex b = a_ + step_ab;
    r.first_x = a_.x;
    r.first_y = a_.y;
    r.edges[0] = edge(r, a_, b);
    add_triangle(a_, b, a_ - step_y_);
    r.lowest_x = std::min(a_.x, b.x);
    r.lowest_y = std::min(a_.y, b.y);
    int highest_y = std::max(a_.y, b.y);
    for (int n = 0; n < kSteps; ++n) {
        // Out of the second triangle of the rhombus, over a side edge ...
        const Vertex c = a_ + step_x_;
        const bool right = c.w < 0;
        r.edges[2 * n + 1] = right ? edge(r, a_, c) : edge(r, c, b);
        add_triangle(a_, b, c);
        // ... and out of the first one of the next rhombus
        a_ = a_ + (right ? step_y_ : step_x_);
        b = a_ + step_ab;
        r.edges[2 * n + 2] = edge(r, a_, b);
        add_triangle(a_, b, a_ - step_y_);
        r.lowest_x = std::min({r.lowest_x, c.x, a_.x, b.x});
        r.lowest_y = std::min({r.lowest_y, c.y, a_.y, b.y});
        highest_y = std::max({highest_y, c.y, a_.y, b.y});
    }
    r.rows = highest_y - r.lowest_y + 1;
    // Rays go down, so they are lowest at the end; a little less for rounding to float
    const double end = (b.z * a_.w - a_.z * b.w) / (a_.w - b.w);
    r.lowest_z = static_cast<float>(end - 1e-5 * (std::abs(end) + std::abs(z_ - end)));
}

}  // namespace asperity

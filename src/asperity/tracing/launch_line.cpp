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
    u_ = u;
    v_ = v;
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
    Vertex a{};
    if (cv >= 0) {
        step_x_ = {1, 0};
        step_y_ = {0, 1};
        a = {0, 1};
    } else if (cu + cv >= 0) {
        step_x_ = {1, -1};
        step_y_ = {1, 0};
        a = lower ? Vertex{0, 1} : Vertex{1, 1};
    } else {
        step_x_ = {0, -1};
        step_y_ = {1, -1};
        a = lower ? Vertex{1, 0} : Vertex{1, 1};
    }
    if (turned) {
        step_x_ = Vertex{} - step_x_;
        step_y_ = Vertex{} - step_y_;
        a = Vertex{1, 1} - a;
    }
    a_ = a;
}

void LaunchLine::add_triangle(Vertex a, Vertex b, Vertex c) {
    const Vertex cell{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
    const bool upper = a.x + b.x + c.x - 3 * cell.x == 2;
    const Vertex corner = upper ? cell + Vertex{1, 1} : cell;
    triangles_.push_back({pack_vertex(corner.x, corner.y), upper ? -1.0f : 1.0f,
                          static_cast<float>(w(corner)), static_cast<float>(z(corner))});
}

LaunchLine::Edge LaunchLine::edge(Vertex left, Vertex right) const {
    const double w_left = w(left), w_right = w(right);
    return {index(left), index(right), static_cast<float>(w_left), static_cast<float>(w_right),
            static_cast<float>(z(left) * w_right - z(right) * w_left)};
}

void LaunchLine::add_round() {
    Round& r = rounds_.emplace_back();
    const Vertex step_ab = step_x_ - step_y_;
    Vertex b = a_ + step_ab;
    r.edges[0] = edge(a_, b);
    add_triangle(a_, b, a_ - step_y_);
    r.lowest_x = std::min(a_.x, b.x);
    r.lowest_y = std::min(a_.y, b.y);
    for (int n = 0; n < kSteps; ++n) {
        // Out of the second triangle of the rhombus, over a side edge ...
        const Vertex c = a_ + step_x_;
        const bool right = w(c) < 0;
        r.edges[2 * n + 1] = right ? edge(a_, c) : edge(c, b);
        add_triangle(a_, b, c);
        // ... and out of the first one of the next rhombus
        a_ = a_ + (right ? step_y_ : step_x_);
        b = a_ + step_ab;
        r.edges[2 * n + 2] = edge(a_, b);
        add_triangle(a_, b, a_ - step_y_);
        r.lowest_x = std::min({r.lowest_x, c.x, a_.x, b.x});
        r.lowest_y = std::min({r.lowest_y, c.y, a_.y, b.y});
    }
    // Rays go down, so they are lowest at the end; a little less for rounding to float
    const double w_a = w(a_), w_b = w(b);
    const double end = (z(a_) * -w_b + z(b) * w_a) / (w_a - w_b);
    r.lowest_z = static_cast<float>(end - 1e-5 * (std::abs(end) + std::abs(z_ - end)));
}

}  // namespace asperity

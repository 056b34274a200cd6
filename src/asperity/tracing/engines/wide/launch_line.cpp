// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/launch_line.h>

#include <asperity/tracing/engines/wide/wide.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

void LaunchLine::start(const PaddedHeights& heights, bool swapped, double u, double v, double z,
                       Vec3 d) {
    rounds_.clear();
    triangles_.clear();
    swapped_ = swapped;
    pitch_ = swapped ? kSwappedPitch : heights.pitch();
    du_ = d.x / heights.dx();
    dv_ = d.y / heights.dy();
    if (swapped) {
        std::swap(u, v);
        std::swap(du_, dv_);
    }
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
    step_ab_ = step_x_ - step_y_;
    first_ = half(step(-step_y_.x, -step_y_.y));
    second_ = half(step_x_);
    a_ = {a_x, a_y, du_ * (a_y - v) - dv_ * (a_x - u), z + k_x_ * (a_x - u) + k_y_ * (a_y - v)};
}

LaunchLine::Half LaunchLine::half(const Vertex& c) const {
    // Of two of the three corners x is the same, and of two y; where these meet is the right angle
    const Vertex a{0, 0, 0, 0}, &b = step_ab_;
    const int x = a.x == b.x || a.x == c.x ? a.x : b.x, y = a.y == b.y || a.y == c.y ? a.y : b.y;
    const Vertex& corner = a.x == x && a.y == y ? a : b.x == x && b.y == y ? b : c;
    return {corner, a.x + b.x + c.x < 3 * x};
}

LaunchLine::Edge LaunchLine::edge(const Round& round, const Vertex& left, const Vertex& right,
                                  double per_width) const {
    const auto index = [&](const Vertex& v) {
        return (v.y - round.first_y) * pitch_ + (v.x - round.first_x);
    };
    const double of_left = -right.w * per_width, of_right = left.w * per_width;
    return {index(left), index(right), static_cast<float>(of_left), static_cast<float>(of_right),
            static_cast<float>(round.z - of_left * left.z - of_right * right.z)};
}

void LaunchLine::add_round() {
    Round& r = rounds_.emplace_back();
    triangles_.resize(triangles_.size() + kEdges);
    Triangle* triangles = triangles_.data() + triangles_.size() - kEdges;
    r.first_x = r.lowest_x = a_.x;
    r.first_y = r.lowest_y = a_.y;
    r.z = a_.z;
    const auto reach = [&](const Vertex& v) {
        r.lowest_x = std::min(r.lowest_x, v.x);
        r.lowest_y = std::min(r.lowest_y, v.y);
    };
    std::int32_t cell_x[kEdges], cell_y[kEdges];  // the lowest vertex is known in the end
    const auto add = [&](int n, const Half& half, const Edge& edge) {
        const Vertex o = a_ + half.corner;
        r.edges[n] = edge;
        triangles[n] = {swapped_ ? pack_vertex(o.y, o.x) : pack_vertex(o.x, o.y),
                        half.upper ? -1.0f : 1.0f, static_cast<float>(swapped_ ? -o.w : o.w),
                        static_cast<float>(r.z - o.z)};
        cell_x[n] = o.x - (half.upper ? 1 : 0);
        cell_y[n] = o.y - (half.upper ? 1 : 0);
        r.cells[n].upper = half.upper ? 1 : 0;
    };
    const double per_ab = -1 / step_ab_.w, per_right = -1 / step_x_.w, per_left = 1 / step_y_.w;
    Vertex b = a_ + step_ab_;
    reach(b);
    reach(a_ - step_y_);
    add(0, first_, edge(r, a_, b, per_ab));
    for (int n = 1; n < kEdges; n += 2) {
        // Out of the second triangle of the rhombus, over a side edge ...
        const Vertex c = a_ + step_x_;
        const bool right = c.w < 0;
        add(n, second_, right ? edge(r, a_, c, per_right) : edge(r, c, b, per_left));
        // ... and out of the first one of the next rhombus
        a_ = a_ + (right ? step_y_ : step_x_);
        b = a_ + step_ab_;
        reach(c);
        reach(a_);
        reach(b);
        add(n + 1, first_, edge(r, a_, b, per_ab));
    }
    r.sunk = static_cast<float>(r.z - a_.z);
    for (int n = 0; n < kEdges; ++n) {
        r.cells[n].x = static_cast<std::int16_t>(cell_x[n] - r.lowest_x);
        r.cells[n].y = static_cast<std::int16_t>(cell_y[n] - r.lowest_y);
    }
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/launch_line.h>

#include <algorithm>
#include <cmath>

namespace asperity {

LaunchLine::LaunchLine(const PaddedHeights& heights, double u, double v, double z, Vec3 d)
    : pitch_(heights.pitch()),
      u_(u),
      v_(v),
      z_(z),
      du_(d.x / heights.dx()),
      dv_(d.y / heights.dy()) {
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

LaunchLine::Triangle LaunchLine::triangle(Vertex a, Vertex b, Vertex c) const {
    const Vertex cell{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
    const bool upper = a.x + b.x + c.x - 3 * cell.x == 2;
    const Vertex corner = upper ? cell + Vertex{1, 1} : cell;
    return {corner.x, corner.y, upper ? -1.0f : 1.0f, static_cast<float>(w(corner)),
            static_cast<float>(z(corner))};
}

void LaunchLine::add_round() {
    const auto f = [](double x) { return static_cast<float>(x); };
    Round r;
    const Vertex step_ab = step_x_ - step_y_;
    Vertex b = a_ + step_ab;
    r.a = index(a_);
    r.b = index(b);
    r.z_a = f(z(a_));
    r.z_b = f(z(b));
    r.w_a = f(w(a_));
    r.w_b = f(w(b));
    r.triangles[0] = triangle(a_, b, a_ - step_y_);
    r.lowest_x = std::min(a_.x, b.x);
    r.lowest_y = std::min(a_.y, b.y);
    for (int n = 0; n < kSteps; ++n) {
        const Vertex c = a_ + step_x_;
        const bool right = w(c) < 0;
        Step& step = r.steps[n];
        step.c = index(c);
        step.z_c = f(z(c));
        step.right = right ? -1 : 0;
        step.side_left = f(w(right ? a_ : c));
        step.side_right = f(w(right ? c : b));
        r.triangles[2 * n + 1] = triangle(a_, b, c);
        a_ = a_ + (right ? step_y_ : step_x_);
        b = a_ + step_ab;
        const Vertex fresh = right ? a_ : b;
        step.fresh = index(fresh);
        step.z_fresh = f(z(fresh));
        step.w_a = f(w(a_));
        step.w_b = f(w(b));
        r.triangles[2 * n + 2] = triangle(a_, b, a_ - step_y_);
        r.lowest_x = std::min({r.lowest_x, c.x, fresh.x});
        r.lowest_y = std::min({r.lowest_y, c.y, fresh.y});
    }
    // Rays go down, so they are lowest at the end; a little less for rounding to float
    const double w_a = w(a_), w_b = w(b);
    const double end = (z(a_) * -w_b + z(b) * w_a) / (w_a - w_b);
    r.lowest_z = f(end - 1e-5 * (std::abs(end) + std::abs(z_ - end)));
    rounds_.push_back(r);
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include "beam_overlay.h"

#include <cmath>

namespace asperity::studio {

namespace {

const QColor kRed(255, 48, 40, 225), kGone(255, 48, 40, 0);

constexpr double kThin = 1;  // [pixels]

void paint_window(const SceneLines& lines, const Beam& beam, Vec3 shift, const QColor& red) {
    const std::array<Vec3, 4> window = beam.window();
    for (std::size_t k = 0; k < 4; ++k)
        lines.line(window[k] + shift, window[(k + 1) % 4] + shift, SceneLines::Stroke(red, kThin));
}

void paint_box(const SceneLines& lines, const Beam& beam) {
    paint_window(lines, beam, {}, kRed);
    const std::array<Vec3, 4> window = beam.window();
    const Vec3 down = -(Beam::kReach + Beam::kDepth) * beam.to_light;
    for (const Vec3 corner : window)
        lines.line(corner, corner + down, SceneLines::Stroke(kRed, kGone, kThin));
    lines.line(window[0], window[2], SceneLines::Stroke(kRed, 0.7));
}

/// Along the middle of the beam, the way the light goes.
void paint_arrow(const SceneLines& lines, const Beam& beam) {
    const Vec3 tail = (Beam::kReach - 0.1) * beam.to_light, tip = tail - 0.75 * beam.to_light;
    const SceneLines::Stroke stroke(QColor(255, 120, 100, 235), 1.8);
    lines.line(tail, tip, stroke);
    for (const Vec3 side : {beam.right, -beam.right, beam.up, -beam.up})
        lines.line(tip, tip + 0.16 * beam.to_light + (0.06 / length(side)) * side, stroke);
}

}  // namespace

Beam::Beam(Vec3 wi, const SurfaceBody& body) : to_light(SurfaceFrame::direction_to_world(wi)) {
    const Heightfield& patch = body.view().patch();
    const double half_x = 0.5 * body.frame().scale * patch.dx * patch.cells_x();
    const double half_y = 0.5 * body.frame().scale * patch.dy * patch.cells_y();
    // Straight from above the azimuth is that of phi = 0.
    const double level = std::hypot(wi.x, wi.y);
    const double c = level > 1e-9 ? wi.x / level : 1, s = level > 1e-9 ? wi.y / level : 0;
    const Vec3 across = SurfaceFrame::direction_to_world({-s, c, 0});
    right = (std::abs(s) * half_x + std::abs(c) * half_y) * across;
    up = (std::abs(c) * half_x + std::abs(s) * half_y) * cross(to_light, across);
}

std::array<Vec3, 4> Beam::window() const {
    const Vec3 middle = kReach * to_light;
    return {middle - right - up, middle + right - up, middle + right + up, middle - right + up};
}

void paint_beam(const SceneLines& lines, const Beam& beam, double jitter) {
    constexpr std::array<std::array<double, 2>, 4> kShifts = {
        {{0.05, 0.03}, {-0.04, 0.05}, {-0.05, -0.04}, {0.03, -0.05}}};
    const auto copies = static_cast<std::size_t>(std::clamp(std::ceil(jitter) - 1, 0.0, 4.0));
    QColor faint = kRed;
    faint.setAlphaF(0.25F);
    for (std::size_t k = 0; k < copies; ++k)
        paint_window(lines, beam, kShifts[k][0] * beam.right + kShifts[k][1] * beam.up, faint);
    paint_box(lines, beam);
    paint_arrow(lines, beam);
}

}  // namespace asperity::studio

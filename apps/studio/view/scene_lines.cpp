// SPDX-License-Identifier: Apache-2.0
#include "scene_lines.h"

#include <QLineF>

#include <algorithm>

namespace asperity::studio {

namespace {

constexpr double kNear = 0.02;       // what lies closer to the eye is left out
constexpr double kPieceLength = 24;  // [pixels] that are wholly in front or behind
constexpr int kMostPieces = 24;

QColor faded(QColor colour, double share) {
    colour.setAlphaF(static_cast<float>(share * static_cast<double>(colour.alphaF())));
    return colour;
}

QColor between(const QColor& a, const QColor& b, double t) {
    const auto mixed = [t](int from, int to) {
        return static_cast<int>(from + t * (to - from) + 0.5);
    };
    return {mixed(a.red(), b.red()), mixed(a.green(), b.green()), mixed(a.blue(), b.blue()),
            mixed(a.alpha(), b.alpha())};
}

/// As it looks on black, but opaque.
QColor on_black(const QColor& colour) {
    const int a = colour.alpha();
    return {colour.red() * a / 255, colour.green() * a / 255, colour.blue() * a / 255};
}

/// Cuts off what lies behind the eye; false when nothing is left.
bool clip(const Camera& camera, Vec3& a, Vec3& b) {
    const double depth_a = asperity::dot(a - camera.position, camera.forward);
    const double depth_b = asperity::dot(b - camera.position, camera.forward);
    if (depth_a < kNear && depth_b < kNear) return false;
    const Vec3 at =
        depth_a == depth_b ? a : a + ((kNear - depth_a) / (depth_b - depth_a)) * (b - a);
    if (depth_a < kNear) a = at;
    if (depth_b < kNear) b = at;
    return true;
}

}  // namespace

void SceneLines::line(Vec3 a, Vec3 b, const Stroke& stroke) const {
    if (!clip(view_.shown_camera(), a, b)) return;
    const std::optional<QPointF> from = view_.project(a), to = view_.project(b);
    if (!from || !to) return;
    const double length = QLineF(*from, *to).length();
    // A point beside the eye lies further away on the screen than an int can say.
    const auto pieces = static_cast<int>(std::min<double>(kMostPieces, 1 + length / kPieceLength));
    const bool even = stroke.from == stroke.to;
    // Without smooth edges lines are to be fast: one pixel wide, which is 0 here, and opaque, for
    // Qt shares the work on every single line it blends among threads, at a multiple of its cost.
    const bool smooth = painter_.testRenderHint(QPainter::Antialiasing);

    // Pieces of the world, so that those on the surface are told from those above it; neighbours
    // that look alike are one stroke.
    QPointF began = *from;
    bool before = hidden(a + (0.5 / pieces) * (b - a));
    for (int k = 1; k <= pieces; ++k) {
        const bool next = k < pieces ? hidden(a + ((k + 0.5) / pieces) * (b - a)) : before;
        if (k < pieces && next == before && even) continue;
        const QPointF end =
            view_.project(a + (static_cast<double>(k) / pieces) * (b - a)).value_or(*to);
        QColor colour = between(stroke.from, stroke.to, (k - 0.5) / pieces);
        if (before) colour = faded(colour, stroke.hidden);
        if (!smooth) colour = on_black(colour);
        painter_.setPen(QPen(colour, smooth ? stroke.width : 0, Qt::SolidLine, Qt::FlatCap));
        painter_.drawLine(began, end);
        began = end;
        before = next;
    }
}

void SceneLines::polyline(const std::vector<Vec3>& points, const Stroke& stroke) const {
    for (std::size_t k = 1; k < points.size(); ++k) line(points[k - 1], points[k], stroke);
}

void SceneLines::dot(Vec3 at, const QColor& colour, double radius) const {
    const std::optional<QPointF> place = view_.project(at);
    if (!place || hidden(at)) return;
    if (!painter_.testRenderHint(QPainter::Antialiasing)) {
        painter_.fillRect(QRectF(place->x() - radius, place->y() - radius, 2 * radius, 2 * radius),
                          colour);
        return;
    }
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(colour);
    painter_.drawEllipse(*place, radius, radius);
}

}  // namespace asperity::studio

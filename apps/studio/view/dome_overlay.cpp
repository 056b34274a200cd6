// SPDX-License-Identifier: Apache-2.0
#include "dome_overlay.h"

#include "../model/dome.h"

#include <asperity/core/directions.h>

namespace asperity::studio {

namespace {

Vec3 on_dome(double theta, double phi) {
    return kDomeRadius * SurfaceFrame::direction_to_world(from_spherical(theta, phi));
}

/// An arc of equal theta or phi, in steps of at most three degrees.
void add_arc(std::vector<Vec3>& points, double theta0, double phi0, double theta1, double phi1) {
    const double turn = std::max(std::abs(theta1 - theta0), std::abs(phi1 - phi0));
    const int steps = 1 + static_cast<int>(turn / radians(3));
    for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        points.push_back(on_dome(theta0 + t * (theta1 - theta0), phi0 + t * (phi1 - phi0)));
    }
}

/// On the side of the dome that is open towards the eye nothing is drawn.
bool on_far_side(Vec3 point, Vec3 eye) {
    return dot(point, point - eye) > 0;
}

void paint_arc(const SceneLines& lines, Vec3 eye, const std::vector<Vec3>& points,
               const SceneLines::Stroke& stroke) {
    for (std::size_t k = 1; k < points.size(); ++k)
        if (on_far_side(points[k], eye)) lines.line(points[k - 1], points[k], stroke);
}

}  // namespace

std::vector<Vec3> outline_of_cell(const Detector& detector, int cell) {
    const int row = cell / detector.columns(), column = cell % detector.columns();
    const double theta0 = detector.theta_edge(row), theta1 = detector.theta_edge(row + 1);
    const double phi0 = detector.phi_edge(column), phi1 = detector.phi_edge(column + 1);
    std::vector<Vec3> points;
    add_arc(points, theta0, phi0, theta0, phi1);
    add_arc(points, theta0, phi1, theta1, phi1);
    add_arc(points, theta1, phi1, theta1, phi0);
    add_arc(points, theta1, phi0, theta0, phi0);
    return points;
}

void paint_dome_lines(const SceneLines& lines, const Viewport& view) {
    SceneLines::Stroke faint(QColor(170, 180, 205, 26), 1.0);
    SceneLines::Stroke horizon(QColor(170, 180, 205, 70), 1.0);
    const Vec3 eye = view.shown_camera().position;
    std::vector<Vec3> points;
    for (const double theta_deg : {30.0, 60.0, 90.0}) {
        points.clear();
        add_arc(points, radians(theta_deg), 0, radians(theta_deg), 2 * kPi);
        paint_arc(lines, eye, points, theta_deg == 90 ? horizon : faint);
    }
    for (int k = 0; k < 8; ++k) {
        points.clear();
        add_arc(points, 0, k * kPi / 4, 0.5 * kPi, k * kPi / 4);
        paint_arc(lines, eye, points, faint);
    }
}

void paint_cell(const SceneLines& lines, const Detector& detector, int cell) {
    const std::vector<Vec3> outline = outline_of_cell(detector, cell);
    lines.polyline(outline, SceneLines::Stroke(QColor(0, 0, 0, 170), 4));
    lines.polyline(outline, SceneLines::Stroke(QColor(255, 255, 255), 1.8));
}

}  // namespace asperity::studio

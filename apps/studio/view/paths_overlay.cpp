// SPDX-License-Identifier: Apache-2.0
#include "paths_overlay.h"

#include "../model/dome.h"
#include "beam_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::studio {

namespace {

/// From a place inside the dome to its far side.
Vec3 to_dome(Vec3 from, Vec3 direction) {
    const double middle = -dot(from, direction);
    const double square = middle * middle - dot(from, from) + kDomeRadius * kDomeRadius;
    return from + (middle + std::sqrt(std::max(0.0, square))) * direction;
}

/// Many paths are drawn thinner in ink than few, so that they stay apart.
int opacity_for(std::size_t count) {
    return std::clamp(static_cast<int>(255 * std::sqrt(60.0 / std::max<double>(1, double(count)))),
                      45, 230);
}

}  // namespace

QColor colour_of_bounce(std::size_t reflections) {
    static const std::array<QColor, kBounceColours> colours = {
        QColor(255, 250, 225), QColor(255, 196, 61), QColor(72, 202, 228), QColor(255, 92, 168),
        QColor(176, 140, 255)};
    return colours[std::min(reflections, kBounceColours - 1)];
}

std::vector<Vec3> corners_in_world(const LightPath& path, const SurfaceBody& body) {
    if (path.points.empty()) return {};
    const Heightfield& patch = body.view().patch();
    const double side_x = patch.dx * patch.cells_x(), side_y = patch.dy * patch.cells_y();
    const Vec3 first = path.points.front();
    const Vec3 tile{side_x * std::floor(first.x / side_x), side_y * std::floor(first.y / side_y),
                    0};
    std::vector<Vec3> corners;
    const Vec3 wi = SurfaceFrame::direction_to_world(path.wi);
    const Vec3 entry = body.frame().to_world(first - tile);
    corners.push_back(entry + (Beam::kReach - dot(entry, wi)) * wi);
    for (const Vec3 point : path.points) corners.push_back(body.frame().to_world(point - tile));
    if (length(path.wo) > 0)
        corners.push_back(to_dome(corners.back(), SurfaceFrame::direction_to_world(path.wo)));
    return corners;
}

void paint_paths(const SceneLines& lines, const std::vector<LightPath>& paths,
                 const SurfaceBody& body) {
    const int opacity = opacity_for(paths.size());
    for (const LightPath& path : paths) {
        const std::vector<Vec3> corners = corners_in_world(path, body);
        for (std::size_t k = 1; k < corners.size(); ++k) {
            QColor colour = colour_of_bounce(k - 1);
            colour.setAlpha(opacity);
            lines.line(corners[k - 1], corners[k], SceneLines::Stroke(colour, 1.1));
        }
        for (std::size_t k = 1; k <= path.points.size(); ++k)
            lines.dot(corners[k], colour_of_bounce(k), 1.6);
    }
}

std::size_t most_bounces(const std::vector<LightPath>& paths) {
    std::size_t most = 0;
    for (const LightPath& path : paths) most = std::max(most, path.points.size());
    return most;
}

}  // namespace asperity::studio

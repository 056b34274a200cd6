// SPDX-License-Identifier: Apache-2.0
#include "surface_body.h"

#include <asperity/core/run.h>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

/// Steepness that gentle and steep surfaces are shown with, RMS gradient.
constexpr double kGentle = 0.35, kSteep = 0.8;

double rms_gradient(const Heightfield& surface) {
    constexpr int kProbes = 256;  // cells looked at along each side, at most
    double squares = 0, count = 0;
    const int step_x = 1 + surface.cells_x() / kProbes, step_y = 1 + surface.cells_y() / kProbes;
    for (int j = 0; j < surface.cells_y(); j += step_y) {
        for (int i = 0; i < surface.cells_x(); i += step_x) {
            const Slope s = facet_slope(surface, i, j, Triangle::Lower);
            squares += s.x * s.x + s.y * s.y;
            count += 1;
        }
    }
    return std::sqrt(squares / count);
}

SurfaceBody::Pixel pixel_of(Vec3 colour) {
    const auto level = [](double c) { return static_cast<float>(255 * std::clamp(c, 0.0, 1.0)); };
    return {level(colour.x), level(colour.y), level(colour.z)};
}

Vec3 between(Vec3 a, Vec3 b, double t) {
    return (1 - t) * a + t * b;
}

}  // namespace

SurfaceBody::SurfaceBody(const Heightfield& surface)
    : view_(std::make_unique<HeightfieldView>(surface, Run().threads())),
      frame_(SurfaceFrame::of(view_->patch(), view_->lowest(), view_->highest())) {
    double sum = 0, squares = 0;
    const auto count = static_cast<double>(surface.heights.size());
    for (const float h : surface.heights) sum += static_cast<double>(h);
    mean_ = sum / count;
    for (const float h : surface.heights)
        squares += (static_cast<double>(h) - mean_) * (static_cast<double>(h) - mean_);
    spread_ = std::sqrt(squares / count);
    const double steepness = rms_gradient(surface);
    if (steepness > 0) relief_ = std::clamp(steepness, kGentle, kSteep) / steepness;
}

SurfaceBody::Pixel SurfaceBody::colour(const WorldRay& ray, const PatchHit& hit,
                                       SurfaceShading shading,
                                       const std::optional<Vec3>& metal) const {
    // The matter itself stays in the background: slate, lighter towards a viewer in front of it.
    if (hit.part != PatchPart::Facet) {
        const double facing = std::abs(dot(hit.normal, ray.direction));
        return pixel_of((0.35 + 0.65 * facing) * Vec3{0.20, 0.22, 0.26});
    }
    const Vec3 n = hit.normal;
    if (shading == SurfaceShading::Normals)
        return pixel_of({std::abs(n.x), std::abs(n.z), std::abs(n.y)});
    return metal ? polished(ray, hit, *metal) : clay(ray, hit);
}

/// A relief in the light of a low warm sun and a wide cool sky: clay, cool in the hollows, warm on
/// the heights, with the soft gloss of its facets.
SurfaceBody::Pixel SurfaceBody::clay(const WorldRay& ray, const PatchHit& hit) const {
    const Vec3 sun = normalize({-0.35, -0.80, 0.62}), fill = normalize({0.60, 0.55, 0.40});
    const Vec3 n = normalize({relief_ * hit.normal.x, relief_ * hit.normal.y, hit.normal.z});
    const double height = ray.origin.z + hit.distance * ray.direction.z;
    const double level =
        spread_ > 0 ? std::clamp(0.5 + (height - mean_) / (4 * spread_), 0.0, 1.0) : 0.5;
    const Vec3 clay = between({0.30, 0.42, 0.62}, {1.00, 0.90, 0.74}, level);

    const double sunlight = std::max(0.0, dot(n, sun));
    const double filling = std::max(0.0, dot(n, fill));
    const double sky = (0.5 + 0.5 * n.z) * (0.55 + 0.45 * level);  // hollows see less of it
    const Vec3 halfway = normalize(sun - ray.direction);
    const double gloss = std::pow(std::max(0.0, dot(n, halfway)), 24.0);
    const Vec3 light = sunlight * Vec3{0.86, 0.80, 0.70} + filling * Vec3{0.08, 0.11, 0.18} +
                       sky * Vec3{0.24, 0.28, 0.36};
    return pixel_of(Vec3{clay.x * light.x, clay.y * light.y, clay.z * light.z} +
                    (0.22 * gloss) * Vec3{1.0, 0.95, 0.85});
}

/// Metal mirrors a wide sky over dark land, the glow of a sun low behind the eye's shoulder, and is
/// darker in the hollows.
SurfaceBody::Pixel SurfaceBody::polished(const WorldRay& ray, const PatchHit& hit,
                                         Vec3 metal) const {
    const Vec3 n = normalize({relief_ * hit.normal.x, relief_ * hit.normal.y, hit.normal.z});
    const Vec3 mirrored = ray.direction - (2 * dot(ray.direction, n)) * n;
    const Vec3 sun = normalize({0.35, -0.55, 0.75});
    const double height = ray.origin.z + hit.distance * ray.direction.z;
    const double level =
        spread_ > 0 ? std::clamp(0.5 + (height - mean_) / (4 * spread_), 0.0, 1.0) : 0.5;

    const double up = std::clamp(0.5 + 0.75 * mirrored.z, 0.0, 1.0);
    const double sky = 0.06 + 0.50 * up * up;
    const double glow =
        1.1 * std::pow(std::max(0.0, dot(mirrored, sun)), 10.0) + 0.35 * std::max(0.0, dot(n, sun));
    const double light = (sky + glow) * (0.55 + 0.55 * level);
    const auto shown = [light](double reflectance) {
        // Deeper than one reflection: polished metal is seen in its own light
        const double c = light * std::pow(reflectance, 1.7);
        return std::pow(c / (1 + 0.25 * c), 1 / 2.2);
    };
    return pixel_of({shown(metal.x), shown(metal.y), shown(metal.z)});
}

bool SurfaceBody::hides(Vec3 eye, Vec3 point) const {
    const Vec3 from = frame_.to_surface(eye), to = frame_.to_surface(point);
    // Above the highest point nothing is in the way; most of what is asked for lies there.
    if (from.z >= view_->highest() && to.z >= view_->highest()) return false;
    const double distance = length(to - from);
    if (!(distance > 0)) return false;
    const PatchHit hit = view_->look(WorldRay{from, (1 / distance) * (to - from)});
    // Points of paths lie on facets: within a cell of the point, nothing is in front of it.
    const double nearly = std::max(view_->patch().dx, view_->patch().dy);
    return hit.part != PatchPart::None && hit.distance < distance - nearly;
}

}  // namespace asperity::studio

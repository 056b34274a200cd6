// SPDX-License-Identifier: Apache-2.0
#include "pixel_guides.h"

#include "picture_rows.h"

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace asperity::studio {

namespace {

constexpr std::array kPlanes = {&PixelGuides::nx,   &PixelGuides::ny, &PixelGuides::nz,
                                &PixelGuides::px,   &PixelGuides::py, &PixelGuides::pz,
                                &PixelGuides::reach};

/// Traces pixels of a row and notes what they meet.
class GuideRays {
  public:
    GuideRays(const TracedModel& model, const Camera& camera, int width, int height, double split)
        : model_(model),
          rays_(camera, width, height),
          pixel_(static_cast<float>(2 * std::tan(0.5 * radians(camera.fov_deg)) / height)),
          split_(split * width) {
        guides.width = width;
        guides.height = height;
        for (const auto plane : kPlanes)
            (guides.*plane)
                .resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }

    void trace(int y, std::span<const int> columns) {
        std::vector<WorldRay> rays;
        rays.reserve(columns.size());
        std::vector<Hit> hits(columns.size());
        for (const int x : columns) rays.push_back(rays_.at(x + 0.5, y + 0.5));
        model_.intersect(rays, hits);
        for (std::size_t k = 0; k < hits.size(); ++k)
            if (hits[k].found()) put(columns[k], y, rays[k], hits[k]);
    }

    PixelGuides guides;

  private:
    void put(int x, int y, const WorldRay& ray, const Hit& hit) {
        // Places beyond the split are moved away from those before it
        constexpr double kFarApart = 100;
        const SurfacePoint point = model_.surface(ray, hit);
        const Vec3 n = point.shading_normal;
        const Vec3 p = point.position + (x + 0.5 >= split_ ? kFarApart : 0.0) * n;
        const std::size_t k = pixel_index(guides.width, x, y);
        const auto single = [](double c) { return static_cast<float>(c); };
        guides.nx[k] = single(n.x);
        guides.ny[k] = single(n.y);
        guides.nz[k] = single(n.z);
        guides.px[k] = single(p.x);
        guides.py[k] = single(p.y);
        guides.pz[k] = single(p.z);
        // Curved surfaces leave their tangent plane by less than the way along it
        guides.reach[k] = 2 * pixel_ * hit.distance;
    }

    const TracedModel& model_;
    PixelRays rays_;
    float pixel_;
    double split_;
};

/// Whether what lies between two pixels may be taken for their mean; nothing is, between nothing.
bool of_one_surface(const PixelGuides& g, std::size_t a, std::size_t b) {
    if (!(g.reach[a] > 0) || !(g.reach[b] > 0)) return g.reach[a] == g.reach[b];
    const float alike = g.nx[a] * g.nx[b] + g.ny[a] * g.ny[b] + g.nz[a] * g.nz[b];
    const float off = g.nx[a] * (g.px[b] - g.px[a]) + g.ny[a] * (g.py[b] - g.py[a]) +
                      g.nz[a] * (g.pz[b] - g.pz[a]);
    return alike > 0.98F && std::abs(off) < 0.5F * g.reach[a];
}

/// Sets a pixel between traced ones to their mean, where they are of one surface.
bool interpolate(PixelGuides& guides, int x, int y) {
    const int right = x + x % 2, below = y + y % 2;
    if (right >= guides.width || below >= guides.height) return false;
    const std::array<std::size_t, 4> at = {
        pixel_index(guides.width, x - x % 2, y - y % 2), pixel_index(guides.width, right, below),
        pixel_index(guides.width, right, y - y % 2), pixel_index(guides.width, x - x % 2, below)};
    // Two, each of them twice, or four
    const bool four = x % 2 == 1 && y % 2 == 1;
    if (!of_one_surface(guides, at[0], at[1])) return false;
    if (four && !(of_one_surface(guides, at[0], at[2]) && of_one_surface(guides, at[0], at[3])))
        return false;
    if (!(guides.reach[at[0]] > 0)) return true;
    const std::size_t k = pixel_index(guides.width, x, y);
    for (const auto plane : kPlanes) {
        std::vector<float>& of = guides.*plane;
        of[k] = 0.25F * (of[at[0]] + of[at[1]] + of[at[2]] + of[at[3]]);
    }
    return true;
}

}  // namespace

PixelGuides look_for_guides(const TracedModel& model, const Camera& camera, int width, int height,
                            double split, Run& run) {
    GuideRays rays(model, camera, width, height, split);
    std::vector<int> columns;
    for (int x = 0; x < width; ++x) columns.push_back(x);
    each_row(height, run, [&](int y) { rays.trace(y, columns); });
    return std::move(rays.guides);
}

PixelGuides guess_guides(const TracedModel& model, const Camera& camera, int width, int height,
                         double split, Run& run) {
    GuideRays rays(model, camera, width, height, split);
    std::vector<int> columns;
    for (int x = 0; x < width; x += 2) columns.push_back(x);
    each_row((height + 1) / 2, run, [&](int row) { rays.trace(2 * row, columns); });
    each_row(height, run, [&](int y) {
        std::vector<int> left;
        for (int x = y % 2 == 0 ? 1 : 0; x < width; x += y % 2 == 0 ? 2 : 1)
            if (!interpolate(rays.guides, x, y)) left.push_back(x);
        rays.trace(y, left);
    });
    return std::move(rays.guides);
}

}  // namespace asperity::studio

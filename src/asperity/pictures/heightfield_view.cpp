// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/heightfield_view.h>

#include <asperity/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace asperity {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// One tile with an edge all round.
Heightfield cut_out(const Heightfield& surface) {
    if (surface.boundary == Boundary::Finite) return surface;
    Heightfield patch;
    patch.nx = surface.nx + 1;
    patch.ny = surface.ny + 1;
    patch.dx = surface.dx;
    patch.dy = surface.dy;
    patch.diagonal = surface.diagonal;
    patch.boundary = Boundary::Finite;
    patch.unit = surface.unit;
    patch.heights.reserve(static_cast<std::size_t>(patch.nx) * static_cast<std::size_t>(patch.ny));
    for (int j = 0; j < patch.ny; ++j)
        for (int i = 0; i < patch.nx; ++i) patch.heights.push_back(surface.at(i, j));
    return patch;
}

/// The part of a ray between two parallel planes.
struct Slab {
    double enter = -kNever, leave = kNever;  ///< empty when leave < enter
};
Slab slab(double from, double direction, double low, double high) {
    if (direction == 0) return from >= low && from <= high ? Slab{} : Slab{kNever, -kNever};
    const double a = (low - from) / direction, b = (high - from) / direction;
    return {std::min(a, b), std::max(a, b)};
}

/// The cell of a place along an axis, in cells from the first: the last cell holds its upper edge.
struct Place {
    std::int32_t cell = 0;
    double within = 0;
};
Place place_of(double position, int cells) {
    const double held = std::clamp(position, 0.0, static_cast<double>(cells));
    const auto cell = std::min(cells - 1, static_cast<int>(held));
    return {cell, held - cell};
}

double height_at(const Heightfield& patch, const Ray& ray) {
    const double h00 = static_cast<double>(patch.at(ray.i, ray.j)),
                 h10 = static_cast<double>(patch.at(ray.i + 1, ray.j));
    const double h01 = static_cast<double>(patch.at(ray.i, ray.j + 1));
    const double h11 = static_cast<double>(patch.at(ray.i + 1, ray.j + 1));
    const double u = ray.u, v = ray.v;
    if (patch.diagonal == Diagonal::Anti)
        return u + v < 1 ? h00 + (h10 - h00) * u + (h01 - h00) * v
                         : h11 + (h01 - h11) * (1 - u) + (h10 - h11) * (1 - v);
    return u > v ? h00 + (h10 - h00) * u + (h11 - h10) * v
                 : h00 + (h11 - h01) * u + (h01 - h00) * v;
}

}  // namespace

HeightfieldView::HeightfieldView(const Heightfield& surface, int threads)
    : patch_(cut_out(surface)),
      lowest_(static_cast<double>(*std::min_element(patch_.heights.begin(), patch_.heights.end()))),
      tracer_(patch_, threads) {}

PatchHit HeightfieldView::enter(const WorldRay& ray, Ray& start) const {
    const Vec3 o = ray.origin, d = ray.direction;
    const Slab x = slab(o.x, d.x, 0, patch_.dx * patch_.cells_x());
    const Slab y = slab(o.y, d.y, 0, patch_.dy * patch_.cells_y());
    const Slab z = slab(o.z, d.z, lowest_, highest());
    const double t = std::max({0.0, x.enter, y.enter, z.enter});
    if (!(t <= std::min({x.leave, y.leave, z.leave}))) return {};

    if (z.enter == t && d.z > 0)
        return {PatchPart::Underside, Triangle::Lower, 0, 0, t, Vec3{0, 0, -1}};
    const Place at_x = place_of((o.x + t * d.x) / patch_.dx, patch_.cells_x());
    const Place at_y = place_of((o.y + t * d.y) / patch_.dy, patch_.cells_y());
    start = {at_x.cell, at_y.cell, at_x.within, at_y.within, o.z + t * d.z, d, -1};
    PatchHit hit{PatchPart::Facet, Triangle::Lower, 0, 0, t, Vec3{}};
    if (z.enter == t && d.z < 0) return hit;  // over the top
    if (start.z >= height_at(patch_, start)) return hit;
    hit.part = PatchPart::Side;
    hit.normal = t == 0         ? -d  // the eye is inside
                 : t == x.enter ? Vec3{d.x > 0 ? -1.0 : 1.0, 0, 0}
                                : Vec3{0, d.y > 0 ? -1.0 : 1.0, 0};
    return hit;
}

void HeightfieldView::look(std::span<const WorldRay> rays, std::span<PatchHit> hits) const {
    constexpr std::size_t kBatch = 64;
    std::array<Ray, kBatch> starts;
    std::array<RayEnd, kBatch> ends;
    std::array<std::size_t, kBatch> whose;
    std::size_t count = 0;
    const auto trace = [&] {
        tracer_.trace(std::span(starts).first(count), std::span(ends).first(count));
        for (std::size_t k = 0; k < count; ++k) {
            PatchHit& hit = hits[whose[k]];
            if (ends[k] != RayEnd::Hit) {
                hit = {};
                continue;
            }
            const Ray& at = starts[k];
            const Vec3 point{(at.i + at.u) * patch_.dx, (at.j + at.v) * patch_.dy, at.z};
            const WorldRay& ray = rays[whose[k]];
            hit = {PatchPart::Facet,
                   static_cast<Triangle>(at.facet),
                   at.i,
                   at.j,
                   dot(point - ray.origin, ray.direction),
                   tracer_.normal(at)};
        }
        count = 0;
    };
    for (std::size_t k = 0; k < rays.size(); ++k) {
        hits[k] = enter(rays[k], starts[count]);
        if (hits[k].part != PatchPart::Facet) continue;
        whose[count++] = k;
        if (count == kBatch) trace();
    }
    trace();
}

PatchHit HeightfieldView::look(const WorldRay& ray) const {
    PatchHit hit;
    look(std::span(&ray, 1), std::span(&hit, 1));
    return hit;
}

bool look_at_heightfield(const HeightfieldView& view, const Camera& camera, int width, int height,
                         double offset_x, double offset_y, Run& run, const RowOfHits& take) {
    const PixelRays pixels(camera, width, height);
    const auto row = [&](std::size_t k) {
        if (run.stop_requested()) return;
        const int y = static_cast<int>(k);
        std::vector<WorldRay> rays;
        rays.reserve(static_cast<std::size_t>(width));
        for (int x = 0; x < width; ++x) rays.push_back(pixels.at(x + offset_x, y + offset_y));
        std::vector<PatchHit> hits(rays.size());
        view.look(rays, hits);
        take(y, rays, hits);
    };
    parallel_for(static_cast<std::size_t>(height), run.threads(), row);
    return !run.stop_requested();
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/wide_tracer.h>

#include <asperity/tracing/engines/wide/wide_kernels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace asperity {

namespace {

/// Horizontal part given to the vertical rays of a wave that holds others too.
constexpr float kAlmostStraight = 1e-12f;

}  // namespace

PathWave::PathWave() : work_(std::make_unique<PathWaveWork>()) {}
PathWave::~PathWave() = default;
PathWave::PathWave(PathWave&&) noexcept = default;
PathWave& PathWave::operator=(PathWave&&) noexcept = default;

WideTracer::WideTracer(const Heightfield& surface, Run& run)
    : surface_cells_x_(surface.cells_x()),
      surface_cells_y_(surface.cells_y()),
      heights_(surface, run),
      horizon_(heights_, run),
      grid_(heights_, horizon_) {
    grid_.gathers_pay = gathers_pay();
}

std::size_t WideTracer::memory_bytes() const {
    return heights_.memory_bytes() + horizon_.memory_bytes();
}

void WideTracer::clear(PathWave& wave) const {
    wave.points.count = wave.escapes.count = wave.edge_count = wave.stuck_count = wave.counted = 0;
    wave.work_->launched.count = 0;
}

bool WideTracer::lines_along_x(const Vec3& d) const {
    return LaunchLine::along_x(d, heights_.dx(), heights_.dy());
}

void WideTracer::start(LaunchLine& line, double offset, const Vec3& d) const {
    const double top = double{heights_.max_height()};
    if (lines_along_x(d))
        line.start(heights_, true, 0, offset, top, d);
    else
        line.start(heights_, false, offset, 0, top, d);
}

bool WideTracer::launch(LaunchLine& line, LaunchStripe& stripe, const CountedFacets& known,
                        PathWave& wave) const {
    return launch_in_lines(grid_, heights_, line, stripe, known, kWave, wave.work_->launched,
                           wave.counted);
}

void WideTracer::launch_down(double u, double v, const LaunchedRow& row, const CountedFacets& known,
                             PathWave& wave) const {
    launch_straight_down(grid_, static_cast<float>(u), static_cast<float>(v), row, known,
                         wave.points, wave.counted);
}

std::size_t WideTracer::launched(const PathWave& wave) const {
    return wave.points.count + wave.work_->launched.count;
}

void WideTracer::land(const LaunchLine& line, const Vec3& direction, PathWave& wave) const {
    land_parallel(grid_, line, wave.work_->launched, direction, wave.points);
}

void WideTracer::place(const Ray& ray, std::size_t k, PathWave& wave) const {
    const bool upper = ray.facet >= 0        ? ray.facet == static_cast<int>(Triangle::Upper)
                       : heights_.mirrored() ? ray.u <= ray.v
                                             : ray.u + ray.v >= 1;
    const int corner = upper ? 1 : 0, step = upper ? -1 : 1;
    const int i = heights_.mirrored() ? heights_.cells_x() - 1 - ray.i : ray.i;
    const double u = heights_.mirrored() ? 1 - ray.u : ray.u;
    const int x = i + corner, y = ray.j + corner;
    FacetPoints& p = wave.points;
    p.corner[k] = pack_vertex(x - grid_.middle_x, y - grid_.middle_y);
    p.side[k] = static_cast<float>(step);
    p.u[k] = static_cast<float>(upper ? 1 - u : u);
    p.v[k] = static_cast<float>(upper ? 1 - ray.v : ray.v);
    p.height[k] = heights_.at(x, y);
    p.rise_u[k] = heights_.at(x + step, y) - p.height[k];
    p.rise_v[k] = heights_.at(x, y + step) - p.height[k];
    wave.work_->start_height[k] = static_cast<float>(ray.z - double{heights_.base()});
}

void WideTracer::set_direction(Directions& to, std::size_t k, Vec3 d, std::int32_t path) const {
    const float x = static_cast<float>(mirrored() ? -d.x : d.x), y = static_cast<float>(d.y);
    to.x[k] = x;
    to.y[k] = y;
    to.z[k] = static_cast<float>(d.z);
    to.level[k] = std::sqrt(x * x + y * y);
    to.path[k] = path;
}

void WideTracer::enter(std::span<const Ray> rays, PathWave& wave) const {
    clear(wave);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        set_direction(wave.arriving(), k, rays[k].direction, static_cast<std::int32_t>(k));
        place(rays[k], k, wave);
    }
    wave.points.count = rays.size();
    fall(wave);
}

/// Moves paths from over wave.points to their first facets.
void WideTracer::fall(PathWave& wave) const {
    // Straight down there is no way to go: they are there
    Directions& d = wave.arriving();
    const std::size_t count = wave.points.count;
    bool straight = true;
    for (std::size_t k = 0; k < count; ++k) straight = straight && !(d.level[k] > 0);
    if (straight) {
        FacetPoints& p = wave.points;
        for (std::size_t k = 0; k < count; ++k) {
            p.x[k] = d.x[k];
            p.y[k] = d.y[k];
            p.z[k] = d.z[k];
            p.path[k] = d.path[k];
        }
        return;
    }
    for (std::size_t k = 0; k < count; ++k)
        if (!(d.level[k] > 0)) d.x[k] = d.level[k] = kAlmostStraight;
    walk(wave, true);
}

void WideTracer::leave(PathWave& wave) const {
    wave.escapes.count = wave.edge_count = wave.stuck_count = 0;
    wave.turn();
    // Where few are free, the first look around is soon enough
    if (grid_.horizon_pays) part_free(grid_, wave.points, wave.arriving(), wave.escapes);
    walk(wave, false);
}

void WideTracer::walk(PathWave& wave, bool from_above) const {
    constexpr int kMostRounds = Tracer::kMaxCrossings / (2 * kCellsPerRound);
    PathWaveWork& work = *wave.work_;
    work.raw.count = work.leavers.count = 0;
    asperity::walk(grid_, wave.points, wave.arriving(), from_above ? &work.start_height : nullptr,
                   kMostRounds, work.walkers, work.raw, work.leavers);
    for (std::size_t k = 0; k < work.walkers.count; ++k)
        wave.stuck[wave.stuck_count++] =
            wave.arriving().path[static_cast<std::size_t>(work.walkers.ray[k])];
    release(grid_, work.leavers, wave.arriving(), wave.escapes);
    if (!heights_.periodic()) settle_edges(wave);
    asperity::land(grid_, work.raw, wave.arriving(), wave.points);
}

void WideTracer::settle_edges(PathWave& wave) const {
    // A path over a finite patch is out when it passes the side above the highest point
    const auto until_side = [](double at, double direction, double first, double last) {
        return direction > 0   ? (last - at) / direction
               : direction < 0 ? (first - at) / direction
                               : std::numeric_limits<double>::infinity();
    };
    Escapes& e = wave.escapes;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < e.count; ++k) {
        const double du = static_cast<double>(e.x[k]) / heights_.dx(),
                     dv = static_cast<double>(e.y[k]) / heights_.dy();
        const double t = std::min(until_side(static_cast<double>(e.at_x[k]), du, -grid_.middle_x,
                                             heights_.cells_x() - grid_.middle_x),
                                  until_side(static_cast<double>(e.at_y[k]), dv, -grid_.middle_y,
                                             heights_.cells_y() - grid_.middle_y));
        const bool over =
            e.z[k] > 0 && static_cast<double>(e.at_z[k]) + static_cast<double>(e.z[k]) * t >=
                              static_cast<double>(heights_.max_height());
        if (!over) {
            wave.edge[wave.edge_count++] = e.path[k];
            continue;
        }
        e.x[kept] = e.x[k];
        e.y[kept] = e.y[k];
        e.z[kept] = e.z[k];
        e.path[kept++] = e.path[k];
    }
    e.count = kept;
}

void WideTracer::trace(std::span<Ray> rays, std::span<RayEnd> ends) const {
    PathWave wave;
    for (std::size_t first = 0; first < rays.size(); first += kWave) {
        const std::size_t count = std::min(kWave, rays.size() - first);
        std::vector<std::size_t> free, standing;
        for (std::size_t k = first; k < first + count; ++k) {
            const bool above =
                rays[k].facet < 0 && rays[k].direction.z >= 0 && rays[k].z >= double{max_height()};
            if (above)
                ends[k] = RayEnd::Escaped;
            else
                (rays[k].facet < 0 ? free : standing).push_back(k);
        }
        trace_some(free, false, rays, ends, wave);
        trace_some(standing, true, rays, ends, wave);
    }
}

void WideTracer::trace_some(std::span<const std::size_t> chosen, bool on_facet, std::span<Ray> rays,
                            std::span<RayEnd> ends, PathWave& wave) const {
    clear(wave);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const Ray& ray = rays[chosen[k]];
        set_direction(on_facet ? wave.leaving() : wave.arriving(), k, ray.direction,
                      static_cast<std::int32_t>(k));
        place(ray, k, wave);
    }
    wave.points.count = chosen.size();
    if (on_facet)
        leave(wave);
    else
        fall(wave);

    const auto mark = [&](std::int32_t path, RayEnd end) {
        const std::size_t k = chosen[static_cast<std::size_t>(path)];
        ends[k] = end;
        rays[k].facet = -1;
    };
    for (std::size_t k = 0; k < wave.escapes.count; ++k)
        mark(wave.escapes.path[k], RayEnd::Escaped);
    for (std::size_t k = 0; k < wave.edge_count; ++k) mark(wave.edge[k], RayEnd::Edge);
    for (std::size_t k = 0; k < wave.stuck_count; ++k) mark(wave.stuck[k], RayEnd::Stuck);
    for (std::size_t k = 0; k < wave.points.count; ++k) {
        const std::size_t ray = chosen[static_cast<std::size_t>(wave.points.path[k])];
        ends[ray] = RayEnd::Hit;
        stand(wave.points, k, rays[ray]);
    }
}

void WideTracer::stand(const FacetPoints& p, std::size_t k, Ray& ray) const {
    const bool upper = p.side[k] < 0;
    const double u = static_cast<double>(p.u[k]), v = static_cast<double>(p.v[k]);
    const int i = vertex_x(p.corner[k]) + grid_.middle_x - (upper ? 1 : 0);
    ray.i = mirrored() ? heights_.cells_x() - 1 - i : i;
    ray.j = vertex_y(p.corner[k]) + grid_.middle_y - (upper ? 1 : 0);
    ray.u = upper != mirrored() ? 1 - u : u;
    ray.v = upper ? 1 - v : v;
    ray.z = static_cast<double>(p.height[k]) + static_cast<double>(p.rise_u[k]) * u +
            static_cast<double>(p.rise_v[k]) * v + double{heights_.base()};
    ray.facet = static_cast<std::int32_t>(upper ? Triangle::Upper : Triangle::Lower);
    if (!periodic()) return;
    // Corners on the border belong to the next tile; a tile of ours may be several of the surface
    const auto wrap = [](int index, int count) { return ((index % count) + count) % count; };
    ray.i = wrap(ray.i, surface_cells_x_);
    ray.j = wrap(ray.j, surface_cells_y_);
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/tracing/engines/plain/tracer.h>
#include <asperity/tracing/engines/wide/horizon.h>
#include <asperity/tracing/engines/wide/launch_line.h>
#include <asperity/tracing/engines/wide/padded_heights.h>
#include <asperity/tracing/engines/wide/wide.h>
#include <asperity/tracing/engines/wide/wide_grid.h>
#include <asperity/tracing/engines/wide/wide_launch.h>

#include <cstdint>
#include <memory>
#include <span>

namespace asperity {

struct PathWaveWork;

/// The paths of one thread, at most kWave, on their way from facet to facet. Filled by WideTracer;
/// directions are in its frame: x is mirrored if WideTracer::mirrored().
class PathWave {
  public:
    PathWave();
    ~PathWave();
    PathWave(PathWave&&) noexcept;
    PathWave& operator=(PathWave&&) noexcept;

    /// The directions paths came with, and those the paths at `points` go on with.
    Directions& arriving() { return directions_[turn_]; }
    Directions& leaving() { return directions_[1 - turn_]; }
    std::size_t counted = 0;      ///< launched rays onto facets that are only counted
    FacetPoints points;           ///< paths that have met a facet
    Escapes escapes;              ///< paths that are free, by direction
    std::size_t edge_count = 0;   ///< paths lost through the side of a finite patch,
    PerPath<std::int32_t> edge;   ///< by Directions::path
    std::size_t stuck_count = 0;  ///< paths that never ended,
    PerPath<std::int32_t> stuck;  ///< by Directions::path

  private:
    friend class WideTracer;
    void turn() { turn_ = 1 - turn_; }

    Directions directions_[2];
    int turn_ = 0;
    std::unique_ptr<PathWaveWork> work_;
};

/// Follows many paths at once, in the lanes of the widest vectors the processor has. Same answers
/// as Tracer, its readable twin, but for paths that pass an edge within rounding of single
/// precision; the same bits on every processor and for every number of lanes.
///
/// A wave goes: launch or enter, then as long as there are points: reflect (not our business),
/// leave.
class WideTracer {
  public:
    /// Copies the heights and builds the horizons: memory see memory_bytes(), time about 60 ns a
    /// sample and thread. Calls run.advance() with the cells whose horizons are done, to
    /// surface.cell_count() of them; begin() and end() are the caller's. Throws Error(Stopped)
    /// within 100 ms once the run is to be stopped.
    WideTracer(const Heightfield& surface, Run& run);
    WideTracer(const Heightfield& surface, Run&& run) : WideTracer(surface, run) {}
    WideTracer(const Heightfield& surface, int threads) : WideTracer(surface, Run(threads)) {}

    float max_height() const { return heights_.base() + heights_.max_height(); }
    bool mirrored() const { return heights_.mirrored(); }
    bool periodic() const { return heights_.periodic(); }
    /// Cells of a tile of ours, which may be several tiles of the surface.
    int cells_x() const { return heights_.cells_x(); }
    int cells_y() const { return heights_.cells_y(); }
    const PaddedHeights& heights() const { return heights_; }
    /// The surface as the kernels see it.
    const WideGrid& grid() const { return grid_; }
    /// Says how memory is read, in place of what was measured; changes no result. For tests.
    void let_gathers_pay(bool pay) { grid_.gathers_pay = pay; }
    std::size_t memory_bytes() const;

    /// Forgets all paths of the wave.
    void clear(PathWave& wave) const;
    /// LaunchLine::along_x of light that travels along `d`.
    bool lines_along_x(const Vec3& d) const;
    /// The line of light that starts `offset` in [0, 1] into a cell across it, from a border of the
    /// tile on. Periodic surfaces only.
    void start(LaunchLine& line, double offset, const Vec3& d) const;
    /// Follows the rays of a stripe of such lines to their first facets, wave.points after land():
    /// until all have landed, or no more fit in the wave. Returns whether all have, or are still
    /// under way after LaunchLine::kMostRounds: stripe.under_way() of them. Rays onto facets that
    /// are only counted go to wave.counted instead.
    bool launch(LaunchLine& line, LaunchStripe& stripe, const CountedFacets& known,
                PathWave& wave) const;
    /// The same for rays straight down onto the place (u, v) of the cells of a row; as many must
    /// fit.
    void launch_down(double u, double v, const LaunchedRow& row, const CountedFacets& known,
                     PathWave& wave) const;
    /// Rays launched since the wave was cleared, but for those counted; at most kWave may be.
    std::size_t launched(const PathWave& wave) const;
    /// Finishes launches along such a line of light that travels along `direction`.
    void land(const LaunchLine& line, const Vec3& direction, PathWave& wave) const;
    /// Moves rays from free space, at most kWave, to their first facets; path k is ray k.
    void enter(std::span<const Ray> rays, PathWave& wave) const;
    /// Moves the paths at wave.points along wave.leaving() to their next facets, wave.points again,
    /// or out; these directions become the arriving ones. The lists of those that ended are made
    /// anew.
    void leave(PathWave& wave) const;

    /// Advances each ray to its next facet or out, as Tracer::trace; for tests and single rays.
    void trace(std::span<Ray> rays, std::span<RayEnd> ends) const;

  private:
    void fall(PathWave& wave) const;
    void walk(PathWave& wave, bool from_above) const;
    void settle_edges(PathWave& wave) const;
    void set_direction(Directions& to, std::size_t k, Vec3 d, std::int32_t path) const;
    void place(const Ray& ray, std::size_t k, PathWave& wave) const;
    void stand(const FacetPoints& points, std::size_t k, Ray& ray) const;
    void trace_some(std::span<const std::size_t> chosen, bool on_facet, std::span<Ray> rays,
                    std::span<RayEnd> ends, PathWave& wave) const;

    const int surface_cells_x_, surface_cells_y_;
    const PaddedHeights heights_;
    const Horizon horizon_;
    WideGrid grid_;
};

}  // namespace asperity

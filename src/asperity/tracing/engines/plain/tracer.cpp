// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/plain/tracer.h>

#include <algorithm>
#include <limits>

namespace asperity {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double lerp(double a, double b, double t) {
    return a + t * (b - a);
}

/// One ray on its way over the lines of the triangle grid.
///
/// Everything here is written for the diagonal from (1, 0) to (0, 1) of the unit cell. The other
/// diagonal is the same picture in a mirror: u runs from right to left, and a step to larger u goes
/// to the cell on the left.
template <Diagonal kDiagonal>
class Walk {
  public:
    Walk(const Heightfield& surface, const HeightBounds& bounds, const Ray& ray)
        : s_(surface),
          bounds_(bounds),
          i_(ray.i),
          j_(ray.j),
          u_(kMirrored ? 1 - ray.u : ray.u),
          v_(ray.v),
          z_(ray.z),
          du_(flush((kMirrored ? -ray.direction.x : ray.direction.x) / surface.dx)),
          dv_(flush(ray.direction.y / surface.dy)),
          dz_(ray.direction.z),
          per_u_(1 / du_),
          per_v_(1 / dv_),
          per_diagonal_(1 / flush(du_ + dv_)) {}

    RayEnd run(Ray& ray) {
        bool leaving = ray.facet >= 0;  // the triangle just reflected from is not tested again
        if (leaving) {
            fetch_corners();
            lower_ = static_cast<Triangle>(ray.facet) == Triangle::Lower;
            clearance_ = 0;
        } else if (RayEnd end; enter_free(end)) {
            return finish(ray, end);
        }
        for (int crossings = 0; crossings < Tracer::kMaxCrossings; ++crossings) {
            const Crossing out = lower_ ? cross_lower() : cross_upper();
            if (!leaving && out.clearance < 0 && descent_ < 0) {
                stop_at_surface(out);
                return finish(ray, RayEnd::Hit);
            }
            if (out.line == Line::None) return finish(ray, RayEnd::Escaped);
            leaving = false;
            if (RayEnd end; !pass(out, end)) return finish(ray, end);
        }
        return finish(ray, RayEnd::Stuck);
    }

  private:
    static constexpr bool kMirrored = kDiagonal == Diagonal::Main;

    enum class Line { U, V, Diagonal, None };
    /// Where the ray leaves a triangle: after `t`, over which line, at (u, v), with what clearance.
    struct Crossing {
        Line line;
        double t, u, v, clearance;
    };

    /// Directions this close to an axis are along it; their inverse stays finite otherwise.
    static double flush(double d) { return std::abs(d) < 1e-200 ? 0.0 : d; }

    void fetch_corners() {
        const int left = kMirrored ? i_ + 1 : i_, right = kMirrored ? i_ : i_ + 1;
        h00_ = static_cast<double>(s_.at(left, j_));
        h10_ = static_cast<double>(s_.at(right, j_));
        h01_ = static_cast<double>(s_.at(left, j_ + 1));
        h11_ = static_cast<double>(s_.at(right, j_ + 1));
    }

    /// The same after a step over one line, whose two corners are known.
    void fetch_next_corners(bool along_u, bool forward) {
        const int left = kMirrored ? i_ + 1 : i_, right = kMirrored ? i_ : i_ + 1;
        if (along_u) {
            const int column = forward ? right : left;
            const double below = static_cast<double>(s_.at(column, j_)),
                         above = static_cast<double>(s_.at(column, j_ + 1));
            (forward ? h00_ : h10_) = forward ? h10_ : h00_;
            (forward ? h01_ : h11_) = forward ? h11_ : h01_;
            (forward ? h10_ : h00_) = below;
            (forward ? h11_ : h01_) = above;
        } else {
            const int row = forward ? j_ + 1 : j_;
            const double at_left = static_cast<double>(s_.at(left, row)),
                         at_right = static_cast<double>(s_.at(right, row));
            (forward ? h00_ : h01_) = forward ? h01_ : h00_;
            (forward ? h10_ : h11_) = forward ? h11_ : h10_;
            (forward ? h01_ : h00_) = at_left;
            (forward ? h11_ : h10_) = at_right;
        }
    }

    /// Height of the surface under (u, v), in the triangle the walk is in.
    double height(double u, double v) const {
        return lower_ ? h00_ + (h10_ - h00_) * u + (h01_ - h00_) * v
                      : h11_ + (h01_ - h11_) * (1 - u) + (h10_ - h11_) * (1 - v);
    }

    /// The way out of the triangle (0,0) (1,0) (0,1).
    Crossing cross_lower() {
        descent_ = dz_ - (h10_ - h00_) * du_ - (h01_ - h00_) * dv_;
        const double tu = du_ < 0 ? -u_ * per_u_ : kInfinity;
        const double tv = dv_ < 0 ? -v_ * per_v_ : kInfinity;
        const double td =
            crosses_diagonal(1) ? std::max(0.0, (1 - u_ - v_) * per_diagonal_) : kInfinity;
        if (tu <= tv && tu <= td && tu < kInfinity) return cross_u(tu, 0, h00_, h01_);
        if (tv <= td && tv < kInfinity) return cross_v(tv, 0, h00_, h10_);
        return cross_diagonal(td);
    }

    /// The way out of the triangle (1,1) (0,1) (1,0).
    Crossing cross_upper() {
        descent_ = dz_ - (h11_ - h01_) * du_ - (h11_ - h10_) * dv_;
        const double tu = du_ > 0 ? (1 - u_) * per_u_ : kInfinity;
        const double tv = dv_ > 0 ? (1 - v_) * per_v_ : kInfinity;
        const double td =
            crosses_diagonal(-1) ? std::max(0.0, (1 - u_ - v_) * per_diagonal_) : kInfinity;
        if (tu <= tv && tu <= td && tu < kInfinity) return cross_u(tu, 1, h10_, h11_);
        if (tv <= td && tv < kInfinity) return cross_v(tv, 1, h01_, h11_);
        return cross_diagonal(td);
    }

    /// Whether u + v changes in this sense.
    bool crosses_diagonal(int sense) const {
        return std::abs(per_diagonal_) < kInfinity && per_diagonal_ * sense > 0;
    }

    Crossing cross_u(double t, double u, double h_below, double h_above) const {
        const double v = std::clamp(v_ + dv_ * t, 0.0, 1.0);
        return {Line::U, t, u, v, z_ + dz_ * t - lerp(h_below, h_above, v)};
    }
    Crossing cross_v(double t, double v, double h_left, double h_right) const {
        const double u = std::clamp(u_ + du_ * t, 0.0, 1.0);
        return {Line::V, t, u, v, z_ + dz_ * t - lerp(h_left, h_right, u)};
    }
    Crossing cross_diagonal(double t) const {
        // A vertical ray crosses nothing: it meets this triangle or leaves for good.
        if (!(t < kInfinity)) return {Line::None, t, u_, v_, descent_};
        const double u = std::clamp(u_ + du_ * t, 0.0, 1.0);
        return {Line::Diagonal, t, u, 1 - u, z_ + dz_ * t - lerp(h01_, h10_, u)};
    }

    /// Moves to the point inside the triangle where the clearance vanishes.
    void stop_at_surface(const Crossing& out) {
        if (out.line != Line::None) {
            const double share = clearance_ / (clearance_ - out.clearance);
            u_ = lerp(u_, out.u, share);
            v_ = lerp(v_, out.v, share);
        }
        z_ = height(u_, v_);
    }

    /// Goes over the line into the next triangle; false when the ray is out, and `end` says how.
    bool pass(const Crossing& out, RayEnd& end) {
        u_ = out.u;
        v_ = out.v;
        z_ += dz_ * out.t;
        clearance_ = std::max(0.0, out.clearance);
        if (out.line == Line::Diagonal) {
            lower_ = !lower_;
            return true;
        }
        const bool along_u = out.line == Line::U;
        const bool forward = along_u ? du_ > 0 : dv_ > 0;
        if (along_u)
            u_ = forward ? 0.0 : 1.0;
        else
            v_ = forward ? 0.0 : 1.0;
        const int step = forward != (along_u && kMirrored) ? 1 : -1;
        int& index = along_u ? i_ : j_;
        const bool new_tile = step > 0 ? (index + 1) % HeightBounds::tile_size(0) == 0
                                       : index % HeightBounds::tile_size(0) == 0;
        if (dz_ >= 0 && z_ >= static_cast<double>(bounds_.max_height())) {
            end = RayEnd::Escaped;
            return false;
        }
        if (!(along_u ? move_x(step) : move_y(step))) {
            end = RayEnd::Edge;
            return false;
        }
        const bool jumped = new_tile && jump_tiles(end);
        if (jumped && end != RayEnd::Hit) return false;
        fetch_corners();
        if (jumped)
            place_in_cell();
        else
            lower_ = forward;
        return true;
    }

    /// Puts a ray that starts in free space into its triangle; true when it is out already.
    bool enter_free(RayEnd& end) {
        if (dz_ >= 0 && z_ >= static_cast<double>(bounds_.max_height())) {
            end = RayEnd::Escaped;
            return true;
        }
        if (jump_tiles(end) && end != RayEnd::Hit) return true;
        fetch_corners();
        place_in_cell();
        return false;
    }

    void place_in_cell() {
        lower_ = u_ + v_ < 1;
        clearance_ = std::max(0.0, z_ - height(u_, v_));
    }

    /// Steps over one cell or tile; false at the side of a finite patch.
    bool move_x(int step) { return move(i_, tiles_x_, s_.cells_x(), step); }
    bool move_y(int step) { return move(j_, tiles_y_, s_.cells_y(), step); }
    bool move(int& index, int& tiles, int cells, int step) const {
        index += step;
        if (index >= 0 && index < cells) return true;
        if (s_.boundary == Boundary::Finite) return false;
        index = index < 0 ? cells - 1 : 0;
        tiles += step;
        return true;
    }

    /// Flies over tiles as long as the ray stays above their highest points. False when there was
    /// nothing to jump. True: the ray has moved, and `end` is Hit as long as it is still under way.
    bool jump_tiles(RayEnd& end) {
        end = RayEnd::Hit;
        bool jumped = false;
        for (int jumps = 0; jumps < Tracer::kMaxCrossings; ++jumps) {
            if (!jump_tile(1, end) && !jump_tile(0, end)) return jumped;
            jumped = true;
            if (end != RayEnd::Hit) return true;
        }
        end = RayEnd::Stuck;
        return true;
    }

    /// Flies over the tile of this level the ray is in; false when it may dip below its top.
    bool jump_tile(int level, RayEnd& end) {
        const int size = HeightBounds::tile_size(level);
        const double top = static_cast<double>(bounds_.tile_max(level, i_ / size, j_ / size));
        if (z_ < top) return false;
        // Cells from here to the tile's four sides, in the walk's own sense of u
        const int i0 = i_ / size * size, i1 = std::min(i0 + size, s_.cells_x());
        const int j0 = j_ / size * size, j1 = std::min(j0 + size, s_.cells_y());
        const int ahead = kMirrored ? i_ - i0 : i1 - 1 - i_;
        const int behind = kMirrored ? i1 - 1 - i_ : i_ - i0;
        const double tu = du_ > 0   ? (ahead + 1 - u_) * per_u_
                          : du_ < 0 ? -(behind + u_) * per_u_
                                    : kInfinity;
        const double tv = dv_ > 0   ? (j1 - j_ - v_) * per_v_
                          : dv_ < 0 ? -(j_ - j0 + v_) * per_v_
                                    : kInfinity;
        const double t = std::min(tu, tv);
        if (!(t < kInfinity) || z_ + std::min(0.0, dz_) * t < top) return false;

        z_ += dz_ * t;
        const bool over_u = tu <= tv;
        if (over_u) {
            shift(v_, j_, dv_ * t, j0, j1, false);
            u_ = du_ > 0 ? 0.0 : 1.0;
            i_ = (du_ > 0) != kMirrored ? i1 - 1 : i0;
        } else {
            shift(u_, i_, du_ * t, i0, i1, kMirrored);
            v_ = dv_ > 0 ? 0.0 : 1.0;
            j_ = dv_ > 0 ? j1 - 1 : j0;
        }
        if (dz_ >= 0 && z_ >= static_cast<double>(bounds_.max_height())) {
            end = RayEnd::Escaped;
            return true;
        }
        const bool inside =
            over_u ? move_x((du_ > 0) != kMirrored ? 1 : -1) : move_y(dv_ > 0 ? 1 : -1);
        if (!inside) end = RayEnd::Edge;
        return true;
    }

    /// Moves `position` in cell `index` by `distance` cells, within the cells [first, last).
    static void shift(double& position, int& index, double distance, int first, int last,
                      bool mirrored) {
        const double moved = position + distance;
        const double whole = std::floor(moved);
        const int cells = mirrored ? -static_cast<int>(whole) : static_cast<int>(whole);
        const int wanted = index + cells;
        index = std::clamp(wanted, first, last - 1);
        // Rounding may put the point on the far side of the tile's edge: it belongs on the edge.
        position = index == wanted ? moved - whole : ((wanted > index) != mirrored ? 1.0 : 0.0);
    }

    RayEnd finish(Ray& ray, RayEnd end) const {
        ray.i = i_;
        ray.j = j_;
        ray.u = kMirrored ? 1 - u_ : u_;
        ray.v = v_;
        ray.z = z_;
        ray.tiles_x += tiles_x_;
        ray.tiles_y += tiles_y_;
        ray.facet = end != RayEnd::Hit
                        ? -1
                        : static_cast<std::int32_t>(lower_ ? Triangle::Lower : Triangle::Upper);
        return end;
    }

    const Heightfield& s_;
    const HeightBounds& bounds_;
    int i_, j_;
    int tiles_x_ = 0, tiles_y_ = 0;  // gone over
    double u_, v_, z_;
    const double du_, dv_, dz_;                  // per unit of path: cells, cells, height
    const double per_u_, per_v_, per_diagonal_;  // path per cell in u, in v, in u + v
    bool lower_ = true;
    double h00_ = 0, h10_ = 0, h01_ = 0, h11_ = 0;  // corners; first digit along u
    double clearance_ = 0;                          // where the ray entered the triangle, >= 0
    double descent_ = 0;                            // change of the clearance per unit of path
};

}  // namespace

Tracer::Tracer(const Heightfield& surface, int threads)
    : surface_(surface), bounds_(surface, threads) {}

void Tracer::trace(std::span<Ray> rays, std::span<RayEnd> ends) const {
    if (surface_.diagonal == Diagonal::Anti) {
        for (std::size_t k = 0; k < rays.size(); ++k)
            ends[k] = Walk<Diagonal::Anti>(surface_, bounds_, rays[k]).run(rays[k]);
    } else {
        for (std::size_t k = 0; k < rays.size(); ++k)
            ends[k] = Walk<Diagonal::Main>(surface_, bounds_, rays[k]).run(rays[k]);
    }
}

}  // namespace asperity

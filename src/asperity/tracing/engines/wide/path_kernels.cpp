// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/path_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/tracing/engines/wide/path_kernels.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <asperity/tracing/engines/wide/ground-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {
namespace {

/// A direction after a reflection.
struct Mirrored {
    Floats x, y, z, level;
    Floats d_m;  ///< of the direction before it and the facet's normal (-slope_x, -slope_y, 1)
    Floats m_m;  ///< of the normal with itself

    /// Between the directions and the normal.
    HWY_INLINE Floats cosine() const {
        return hn::Min(all(1.0f), hn::Div(hn::Abs(d_m), hn::Sqrt(m_m)));
    }
};
HWY_INLINE Mirrored mirror(Floats x, Floats y, Floats z, Floats slope_x, Floats slope_y) {
    // d' = d - 2 (d.m) m / m.m about m
    const Floats one = all(1.0f);
    const Floats d_m = hn::Sub(z, hn::Add(hn::Mul(slope_x, x), hn::Mul(slope_y, y)));
    const Floats m_m = hn::Add(one, hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)));
    const Floats share = hn::Div(hn::Add(d_m, d_m), m_m);
    Mirrored out;
    out.x = hn::Add(x, hn::Mul(share, slope_x));
    out.y = hn::Add(y, hn::Mul(share, slope_y));
    out.z = hn::Sub(z, share);
    out.level = hn::Sqrt(hn::Add(hn::Mul(out.x, out.x), hn::Mul(out.y, out.y)));
    out.d_m = d_m;
    out.m_m = m_m;
    return out;
}

template <bool kParallel>
void ReflectPaths(const FacetPoints& points, const Vec3& d, float per_x, float per_y,
                  Directions& leaving, PerPath<float>* cosine) {
    const Floats x0 = all(static_cast<float>(d.x)), y0 = all(static_cast<float>(d.y)),
                 z0 = all(static_cast<float>(d.z));
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Floats side = load(points.side, k);
        const Mirrored out =
            mirror(kParallel ? x0 : load(points.x, k), kParallel ? y0 : load(points.y, k),
                   kParallel ? z0 : load(points.z, k),
                   hn::Mul(hn::Mul(side, load(points.rise_u, k)), all(per_x)),
                   hn::Mul(hn::Mul(side, load(points.rise_v, k)), all(per_y)));
        store(out.x, leaving.x, k);
        store(out.y, leaving.y, k);
        store(out.z, leaving.z, k);
        store(out.level, leaving.level, k);
        store(load(points.path, k), leaving.path, k);
        if (cosine) store(out.cosine(), *cosine, k);
    }
}

/// The angle of (x, y) from the first axis in eighths of a turn, x, y >= 0: 0 .. 2. Exact along
/// the axes; elsewhere within 5e-8, by a polynomial of least largest error for atan(r) 4 / pi.
HWY_INLINE Floats eighths(Floats x, Floats y) {
    const Floats large = hn::Max(hn::Max(x, y), all(1e-30f)), small = hn::Min(x, y);
    const Floats r = hn::Div(small, large), r2 = hn::Mul(r, r);
    Floats p = all(-0.00516241889f);
    for (const float c : {0.0278367237f, -0.0711897016f, 0.122768209f, -0.177090148f, 0.253967557f,
                          -0.424368967f, 1.2732387f})
        p = hn::Add(all(c), hn::Mul(p, r2));
    const Floats a = hn::Mul(r, p);
    return select(hn::Gt(y, x), hn::Sub(all(2.0f), a), a);
}

/// The detector's cells of directions.
class CellFinder {
  public:
    HWY_INLINE CellFinder(bool equal_area, int rows, int columns)
        : equal_area_(equal_area),
          to_row_(all(static_cast<float>(rows) * (equal_area ? 1.0f : 0.5f))),
          to_column_(all(static_cast<float>(columns) / 8)),
          last_row_(all(rows - 1)),
          last_column_(all(columns - 1)),
          columns_(all(columns)) {}

    HWY_INLINE Ints operator()(Floats x, Floats y, Floats z) const {
        const Floats zero = hn::Zero(kFloat);
        const Floats level2 = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
        const Floats polar = equal_area_ ? level2 : eighths(hn::Max(z, zero), hn::Sqrt(level2));
        Floats azimuth = eighths(hn::Abs(x), hn::Abs(y));
        azimuth = select(hn::Lt(x, zero), hn::Sub(all(4.0f), azimuth), azimuth);
        azimuth = select(hn::Lt(y, zero), hn::Sub(all(8.0f), azimuth), azimuth);
        const Ints row = hn::Min(hn::ConvertTo(kInt, hn::Mul(polar, to_row_)), last_row_);
        const Ints column =
            hn::Min(hn::ConvertTo(kInt, hn::Mul(azimuth, to_column_)), last_column_);
        return hn::Add(hn::Mul(row, columns_), column);
    }

  private:
    const bool equal_area_;
    const Floats to_row_, to_column_;
    const Ints last_row_, last_column_, columns_;
};

void FindCells(const Escapes& escapes, bool equal_area, int rows, int columns, float mirror_x,
               const Turn& turn, PerPath<std::int32_t>& cells) {
    const CellFinder find(equal_area, rows, columns);
    const bool turned = turn.cos_phi_of || turn.sin_phi != 0 || turn.cos_phi != 1;
    Floats c = all(turn.cos_phi), s = all(turn.sin_phi);
    for (std::size_t k = 0; k < escapes.count; k += kLanes) {
        Floats x = hn::Mul(all(mirror_x), load(escapes.x, k)), y = load(escapes.y, k);
        if (turn.cos_phi_of) {
            const Ints path = only(first_lanes(k, escapes.count), load(escapes.path, k));
            c = gather(*turn.cos_phi_of, path);
            s = gather(*turn.sin_phi_of, path);
        }
        if (turned) {
            const Floats along = hn::Add(hn::Mul(c, x), hn::Mul(s, y));
            y = hn::Sub(hn::Mul(c, y), hn::Mul(s, x));
            x = along;
        }
        store(find(x, y, load(escapes.z, k)), cells, k);
    }
}

/// Parallel light onto the facets of whole rows.
template <class GroundT>
class FacetLook {
  public:
    HWY_INLINE FacetLook(const GroundT& ground, const CellFinder& find, float mirror_x,
                         const float (&d)[3], float unit)
        : ground_(ground),
          find_(find),
          mirror_x_(all(mirror_x)),
          x_(all(d[0])),
          y_(all(d[1])),
          z_(all(d[2])),
          light_level_(hn::Sqrt(hn::Add(hn::Mul(x_, x_), hn::Mul(y_, y_)))),
          unit_per_z_(hn::Div(all(unit), z_)),
          light_sector_(sector_of(hn::Neg(x_), hn::Neg(y_))) {}

    /// Whether light that climbs like this back to where it comes from meets nothing from any point
    /// of the cell.
    HWY_INLINE Mask lit(Ints cell) const {
        return hn::Gt(hn::Neg(z_), hn::Mul(slope(cell, light_sector_), light_level_));
    }
    /// Looks at the facets with corners at the heights o, u, v: `side` as in FacetPoints. Returns
    /// those that are known.
    HWY_INLINE Mask look(Ints cell, Mask cell_lit, Floats side, Floats o, Floats u, Floats v,
                         const FacetRow& row, std::size_t k) const {
        const Mirrored out =
            mirror(x_, y_, z_, hn::Mul(hn::Mul(side, hn::Sub(u, o)), ground_.per_x),
                   hn::Mul(hn::Mul(side, hn::Sub(v, o)), ground_.per_y));
        const Floats zero = hn::Zero(kFloat);
        // Free, and in the light, wherever on the facet: beyond the horizon of its cell
        const Mask on_top = hn::Ge(hn::Min(o, hn::Min(u, v)), ground_.max_height);
        const Mask free =
            hn::Or(hn::And(on_top, hn::Ge(out.z, zero)),
                   hn::Gt(out.z, hn::Mul(slope(cell, sector_of(out.x, out.y)), out.level)));
        const Mask in_light = hn::And(hn::Lt(out.d_m, zero), hn::Or(on_top, cell_lit));
        const Floats flux =
            hn::IfThenElseZero(hn::And(free, in_light), hn::Floor(hn::Mul(out.d_m, unit_per_z_)));
        hn::StoreU(find_(hn::Mul(mirror_x_, out.x), out.y, out.z), kInt, row.cells + k);
        hn::StoreU(flux, kFloat, row.flux + k);
        if (row.cosine) hn::StoreU(out.cosine(), kFloat, row.cosine + k);
        return hn::Gt(flux, zero);
    }

  private:
    HWY_INLINE Floats slope(Ints cell, Ints sector) const {
        return ground_.horizon_pays ? hn::Min(ground_.steepest, ground_.horizon(cell, sector))
                                    : ground_.steepest;
    }
    const GroundT& ground_;
    const CellFinder& find_;
    const Floats mirror_x_, x_, y_, z_, light_level_, unit_per_z_;
    const Ints light_sector_;
};

void LookAtFacets(const WideGrid& grid, bool equal_area, int rows, int columns, float mirror_x,
                  const float (&d)[3], float unit, int j, const FacetRow& lower,
                  const FacetRow& upper, std::uint8_t* known) {
    const CellFinder find(equal_area, rows, columns);
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        const FacetLook look(ground, find, mirror_x, d, unit);
        const float* below =
            grid.middle + std::ptrdiff_t{j - grid.middle_y} * grid.pitch - grid.middle_x;
        const float* above = below + grid.pitch;
        const auto count = static_cast<std::size_t>(grid.cells_x);
        for (std::size_t k = 0; k < count; k += kLanes) {
            const Floats h00 = hn::LoadU(kFloat, below + k), h10 = hn::LoadU(kFloat, below + k + 1),
                         h01 = hn::LoadU(kFloat, above + k), h11 = hn::LoadU(kFloat, above + k + 1);
            const Ints i =
                hn::Add(counting_from(static_cast<std::int32_t>(k)), all(-grid.middle_x));
            const Ints cell =
                only(first_lanes(k, count),
                     hn::Or(hn::And(i, all(0xffff)), all(pack_vertex(0, j - grid.middle_y))));
            const Mask lit = look.lit(cell);
            const Mask l = look.look(cell, lit, all(1.0f), h00, h10, h01, lower, k);
            const Mask u = look.look(cell, lit, all(-1.0f), h11, h01, h10, upper, k);
            const Ints bits = hn::Or(only(l, all(std::int32_t{CountedFacets::kLower})),
                                     only(u, all(std::int32_t{CountedFacets::kUpper})));
            const hn::Rebind<std::uint8_t, IntTag> bytes;
            hn::StoreU(hn::DemoteTo(bytes, bits), bytes, known + k);
        }
    });
}

void ReflectParallel(const FacetPoints& points, const Vec3& d, float per_x, float per_y,
                     Directions& leaving, PerPath<float>* cosine) {
    ReflectPaths<true>(points, d, per_x, per_y, leaving, cosine);
}
void ReflectAny(const FacetPoints& points, float per_x, float per_y, Directions& leaving,
                PerPath<float>* cosine) {
    ReflectPaths<false>(points, {}, per_x, per_y, leaving, cosine);
}

}  // namespace
}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(ReflectParallel);
HWY_EXPORT(ReflectAny);
HWY_EXPORT(FindCells);
HWY_EXPORT(LookAtFacets);

void reflect_paths(const FacetPoints& points, const Vec3* parallel, const PaddedHeights& heights,
                   Directions& leaving, PerPath<float>* cosine) {
    const auto per_x = static_cast<float>(1 / heights.dx());
    const auto per_y = static_cast<float>(1 / heights.dy());
    if (parallel)
        HWY_DYNAMIC_DISPATCH(ReflectParallel)(points, *parallel, per_x, per_y, leaving, cosine);
    else
        HWY_DYNAMIC_DISPATCH(ReflectAny)(points, per_x, per_y, leaving, cosine);
}

void find_cells(const Escapes& escapes, const Detector& detector, float mirror_x, const Turn& turn,
                PerPath<std::int32_t>& cells) {
    HWY_DYNAMIC_DISPATCH(FindCells)
    (escapes, detector.kind() == DetectorKind::EqualArea, detector.rows(), detector.columns(),
     mirror_x, turn, cells);
}

void look_at_facets(const WideGrid& grid, const Detector& detector, float mirror_x, Vec3 d,
                    float unit, int j, const FacetRow& lower, const FacetRow& upper,
                    std::uint8_t* known) {
    const float direction[3] = {static_cast<float>(d.x), static_cast<float>(d.y),
                                static_cast<float>(d.z)};
    HWY_DYNAMIC_DISPATCH(LookAtFacets)
    (grid, detector.kind() == DetectorKind::EqualArea, detector.rows(), detector.columns(),
     mirror_x, direction, unit, j, lower, upper, known);
}

}  // namespace asperity
#endif

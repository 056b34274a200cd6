// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/path_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/gonio/path_kernels.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <asperity/tracing/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {
namespace {

template <bool kParallel>
void ReflectPaths(const FacetPoints& points, const Directions& arriving, float per_x, float per_y,
                  Directions& leaving, PerPath<float>& cosine) {
    const Floats one = all(1.0f);
    const Floats x0 = all(arriving.x[0]), y0 = all(arriving.y[0]), z0 = all(arriving.z[0]);
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Ints ray = only(first_lanes(k, points.count), load(points.ray, k));
        const Floats x = kParallel ? x0 : gather(arriving.x, ray);
        const Floats y = kParallel ? y0 : gather(arriving.y, ray);
        const Floats z = kParallel ? z0 : gather(arriving.z, ray);
        const Ints path = kParallel ? ray : gather(arriving.path.values, ray);
        // d' = d - 2 (d.m) m / m.m about m = (-slope_x, -slope_y, 1)
        const Floats side = load(points.side, k);
        const Floats slope_x = hn::Mul(hn::Mul(side, load(points.rise_u, k)), all(per_x));
        const Floats slope_y = hn::Mul(hn::Mul(side, load(points.rise_v, k)), all(per_y));
        const Floats d_m = hn::Sub(z, hn::Add(hn::Mul(slope_x, x), hn::Mul(slope_y, y)));
        const Floats m_m =
            hn::Add(one, hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)));
        const Floats share = hn::Div(hn::Add(d_m, d_m), m_m);
        const Floats new_x = hn::Add(x, hn::Mul(share, slope_x));
        const Floats new_y = hn::Add(y, hn::Mul(share, slope_y));
        store(new_x, leaving.x, k);
        store(new_y, leaving.y, k);
        store(hn::Sub(z, share), leaving.z, k);
        store(hn::Sqrt(hn::Add(hn::Mul(new_x, new_x), hn::Mul(new_y, new_y))), leaving.level, k);
        store(path, leaving.path, k);
        store(hn::Min(one, hn::Div(hn::Abs(d_m), hn::Sqrt(m_m))), cosine, k);
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

void FindCells(const Escapes& escapes, bool equal_area, int rows, int columns, float mirror_x,
               const PerPath<float>* cos_phi, const PerPath<float>* sin_phi,
               PerPath<std::int32_t>& cells) {
    const Floats zero = hn::Zero(kFloat);
    const Floats to_row = all(static_cast<float>(rows) * (equal_area ? 1.0f : 0.5f));
    const Floats to_column = all(static_cast<float>(columns) / 8);
    for (std::size_t k = 0; k < escapes.count; k += kLanes) {
        Floats x = hn::Mul(all(mirror_x), load(escapes.x, k)), y = load(escapes.y, k);
        const Floats z = hn::Max(load(escapes.z, k), zero);
        if (cos_phi) {
            const Ints path = only(first_lanes(k, escapes.count), load(escapes.path, k));
            const Floats c = gather(*cos_phi, path), s = gather(*sin_phi, path);
            const Floats turned = hn::Add(hn::Mul(c, x), hn::Mul(s, y));
            y = hn::Sub(hn::Mul(c, y), hn::Mul(s, x));
            x = turned;
        }
        const Floats level2 = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
        const Floats polar = equal_area ? level2 : eighths(z, hn::Sqrt(level2));
        Floats azimuth = eighths(hn::Abs(x), hn::Abs(y));
        azimuth = select(hn::Lt(x, zero), hn::Sub(all(4.0f), azimuth), azimuth);
        azimuth = select(hn::Lt(y, zero), hn::Sub(all(8.0f), azimuth), azimuth);
        const Ints row = hn::Min(hn::ConvertTo(kInt, hn::Mul(polar, to_row)), all(rows - 1));
        const Ints column =
            hn::Min(hn::ConvertTo(kInt, hn::Mul(azimuth, to_column)), all(columns - 1));
        store(hn::Add(hn::Mul(row, all(columns)), column), cells, k);
    }
}

void ReflectParallel(const FacetPoints& points, const Directions& arriving, float per_x,
                     float per_y, Directions& leaving, PerPath<float>& cosine) {
    ReflectPaths<true>(points, arriving, per_x, per_y, leaving, cosine);
}
void ReflectAny(const FacetPoints& points, const Directions& arriving, float per_x, float per_y,
                Directions& leaving, PerPath<float>& cosine) {
    ReflectPaths<false>(points, arriving, per_x, per_y, leaving, cosine);
}

}  // namespace
}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(ReflectParallel);
HWY_EXPORT(ReflectAny);
HWY_EXPORT(FindCells);

void reflect_paths(const FacetPoints& points, const Directions& arriving, bool parallel,
                   const PaddedHeights& heights, Directions& leaving, PerPath<float>& cosine) {
    const auto per_x = static_cast<float>(1 / heights.dx());
    const auto per_y = static_cast<float>(1 / heights.dy());
    if (parallel)
        HWY_DYNAMIC_DISPATCH(ReflectParallel)(points, arriving, per_x, per_y, leaving, cosine);
    else
        HWY_DYNAMIC_DISPATCH(ReflectAny)(points, arriving, per_x, per_y, leaving, cosine);
}

void find_cells(const Escapes& escapes, const Detector& detector, float mirror_x,
                const PerPath<float>* cos_phi, const PerPath<float>* sin_phi,
                PerPath<std::int32_t>& cells) {
    HWY_DYNAMIC_DISPATCH(FindCells)
    (escapes, detector.kind() == DetectorKind::EqualArea, detector.rows(), detector.columns(),
     mirror_x, cos_phi, sin_phi, cells);
}

}  // namespace asperity
#endif

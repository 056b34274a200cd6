// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/smith_lanes.h>
#include <asperity/core/directions.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/bsdf/smith_lanes.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

HWY_INLINE V all(double x) {
    return hn::Set(kTag, x);
}
HWY_INLINE V squared(V x) {
    return hn::Mul(x, x);
}
HWY_INLINE V product_and_sum(V a, V b, V c) {  // never fused
    return hn::Add(hn::Mul(a, b), c);
}

/// exp(x) for x <= 0, to two units of the last place; 0 where that would be below 1e-307.
HWY_INLINE V exponential(V x) {
    constexpr hn::Rebind<std::int64_t, Tag> kWhole;
    // 2^n e^r: the least bits of n + 1.5 * 2^52 are those of n
    const V low = hn::Max(x, all(-708)), magic = all(0x1.8p52);
    const V shifted = product_and_sum(low, all(0x1.71547652b82fep0), magic);
    const V n = hn::Sub(shifted, magic);
    // ln 2 in two parts, the first of few enough bits that its products are exact
    const V r = product_and_sum(n, all(-0x1.a39ef35793c76p-33),
                                product_and_sum(n, all(-0x1.62e42feep-1), low));
    double factorial = 6227020800;  // 13!
    V sum = all(1 / factorial);
    for (int k = 13; k > 0; --k) {
        factorial /= k;
        sum = product_and_sum(sum, r, all(1 / factorial));
    }
    const auto power = hn::Add(hn::ShiftLeft<52>(hn::BitCast(kWhole, shifted)),
                               hn::Set(kWhole, std::int64_t{1023} << 52));
    return hn::IfThenZeroElse(hn::Lt(x, low), hn::Mul(sum, hn::BitCast(kTag, power)));
}

/// Facets that mirror light from `wi`.
struct Facets {
    double wi_x, wi_y, wi_z, alpha_x, alpha_y;
    bool is_ggx;

    HWY_INLINE V density(V x, V y, V z, V& cosine) const {
        // Along the half vector, as long as it is
        const V sx = hn::Add(all(wi_x), x), sy = hn::Add(all(wi_y), y), sz = hn::Add(all(wi_z), z);
        const V z2 = squared(sz);
        const V length2 = hn::Add(hn::Add(squared(sx), squared(sy)), z2);
        cosine = hn::Min(all(1), hn::Mul(all(0.5), hn::Sqrt(length2)));
        const V across =
            hn::Add(squared(hn::Mul(sx, all(1 / alpha_x))), squared(hn::Mul(sy, all(1 / alpha_y))));
        const V area = all(kPi * alpha_x * alpha_y);
        if (is_ggx) {
            const V t = hn::Div(length2, hn::Add(across, z2));
            return hn::Div(squared(t), area);
        }
        const V steep = hn::Div(all(1), z2);
        const V per_plane = squared(hn::Mul(length2, steep));  // 1 / cos^4
        return hn::Div(hn::Mul(exponential(hn::Neg(hn::Mul(across, steep))), per_plane), area);
    }
};

void Mirroring(const Facets& facets, const double* wo, std::size_t count, double* density,
               double* cosine) {
    const std::size_t lanes = hn::Lanes(kTag);
    std::size_t k = 0;
    V x, y, z, c;
    for (; k + lanes <= count; k += lanes) {
        hn::LoadInterleaved3(kTag, wo + 3 * k, x, y, z);
        hn::StoreU(facets.density(x, y, z, c), kTag, density + k);
        hn::StoreU(c, kTag, cosine + k);
    }
    if (k == count) return;
    // The rest, through vectors of our own
    alignas(64) double rest[3 * 8] = {}, densities[8] = {}, cosines[8] = {};
    for (std::size_t n = 3 * k; n < 3 * count; ++n) rest[n - 3 * k] = wo[n];
    for (std::size_t n = count - k; n < 8; ++n) rest[3 * n + 2] = 1;
    hn::LoadInterleaved3(kTag, rest, x, y, z);
    hn::Store(facets.density(x, y, z, c), kTag, densities);
    hn::Store(c, kTag, cosines);
    for (std::size_t n = k; n < count; ++n) {
        density[n] = densities[n - k];
        cosine[n] = cosines[n - k];
    }
}

void MirroringFacets(const SmithSurface& surface, Vec3 wi, const double* wo, std::size_t count,
                     double* density, double* cosine) {
    const bool is_ggx = surface.distribution == SlopeFamily::Ggx;
    Mirroring({wi.x, wi.y, wi.z, surface.alpha_x, surface.alpha_y, is_ggx}, wo, count, density,
              cosine);
}

}  // namespace
}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(MirroringFacets);

void mirroring_facets(const SmithSurface& surface, Vec3 wi, std::span<const Vec3> wo,
                      double* density, double* cosine) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    if (wo.empty()) return;
    HWY_DYNAMIC_DISPATCH(MirroringFacets)(surface, wi, &wo.front().x, wo.size(), density, cosine);
}

}  // namespace asperity
#endif

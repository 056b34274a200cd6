// SPDX-License-Identifier: Apache-2.0
//
// Fresnel::eval for many angles at once, in single precision; the same formulas as fresnel.cpp, in
// the lanes of a vector. Nothing is fused or approximated: the same bits on every processor.
#include <asperity/optics/fresnel_lanes.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/optics/fresnel_lanes.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

HWY_INLINE V all(float x) {
    return hn::Set(kTag, x);
}
HWY_INLINE V squared(V x) {
    return hn::Mul(x, x);
}

/// Calls f(cosine) for every vector of angles. The last one may overlap the one before.
template <class F>
HWY_INLINE void for_each_vector(const float* cos_theta, std::size_t count, float* out, F f) {
    const std::size_t lanes = hn::Lanes(kTag);
    std::size_t k = 0;
    for (; k + lanes <= count; k += lanes)
        hn::StoreU(f(hn::LoadU(kTag, cos_theta + k)), kTag, out + k);
    if (k == count) return;
    // The rest, through a vector of our own
    alignas(64) float rest[16] = {};
    for (std::size_t n = k; n < count; ++n) rest[n - k] = cos_theta[n];
    hn::Store(f(hn::Load(kTag, rest)), kTag, rest);
    for (std::size_t n = k; n < count; ++n) out[n] = rest[n - k];
}

void Schlick(const float* cos_theta, std::size_t count, float f0, float* out) {
    for_each_vector(cos_theta, count, out, [f0](V c) HWY_ATTR {
        const V m = hn::Sub(all(1), c), m2 = squared(m);
        return hn::Add(all(f0), hn::Mul(all(1 - f0), hn::Mul(squared(m2), m)));
    });
}

void Dielectric(const float* cos_theta, std::size_t count, float eta, float* out) {
    for_each_vector(cos_theta, count, out, [eta](V c) HWY_ATTR {
        const V one = all(1), zero = hn::Zero(kTag);
        const V sin2_t = hn::Mul(hn::Mul(hn::Sub(one, c), hn::Add(one, c)), all(1 / (eta * eta)));
        const V ct = hn::Sqrt(hn::Max(hn::Sub(one, sin2_t), zero));
        const V eta_ct = hn::Mul(all(eta), ct), eta_c = hn::Mul(all(eta), c);
        const V rs = hn::Div(hn::Sub(c, eta_ct), hn::Add(c, eta_ct));
        const V rp = hn::Div(hn::Sub(eta_c, ct), hn::Add(eta_c, ct));
        const V f = hn::Mul(all(0.5f), hn::Add(squared(rs), squared(rp)));
        return hn::IfThenElse(hn::Ge(sin2_t, one), one, f);
    });
}

void Conductor(const float* cos_theta, std::size_t count, float n, float k, float* out) {
    for_each_vector(cos_theta, count, out, [n, k](V c) HWY_ATTR {
        const V one = all(1), half = all(0.5f), zero = hn::Zero(kTag);
        const V s2 = hn::Mul(hn::Sub(one, c), hn::Add(one, c));
        // a + i b = sqrt((n + i k)^2 - sin^2): the larger part first, free of cancellation
        const V re = hn::Sub(all((n - k) * (n + k)), s2), im = all(2 * n * k);
        const V modulus = hn::Sqrt(hn::Add(squared(re), squared(im)));
        const V large = hn::Sqrt(hn::Mul(half, hn::Add(modulus, hn::Abs(re))));
        const V small = hn::Div(hn::Mul(half, im), large);
        const auto a_is_large = hn::Ge(re, zero);
        const V a = hn::IfThenElse(a_is_large, large, small);
        const V b2 = squared(hn::IfThenElse(a_is_large, small, large));
        // Rs = m / p and Rp = Rs q / r; their mean with one division
        const V m = hn::Add(squared(hn::Sub(a, c)), b2), p = hn::Add(squared(hn::Add(a, c)), b2);
        const V ac = hn::Mul(a, c), b2c2 = hn::Mul(b2, squared(c));
        const V q = hn::Add(squared(hn::Sub(ac, s2)), b2c2),
                r = hn::Add(squared(hn::Add(ac, s2)), b2c2);
        return hn::Mul(half, hn::Div(hn::Mul(m, hn::Add(q, r)), hn::Mul(p, r)));
    });
}

}  // namespace
}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(Schlick);
HWY_EXPORT(Dielectric);
HWY_EXPORT(Conductor);

void schlick_lanes(std::span<const float> cos_theta, float f0, float* f) {
    HWY_DYNAMIC_DISPATCH(Schlick)(cos_theta.data(), cos_theta.size(), f0, f);
}
void dielectric_lanes(std::span<const float> cos_theta, float eta, float* f) {
    HWY_DYNAMIC_DISPATCH(Dielectric)(cos_theta.data(), cos_theta.size(), eta, f);
}
void conductor_lanes(std::span<const float> cos_theta, float n, float k, float* f) {
    HWY_DYNAMIC_DISPATCH(Conductor)(cos_theta.data(), cos_theta.size(), n, k, f);
}

}  // namespace asperity
#endif

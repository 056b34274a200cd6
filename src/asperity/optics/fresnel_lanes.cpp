// SPDX-License-Identifier: Apache-2.0
//
// Fresnel::eval for many angles at once, mostly in single precision; the same formulas as laws/, in
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
template <class T>
using TagOf = hn::CappedTag<T, 64 / sizeof(T)>;
using Tag = TagOf<float>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

HWY_INLINE V all(float x) {
    return hn::Set(kTag, x);
}
template <class Vector>
HWY_INLINE Vector squared(Vector x) {
    return hn::Mul(x, x);
}

/// Calls f(cosine) for every vector of angles.
template <class T, class F>
HWY_INLINE void for_each_vector(const T* cos_theta, std::size_t count, T* out, F f) {
    constexpr TagOf<T> tag;
    const std::size_t lanes = hn::Lanes(tag);
    std::size_t k = 0;
    for (; k + lanes <= count; k += lanes)
        hn::StoreU(f(hn::LoadU(tag, cos_theta + k)), tag, out + k);
    if (k == count) return;
    // The rest, through a vector of our own
    alignas(64) T rest[64 / sizeof(T)] = {};
    for (std::size_t n = k; n < count; ++n) rest[n - k] = cos_theta[n];
    hn::Store(f(hn::Load(tag, rest)), tag, rest);
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

template <class T>
HWY_INLINE void conductor(const T* cos_theta, std::size_t count, T n, T k, T* out) {
    using Vector = hn::Vec<TagOf<T>>;
    for_each_vector(cos_theta, count, out, [n, k](Vector c) HWY_ATTR {
        constexpr TagOf<T> tag;
        const Vector one = hn::Set(tag, T{1}), half = hn::Set(tag, T{0.5}), zero = hn::Zero(tag);
        const Vector s2 = hn::Mul(hn::Sub(one, c), hn::Add(one, c));
        // a + i b = sqrt((n + i k)^2 - sin^2): the larger part first, free of cancellation
        const Vector re = hn::Sub(hn::Set(tag, (n - k) * (n + k)), s2);
        const Vector im = hn::Set(tag, 2 * n * k);
        const Vector modulus = hn::Sqrt(hn::Add(squared(re), squared(im)));
        const Vector large = hn::Sqrt(hn::Mul(half, hn::Add(modulus, hn::Abs(re))));
        const Vector small = hn::Div(hn::Mul(half, im), large);
        const auto a_is_large = hn::Ge(re, zero);
        const Vector a = hn::IfThenElse(a_is_large, large, small);
        const Vector b2 = squared(hn::IfThenElse(a_is_large, small, large));
        // Rs = m / p and Rp = Rs q / r; their mean with one division
        const Vector m = hn::Add(squared(hn::Sub(a, c)), b2);
        const Vector p = hn::Add(squared(hn::Add(a, c)), b2);
        const Vector ac = hn::Mul(a, c), b2c2 = hn::Mul(b2, squared(c));
        const Vector q = hn::Add(squared(hn::Sub(ac, s2)), b2c2),
                     r = hn::Add(squared(hn::Add(ac, s2)), b2c2);
        return hn::Mul(half, hn::Div(hn::Mul(m, hn::Add(q, r)), hn::Mul(p, r)));
    });
}

void Conductor(const float* cos_theta, std::size_t count, float n, float k, float* out) {
    conductor(cos_theta, count, n, k, out);
}

void PreciseConductor(const double* cos_theta, std::size_t count, double n, double k, double* out) {
    conductor(cos_theta, count, n, k, out);
}

}  // namespace
}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(Schlick);
HWY_EXPORT(Dielectric);
HWY_EXPORT(Conductor);
HWY_EXPORT(PreciseConductor);

void schlick_lanes(std::span<const float> cos_theta, float f0, float* f) {
    HWY_DYNAMIC_DISPATCH(Schlick)(cos_theta.data(), cos_theta.size(), f0, f);
}
void dielectric_lanes(std::span<const float> cos_theta, float eta, float* f) {
    HWY_DYNAMIC_DISPATCH(Dielectric)(cos_theta.data(), cos_theta.size(), eta, f);
}
void conductor_lanes(std::span<const float> cos_theta, float n, float k, float* f) {
    HWY_DYNAMIC_DISPATCH(Conductor)(cos_theta.data(), cos_theta.size(), n, k, f);
}

void conductor_lanes(std::span<const double> cos_theta, double n, double k, double* f) {
    HWY_DYNAMIC_DISPATCH(PreciseConductor)(cos_theta.data(), cos_theta.size(), n, k, f);
}

}  // namespace asperity
#endif

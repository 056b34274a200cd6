// SPDX-License-Identifier: Apache-2.0
//
// Which way to gather is the faster one on this processor.

#if defined(ASPERITY_GATHERS_PAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_GATHERS_PAY_INL_H
#undef ASPERITY_GATHERS_PAY_INL_H
#else
#define ASPERITY_GATHERS_PAY_INL_H
#endif

#include <asperity/tracing/engines/wide/lanes-inl.h>

#include <algorithm>
#include <chrono>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

#if ASPERITY_GATHERS_AT_ONCE
/// Time of some hundred gathers of four heights, as a walk makes them; what they bring goes to
/// `total`, so that they are not left out.
template <Gather kGather>
HWY_NOINLINE std::chrono::steady_clock::duration time_of_gathers(const std::vector<float>& heights,
                                                                 std::int32_t pitch, float& total) {
    const auto begin = std::chrono::steady_clock::now();
    Floats sum = hn::Zero(kFloat);
    Ints at = hn::Mul(hn::Iota(kInt, 0), all(2 * pitch + 1));
    for (int n = 0; n < 200; ++n) {
        const Fields f = gather_squares<kGather>(heights.data(), pitch, at);
        sum = hn::Add(hn::Add(sum, hn::Mul(f.a, f.b)), hn::Mul(f.c, f.d));
        at = hn::And(hn::Add(at, all(1)), all(static_cast<std::int32_t>(heights.size() / 2) - 1));
    }
    total += hn::GetLane(hn::SumOfLanes(kFloat, sum));
    return std::chrono::steady_clock::now() - begin;
}

bool GathersPay() {
    constexpr std::int32_t kPitch = 112;
    const std::vector<float> heights(8192, 1.0f);
    auto one_by_one = std::chrono::steady_clock::duration::max(), at_once = one_by_one;
    float total = 0;
    for (int turn = 0; turn < 6; ++turn) {
        one_by_one =
            std::min(one_by_one, time_of_gathers<Gather::OneByOne>(heights, kPitch, total));
        at_once = std::min(at_once, time_of_gathers<Gather::AtOnce>(heights, kPitch, total));
    }
    // Beside other work they lose what they win here by little
    return total > 0 && 5 * at_once < 4 * one_by_one;
}
#else
bool GathersPay() {
    return false;
}
#endif

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

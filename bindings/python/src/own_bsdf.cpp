// SPDX-License-Identifier: Apache-2.0
#include "own_bsdf.h"

#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/models/microfacet.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace asperity::python {

std::size_t OwnBsdf::Hash::operator()(const Pair& pair) const {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const double x : pair) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

void OwnBsdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    std::fill(f.begin(), f.end(), 0.0);
    if (wi.z <= 0 || wo.z <= 0) return;
    // -0 + 0 is 0: the two zeros are one number here
    const Pair pair = {wi.x + 0.0, wi.y + 0.0, wi.z, wo.x + 0.0, wo.y + 0.0, wo.z};
    if (const auto found = known_.find(pair); found != known_.end()) {
        std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(found->second), channels_,
                    f.begin());
        return;
    }
    const std::lock_guard lock(mutex_);
    asked_.push_back(pair);
}

std::optional<BsdfSample> OwnBsdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    const Vec3 wo = sample_cosine(u1, u2);
    return BsdfSample{wo, wo.z / kPi};
}

double OwnBsdf::pdf(Vec3 wi, Vec3 wo) const {
    return wi.z > 0 && wo.z > 0 ? wo.z / kPi : 0;
}

OwnBsdf::OwnBsdf(nb::object eval, std::string name, int channels, bool isotropic)
    : eval_(std::move(eval)), name_(std::move(name)), channels_(channels), isotropic_(isotropic) {
    ways_.push_back(std::make_unique<LambertBrdf>(std::vector<double>{1.0}));
    for (const double alpha : {0.01, 0.04, 0.15, 0.5}) {
        MicrofacetSettings settings;
        settings.alpha_x = settings.alpha_y = alpha;
        ways_.push_back(std::make_unique<MicrofacetBrdf>(settings));
    }
}

void OwnBsdf::albedo(Vec3 wi, std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    if (wi.z <= 0) return;
    const int points = isotropic_ ? 256 : 128;
    std::array<double, kMaxBsdfChannels> values{};
    const std::span<double> f = std::span(values).first(static_cast<std::size_t>(channels_));
    for (const auto& way : ways_)
        for (int k = 0; k < points; ++k) {
            constexpr double kGolden = 0.6180339887498949;  // a lattice: even in both numbers
            const double u = (k + 0.5) / points, v = std::fmod(kGolden * (k + 0.5), 1.0);
            const auto drawn = way->sample(wi, u, v);
            if (!drawn || drawn->wo.z <= 0) continue;
            double density = 0;
            for (const auto& other : ways_) density += points * other->pdf(wi, drawn->wo);
            eval(wi, drawn->wo, f);
            for (std::size_t c = 0; c < f.size(); ++c) a[c] += f[c] * drawn->wo.z / density;
        }
}

bool OwnBsdf::answer() {
    if (asked_.empty()) return false;
    std::vector<Pair> pairs;
    std::swap(pairs, asked_);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    constexpr std::size_t kAtOnce = 1 << 18;
    for (std::size_t begin = 0; begin < pairs.size(); begin += kAtOnce)
        ask(pairs, begin, std::min(pairs.size(), begin + kAtOnce));
    return true;
}

void OwnBsdf::ask(const std::vector<Pair>& pairs, std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin, channels = static_cast<std::size_t>(channels_);
    std::vector<double> wi(3 * count), wo(3 * count);
    for (std::size_t k = 0; k < count; ++k) {
        std::copy_n(pairs[begin + k].begin(), 3, wi.begin() + static_cast<std::ptrdiff_t>(3 * k));
        std::copy_n(pairs[begin + k].begin() + 3, 3,
                    wo.begin() + static_cast<std::ptrdiff_t>(3 * k));
    }
    // The package's function turns what the user's eval gives into [pair, channel] of double
    const nb::object given =
        eval_(to_array(std::move(wi), {count, 3}), to_array(std::move(wo), {count, 3}));
    const auto f = nb::cast<nb::ndarray<const double, nb::ndim<2>, nb::c_contig>>(given);
    if (f.shape(0) != count || f.shape(1) != channels)
        throw Error(ErrorCode::Usage, "eval gave an array of another shape than before", name_);
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t c = 0; c < channels; ++c) {
            const double value = f.data()[k * channels + c];
            if (!(value >= 0) || std::isinf(value))
                throw Error(ErrorCode::Usage,
                            "eval gave " + std::to_string(value) + ", which is no BRDF", name_);
        }
        known_.emplace(pairs[begin + k], values_.size());
        values_.insert(values_.end(), f.data() + k * channels, f.data() + (k + 1) * channels);
    }
}

}  // namespace asperity::python

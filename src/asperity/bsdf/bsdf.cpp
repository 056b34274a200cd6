// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/lattice.h>
#include <asperity/core/directions.h>

#include <algorithm>
#include <array>

namespace asperity {

void albedo_by_sampling(const Bsdf& brdf, Vec3 wi, FibonacciLattice lattice, std::span<double> a) {
    std::fill(a.begin(), a.end(), 0.0);
    std::array<double, kMaxBsdfChannels> values{};
    const std::span<double> f = std::span(values).first(a.size());
    for (int i = 0; i < lattice.points; ++i) {
        const double u1 = (i + 0.5) / lattice.points;
        const double u2 = (i * lattice.step % lattice.points + 0.5) / lattice.points;
        const std::optional<BsdfSample> s = brdf.sample(wi, u1, u2);
        if (!s) continue;
        brdf.eval(wi, s->wo, f);
        for (std::size_t c = 0; c < a.size(); ++c) a[c] += f[c] * s->wo.z / s->pdf;
    }
    for (double& value : a) value /= lattice.points;
}

std::vector<std::string> Bsdf::channel_names() const {
    const int count = channels();
    if (count == 1) return {"all"};
    if (count == 3) return {"R", "G", "B"};
    std::vector<std::string> names;
    for (int c = 1; c <= count; ++c) names.push_back("c" + std::to_string(c));
    return names;
}

void Bsdf::eval_many(Vec3 wi, std::span<const Vec3> wo, std::span<double> f) const {
    const std::size_t count = static_cast<std::size_t>(channels());
    for (std::size_t k = 0; k < wo.size(); ++k) eval(wi, wo[k], f.subspan(k * count, count));
}

void Bsdf::eval_at_facets(std::span<const Vec3> wi, std::span<const Vec3> wm,
                          std::span<double> f) const {
    const std::size_t each = wm.size() * static_cast<std::size_t>(channels());
    std::vector<Vec3> wo(wm.size());
    for (std::size_t light = 0; light < wi.size(); ++light) {
        for (std::size_t k = 0; k < wm.size(); ++k) wo[k] = reflect(wi[light], wm[k]);
        eval_many(wi[light], wo, f.subspan(light * each, each));
    }
}

void Bsdf::albedo(Vec3 wi, std::span<double> a) const {
    albedo_by_sampling(*this, wi, kFineLattice, a);
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/brdf/brdf.h>
#include <asperity/brdf/lattice.h>

#include <algorithm>
#include <array>

namespace asperity {

void albedo_by_sampling(const Brdf& brdf, Vec3 wi, FibonacciLattice lattice, std::span<double> a) {
    std::fill(a.begin(), a.end(), 0.0);
    std::array<double, kMaxBrdfChannels> values{};
    const std::span<double> f = std::span(values).first(a.size());
    for (int i = 0; i < lattice.points; ++i) {
        const double u1 = (i + 0.5) / lattice.points;
        const double u2 = (i * lattice.step % lattice.points + 0.5) / lattice.points;
        const std::optional<BrdfSample> s = brdf.sample(wi, u1, u2);
        if (!s) continue;
        brdf.eval(wi, s->wo, f);
        for (std::size_t c = 0; c < a.size(); ++c) a[c] += f[c] * s->wo.z / s->pdf;
    }
    for (double& value : a) value /= lattice.points;
}

void Brdf::albedo(Vec3 wi, std::span<double> a) const {
    albedo_by_sampling(*this, wi, kFineLattice, a);
}

}  // namespace asperity

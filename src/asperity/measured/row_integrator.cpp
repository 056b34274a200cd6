// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/row_integrator.h>

namespace asperity::detail {

namespace {

/// The middle, and the points of the second rule.
constexpr std::array<double, 3> kPoints = {PatchIntegrator::kNodes1[0], PatchIntegrator::kNodes2[0],
                                           PatchIntegrator::kNodes2[1]};

/// f at one polar angle and some azimuths, [k * channels + c].
struct Ring {
    double sine = 0, cosine = 1;
    std::vector<Vec3> wo;
    std::vector<double> f;

    Ring(double s, std::size_t count) : sine(std::sqrt(s)), cosine(std::sqrt(1 - s)) {
        wo.reserve(count);
    }
    void add(double cos_phi, double sin_phi) {
        wo.push_back({sine * cos_phi, sine * sin_phi, cosine});
    }
    void eval(const PatchIntegrator& patches, std::size_t channels) {
        f.resize(wo.size() * channels);
        patches.brdf().eval_many(patches.wi(), wo, f);
    }
};

}  // namespace

RowIntegrator::RowIntegrator(const CellIntegrator& cells, const Detector& detector,
                             std::span<const int> columns)
    : cells_(cells),
      detector_(detector),
      channels_(static_cast<std::size_t>(cells.at_turn(0).brdf().channels())),
      columns_(columns.size()) {
    for (const double turn : cells.turns()) {
        Azimuths& azimuths = azimuths_.emplace_back();
        for (const int column : columns) {
            azimuths.from.push_back(detector.phi_edge(column) + turn);
            azimuths.to.push_back(detector.phi_edge(column + 1) + turn);
        }
        for (const double point : kPoints) {
            for (std::size_t k = 0; k < columns_; ++k) {
                const double phi = azimuths.from[k] + point * (azimuths.to[k] - azimuths.from[k]);
                azimuths.cosine.push_back(std::cos(phi));
                azimuths.sine.push_back(std::sin(phi));
            }
        }
    }
}

void RowIntegrator::integrate(int row, std::span<double> energy) const {
    const double sin0 = std::sin(detector_.theta_edge(row));
    const double sin1 = std::sin(detector_.theta_edge(row + 1));
    const double count = static_cast<double>(azimuths_.size());
    std::fill(energy.begin(), energy.end(), 0.0);
    std::vector<double> of_turn(energy.size());
    for (std::size_t turn = 0; turn < azimuths_.size(); ++turn) {
        integrate_turn(turn, sin0 * sin0, sin1 * sin1, of_turn);
        for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += of_turn[k] / count;
    }
}

/// As PatchIntegrator::integrate has it.
void RowIntegrator::integrate_turn(std::size_t turn, double s0, double s1,
                                   std::span<double> energy) const {
    const PatchIntegrator& patches = cells_.at_turn(turn);
    const Azimuths& azimuths = azimuths_[turn];
    std::fill(energy.begin(), energy.end(), 0.0);
    const auto patch = [&](std::size_t k) {
        return Patch{s0, s1, azimuths.from[k], azimuths.to[k]};
    };

    std::vector<std::size_t> far;  // from the mirror direction
    std::vector<Ring> rings;
    for (const double point : kPoints) rings.emplace_back(s0 + point * (s1 - s0), 2 * columns_);
    for (std::size_t k = 0; k < columns_; ++k) {
        if (patches.near_mirror(patch(k))) {
            patches.integrate(patch(k), energy.subspan(k * channels_, channels_));
            continue;
        }
        far.push_back(k);
        const auto add = [&](std::size_t ring, std::size_t point) {
            const std::size_t place = point * columns_ + k;
            rings[ring].add(azimuths.cosine[place], azimuths.sine[place]);
        };
        add(0, 0);
        for (const std::size_t ring : {1u, 2u})
            for (const std::size_t point : {1u, 2u}) add(ring, point);
    }
    for (Ring& ring : rings) ring.eval(patches, channels_);

    for (std::size_t n = 0; n < far.size(); ++n) {
        const Patch p = patch(far[n]);
        const double area = 0.5 * (p.s1 - p.s0) * (p.phi1 - p.phi0);
        Channels one, two;
        for (std::size_t c = 0; c < channels_; ++c) {
            one[c] = rings[0].f[n * channels_ + c] * area;
            const auto f = [&](std::size_t ring, std::size_t point) {
                constexpr double kWeight =
                    PatchIntegrator::kWeights2[0] * PatchIntegrator::kWeights2[1];
                return kWeight * rings[ring].f[(2 * n + point) * channels_ + c];
            };
            two[c] = (f(1, 0) + f(1, 1) + f(2, 0) + f(2, 1)) * area;
        }
        const std::span<double> sum = energy.subspan(far[n] * channels_, channels_);
        if (!patches.differ_little(one, two))
            patches.integrate_closer(p, two, sum);
        else
            std::copy_n(two.begin(), channels_, sum.begin());
    }
}

}  // namespace asperity::detail

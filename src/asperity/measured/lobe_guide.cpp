// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf.h>
#include <asperity/core/directions.h>
#include <asperity/core/parallel.h>
#include <asperity/measured/lobe_guide.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace asperity {
namespace {

constexpr double kFloor = 0.01;  // of the largest value of D
constexpr double kBroad = 0.25;  // alpha from which on cells show all there is
// Facets less tilted send light from above far enough up.
const double kSeen = std::cos(radians(40));

constexpr int kTilts = 90, kTurns = 72;  // where D is looked at for its integrals
constexpr int kDistributionSide = 257, kSigmaSide = 49;

}  // namespace

double LobeGuide::DirectionTable::at(Vec3 direction) const {
    const HalfVectorMap::Place place = map.place(direction);
    const double half = 0.5 * (side - 1);
    const double x = (place.x + 1) * half, y = (place.y + 1) * half;
    const int column = std::clamp(static_cast<int>(x), 0, side - 2);
    const int row = std::clamp(static_cast<int>(y), 0, side - 2);
    const double s = x - column, t = y - row;
    const float* const corner = values.data() + row * side + column;
    const auto value = [&](int k) { return static_cast<double>(corner[k]); };
    return (1 - t) * ((1 - s) * value(0) + s * value(1)) +
           t * ((1 - s) * value(side) + s * value(side + 1));
}

Vec3 LobeGuide::DirectionTable::node(int row, int column) const {
    const double step = 2.0 / (side - 1);
    return normalize(map.half_vector(column * step - 1, row * step - 1));
}

LobeGuide::LobeGuide(const LayerTable& table, Vec3 wi, int threads) {
    // What D says asks for sigma, and sigma for D: as the cosine at first, where nothing is hidden.
    for (int k = 0; k < 3; ++k) {
        const std::vector<Facet> facets = find_facets(table, wi);
        if (facets.empty() || tail_ > kBroad * kBroad) {
            const double width = std::sqrt(tail_);
            *this = LobeGuide();
            distribution_.map.stretch = width;
            return;
        }
        find_sigma(facets, threads);
    }
    distribution_ = {{std::sqrt(tail_)}, kDistributionSide, {}};
    std::vector<float> values(kDistributionSide * kDistributionSide);
    parallel_for(kDistributionSide, threads, [&](std::size_t row) {
        for (std::size_t column = 0; column < kDistributionSide; ++column) {
            const Vec3 wm = distribution_.node(static_cast<int>(row), static_cast<int>(column));
            values[row * kDistributionSide + column] =
                static_cast<float>(floor_ + seen_distribution(table, wi, wm));
        }
    });
    distribution_.values = std::move(values);
}

/// The facets that are seen, also the floor and the tail. Empty where there is no light.
std::vector<LobeGuide::Facet> LobeGuide::find_facets(const LayerTable& table, Vec3 wi) {
    std::vector<Facet> facets;
    double projected = 0, squares = 0, most = 0;
    for (int i = 0; i < kTilts; ++i) {
        const double theta = radians((i + 0.5) * 90 / kTilts);
        for (int j = 0; j < kTurns; ++j) {
            const Vec3 wm = from_spherical(theta, 2 * kPi * j / kTurns);
            const double d = seen_distribution(table, wi, wm);
            const double weight = d * std::sin(theta), cos2 = wm.z * wm.z;
            if (!(weight > 0)) continue;
            facets.push_back({wm, weight});
            most = std::max(most, d);
            projected += weight * wm.z;
            if (wm.z >= kSeen) squares += weight * wm.z * (1 - cos2) / cos2;
        }
    }
    if (!(projected > 0)) return {};
    tail_ = std::clamp(squares / projected, 1e-6, 4.0);
    floor_ = kFloor * most;
    return facets;
}

void LobeGuide::find_sigma(const std::vector<Facet>& facets, int threads) {
    double projected = 0;
    for (const Facet& facet : facets) projected += facet.weight * facet.wm.z;
    DirectionTable sigma{{}, kSigmaSide, std::vector<float>(kSigmaSide * kSigmaSide)};
    parallel_for(kSigmaSide, threads, [&](std::size_t row) {
        std::array<double, kSigmaSide> x, y, z, sum{};
        for (std::size_t k = 0; k < kSigmaSide; ++k) {
            const Vec3 w = sigma.node(static_cast<int>(row), static_cast<int>(k));
            x[k] = w.x;
            y[k] = w.y;
            z[k] = w.z;
        }
        for (const auto& [wm, weight] : facets) {
            for (std::size_t k = 0; k < kSigmaSide; ++k) {
                const double cosine = x[k] * wm.x + y[k] * wm.y + z[k] * wm.z;
                sum[k] += weight * (cosine > 0 ? cosine : 0);
            }
        }
        for (std::size_t k = 0; k < kSigmaSide; ++k)
            sigma.values[row * kSigmaSide + k] = static_cast<float>(sum[k] / projected);
    });
    sigma_ = std::move(sigma);
}

double LobeGuide::sigma(Vec3 w) const {
    w.z = std::max(0.0, w.z);
    if (is_known()) return sigma_.at(w);
    constexpr double kSoftness = 0.15;
    return std::sqrt(w.z * w.z + kSoftness * kSoftness);
}

double LobeGuide::seen_distribution(const LayerTable& table, Vec3 wi, Vec3 wm) const {
    // Facets so steep that their light leaves near the horizon or below are guessed from those less
    // steep: a Gaussian's tail.
    double beyond = 1;
    if (wm.z < kSeen) {
        const double cos2 = std::max(wm.z * wm.z, 1e-12), seen2 = kSeen * kSeen;
        beyond = std::exp((1 / seen2 - 1 / cos2) / tail_);
        if (wm.z <= 0 || beyond < 1e-9) return 0;
        const double r = std::sqrt((1 - seen2) / (1 - cos2));
        wm = {r * wm.x, r * wm.y, kSeen};
    }
    const Vec3 wo = reflect(wi, wm);
    if (wo.z <= 0) return 0;
    std::array<double, kMaxBsdfChannels> f;
    const std::span<double> channels = std::span(f).first(table.channels());
    table.eval(wo, channels);
    double sum = 0;
    for (const double value : channels) sum += value;
    return beyond * sum * (is_known() ? sigma(wo) : wo.z);
}

double LobeGuide::operator()(Vec3 wi, Vec3 wo, Vec3 m) const {
    return facets(m) / (sigma(wi) * sigma(wo));
}

void LobeGuide::albedo_over_facets(const Bsdf& brdf, Vec3 wi, FibonacciLattice lattice,
                                   std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    std::array<double, kMaxBsdfChannels> values;
    const std::span<double> f = std::span(values).first(a.size());
    const HalfVectorMap& map = distribution_.map;
    for (int k = 0; k < lattice.points; ++k) {
        // A point of the disk, and the facet there
        const double u = (k + 0.5) / lattice.points;
        const double v = std::fmod(static_cast<double>(k) * lattice.step / lattice.points, 1.0);
        const double r = std::sqrt(u), x = r * std::cos(2 * kPi * v), y = r * std::sin(2 * kPi * v);
        const Vec3 h = map.half_vector(x, y);
        if (!(dot(wi, h) > 0)) continue;
        const Vec3 wo = reflect(wi, normalize(h));
        if (!(wo.z > 0)) continue;
        brdf.eval(wi, wo, f);
        const double weight = kPi * wo.z / (map.density(x, y, h, wi) * lattice.points);
        for (std::size_t c = 0; c < a.size(); ++c) a[c] += weight * f[c];
    }
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// How a baked BRDF is evaluated and sampled; bake_brdf.cpp makes it.
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/baked_tables.h>
#include <asperity/measured/cosine_share.h>

namespace asperity {

namespace {

using detail::kCosineShare;

/// The step of a cumulated list of `count` in which u falls, by halving without branches; u becomes
/// the place in the step.
int find_step(const float* list, int count, double& u) {
    const float wanted = static_cast<float>(u);
    int found = 0;
    for (int left = count; left > 1;) {
        const int half = left / 2;
        found += list[found + half - 1] <= wanted ? half : 0;
        left -= half;
    }
    const double low = found == 0 ? 0.0 : static_cast<double>(list[found - 1]);
    const double width = static_cast<double>(list[found]) - low;
    u = width > 0 ? std::clamp((u - low) / width, 0.0, 1.0) : 0.5;
    return found;
}

}  // namespace

BakedBrdf::Tables::Incidence BakedBrdf::Tables::incidence(Vec3 wi) const {
    Incidence in;
    in.theta = polar_place(wi.z) * (thetas - 1);
    if (!isotropic) {
        in.phi = azimuth_place(wi.x, wi.y) * 0.25 * phis;
        return in;
    }
    const double r = std::sqrt(wi.x * wi.x + wi.y * wi.y);
    if (r > 0) {
        in.cosine = wi.x / r;
        in.sine = wi.y / r;
    }
    return in;
}

template <int kChannels, bool kIsotropic>
std::array<double, kChannels> BakedBrdf::Tables::at_incidence(const std::vector<float>& values,
                                                              const Incidence& in) const {
    const double theta = in.theta * kFine, phi = in.phi * kFine;
    const int columns = fine_phis();
    const int t = whole(theta, fine_thetas() - 2), p = whole(phi, columns - 1);
    const double above = theta - t, beyond = phi - p;
    const auto column_at = [&](int column, int channel) {
        const float* value = values.data() + (t * columns + column) * kChannels + channel;
        return (1 - above) * static_cast<double>(value[0]) +
               above * static_cast<double>(value[columns * kChannels]);
    };
    std::array<double, kChannels> result;
    double* to = result.data();
    for (int c = 0; c < kChannels; ++c) {
        to[c] = column_at(p, c);
        if constexpr (!kIsotropic)
            to[c] = (1 - beyond) * to[c] + beyond * column_at(p + 1 < columns ? p + 1 : 0, c);
    }
    return result;
}

template <int kChannels, bool kIsotropic>
double BakedBrdf::Tables::look(Vec3 wi, Vec3 wo, double* f) const {
    // Find the half vector in the frame of the slices, and the cell it lies in.
    const Incidence in = incidence(wi);
    Vec3 m = wi + wo;
    if (kIsotropic) {
        m = {m.x * in.cosine + m.y * in.sine, m.y * in.cosine - m.x * in.sine, m.z};
    }
    const HalfVectorMap::Place place = map.place(m);
    const double half = 0.5 * (side - 1);
    const double x = (place.x + 1) * half, y = (place.y + 1) * half;
    const int column = whole(x, side - 2), row = whole(y, side - 2);
    const double right = x - column, down = y - row;
    const double weights[] = {(1 - right) * (1 - down), right * (1 - down), (1 - right) * down,
                              right * down};

    // Blend the corners of the cell in each slice, and the slices.
    constexpr int kRecord = kChannels + 1;
    const std::size_t corner = static_cast<std::size_t>(row * side + column);
    const int next_row = side * kRecord;
    double sum[kChannels] = {};
    double density = 0;
    const Shares<kIsotropic> all = shares<kIsotropic>(in);
    for (std::size_t k = 0; k < all.kCount; ++k) {
        const float* node = nodes.data() + (all.slice[k] * nodes_per_slice() + corner) * kRecord;
        for (int c = 0; c < kChannels; ++c) {
            const float* value = node + c;
            sum[c] += all.weight[k] * (weights[0] * static_cast<double>(value[0]) +
                                       weights[1] * static_cast<double>(value[kRecord]) +
                                       weights[2] * static_cast<double>(value[next_row]) +
                                       weights[3] * static_cast<double>(value[next_row + kRecord]));
        }
        density += all.weight[k] * static_cast<double>(node[kChannels]);
    }

    // Keep the albedo, and take the cosines off again.
    const auto correction = at_incidence<kChannels, kIsotropic>(corrections, in);
    const double scale = 1 / (wi.z + wo.z);
    for (int c = 0; c < kChannels; ++c)
        f[c] = sum[c] * correction[static_cast<std::size_t>(c)] * scale;
    return density * place.density;
}

double BakedBrdf::Tables::look(Vec3 wi, Vec3 wo, double* f) const {
    if (channels == 1) return isotropic ? look<1, true>(wi, wo, f) : look<1, false>(wi, wo, f);
    return isotropic ? look<3, true>(wi, wo, f) : look<3, false>(wi, wo, f);
}

template <bool kIsotropic>
BsdfSample BakedBrdf::Tables::draw(Vec3 wi, double u1, double u2) const {
    // Choose a slice by its weight.
    const Incidence in = incidence(wi);
    const Shares<kIsotropic> all = shares<kIsotropic>(in);
    std::size_t chosen = 0;
    for (std::size_t next = 1; next < all.kCount && u1 >= all.weight[chosen]; ++next) {
        if (!(all.weight[next] > 0)) continue;
        u1 -= all.weight[chosen];
        chosen = next;
    }
    u1 = std::min(u1 / all.weight[chosen], 1.0);

    // Draw a cell of it, and a half vector in the cell.
    const int cells_across = side - 1;
    const std::size_t slice_rows = all.slice[chosen] * cells_per_row();
    const int row = find_step(rows.data() + slice_rows, cells_across, u1);
    const int column =
        find_step(cells.data() + (slice_rows + static_cast<std::size_t>(row)) * cells_per_row(),
                  cells_across, u2);
    const double x = position(column + u2), y = position(row + u1);
    const Vec3 turned = map.half_vector(x, y);
    if (turned.z <= 0) return {};
    Vec3 h = turned;
    if (kIsotropic) {
        h = {h.x * in.cosine - h.y * in.sine, h.y * in.cosine + h.x * in.sine, h.z};
    }

    // Mirror the light at it; all slices might have drawn this cell.
    const double cosine = dot(wi, h);
    const Vec3 wo = (2 * cosine / dot(h, h)) * h - wi;
    if (wo.z <= 0) return {};
    const std::size_t corner = static_cast<std::size_t>(row * side + column);
    double density = 0;
    for (std::size_t k = 0; k < all.kCount; ++k) {
        const std::size_t node = all.slice[k] * nodes_per_slice() + corner;
        density += all.weight[k] * static_cast<double>(nodes[node * record() + record() - 1]);
    }
    return {wo, density * map.density(x, y, h, wi)};
}

double BakedBrdf::eval_pdf(Vec3 wi, Vec3 wo, std::span<double> f) const {
    if (wi.z <= 0 || wo.z <= 0) {
        std::fill(f.begin(), f.end(), 0.0);
        return 0;
    }
    const double density = tables_->look(wi, wo, f.data());
    return kCosineShare * wo.z / kPi + (1 - kCosineShare) * density;
}

void BakedBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    eval_pdf(wi, wo, f);
}

double BakedBrdf::pdf(Vec3 wi, Vec3 wo) const {
    std::array<double, 3> f;
    return eval_pdf(wi, wo, f);
}

std::optional<BsdfSample> BakedBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    if (u1 < kCosineShare) {
        const Vec3 wo = sample_cosine(u1 / kCosineShare, u2);
        return BsdfSample{wo, pdf(wi, wo)};
    }
    const double u = (u1 - kCosineShare) / (1 - kCosineShare);
    BsdfSample drawn =
        isotropic_ ? tables_->draw<true>(wi, u, u2) : tables_->draw<false>(wi, u, u2);
    if (drawn.wo.z <= 0) return std::nullopt;
    drawn.pdf = kCosineShare * drawn.wo.z / kPi + (1 - kCosineShare) * drawn.pdf;
    return drawn;
}

void BakedBrdf::albedo(Vec3 wi, std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    if (wi.z <= 0) return;
    const auto write = [&](const auto& values) {
        std::copy(values.begin(), values.end(), a.begin());
    };
    const Tables& t = *tables_;
    const Tables::Incidence in = t.incidence(wi);
    if (channels_ == 1) {
        write(isotropic_ ? t.at_incidence<1, true>(t.albedos, in)
                         : t.at_incidence<1, false>(t.albedos, in));
    } else {
        write(isotropic_ ? t.at_incidence<3, true>(t.albedos, in)
                         : t.at_incidence<3, false>(t.albedos, in));
    }
}

}  // namespace asperity

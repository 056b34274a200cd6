// SPDX-License-Identifier: Apache-2.0
#include "sketch.h"

#include "picture_rows.h"

#include <algorithm>
#include <array>
#include <limits>

namespace asperity::studio {

namespace {

/// A pixel whose neighbours are so little like it looks farther for others.
constexpr float kAlike = 0.05F;
/// And one that finds none there either is sampled itself.
constexpr float kAtAll = 0.002F;
constexpr float kWhole = 255;

/// How much two pixels are of one surface, 0 .. 1: by their normals, and by how far one lies off
/// the plane of the other; `reach` is as far as it may. What hits nothing is alike too.
float likeness(const PixelGuides& a, std::size_t k, const PixelGuides& b, std::size_t m,
               float reach) {
    if (!(a.reach[k] > 0) || !(b.reach[m] > 0)) return a.reach[k] == b.reach[m] ? 1 : 0;
    float alike = a.nx[k] * b.nx[m] + a.ny[k] * b.ny[m] + a.nz[k] * b.nz[m];
    if (!(alike > 0)) return 0;
    alike *= alike;  // to the 16th power
    alike *= alike;
    alike *= alike;
    alike *= alike;
    const float off = a.nx[k] * (b.px[m] - a.px[k]) + a.ny[k] * (b.py[m] - a.py[k]) +
                      a.nz[k] * (b.pz[m] - a.pz[k]);
    const float share = off / reach;
    return alike * std::max(0.0F, 1 - share * share);
}

/// Brings a pixel that stands out of all its neighbours of the same surface back among them: one
/// path in many that found a bright light, or one that passed by an edge.
Rgb among_neighbours(const Film& film, const PixelGuides& guides, int x, int y) {
    constexpr float kSame = 0.3F;
    const std::size_t k = pixel_index(guides.width, x, y);
    const Rgb own = film.at(x, y).mean;
    if (!(guides.reach[k] > 0)) return own;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Rgb least{kNone, kNone, kNone}, most{-kNone, -kNone, -kNone};
    for (int v = std::max(0, y - 1); v <= std::min(guides.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(guides.width - 1, x + 1); ++u) {
            const std::size_t m = pixel_index(guides.width, u, v);
            if (m == k || likeness(guides, k, guides, m, guides.reach[k]) < kSame) continue;
            const Rgb c = film.at(u, v).mean;
            least = {std::min(least.r, c.r), std::min(least.g, c.g), std::min(least.b, c.b)};
            most = {std::max(most.r, c.r), std::max(most.g, c.g), std::max(most.b, c.b)};
        }
    if (least.r > most.r) return own;  // none is like it
    return {std::clamp(own.r, least.r, most.r), std::clamp(own.g, least.g, most.g),
            std::clamp(own.b, least.b, most.b)};
}

/// Of a pixel at `place` among nodes: the two it lies between, and how far from the first.
struct Between {
    int first, second;
    float t;
};

Between between(int place, int stride, int nodes) {
    const int first = place / stride;
    return {first, std::min(first + 1, nodes - 1),
            static_cast<float>(place % stride) / static_cast<float>(stride)};
}

}  // namespace

struct Sketch::Blend {
    static constexpr std::size_t kMost = 16;
    std::array<std::size_t, kMost> node;
    std::array<float, kMost> weight;
    std::size_t count = 0;
    float sum = 0;
};

std::size_t Sketch::pixel_of(int column, int row) const {
    return pixel_index(guides_.width, column * stride_, row * stride_);
}

Sketch::Sketch(const PixelGuides& guides, int stride, Run& run)
    : guides_(guides),
      stride_(stride),
      nodes_{(guides.width + stride - 1) / stride,
             (guides.height + stride - 1) / stride,
             {},
             {},
             {},
             {},
             {},
             {},
             {}},
      chosen_(guides.reach.size(), 0),
      shares_(guides.reach.size()) {
    const auto pick = [&](const std::vector<float>& from, std::vector<float>& to, float factor) {
        to.reserve(static_cast<std::size_t>(nodes_.width) *
                   static_cast<std::size_t>(nodes_.height));
        for (int row = 0; row < nodes_.height; ++row)
            for (int column = 0; column < nodes_.width; ++column)
                to.push_back(factor * from[pixel_of(column, row)]);
    };
    pick(guides.nx, nodes_.nx, 1);
    pick(guides.ny, nodes_.ny, 1);
    pick(guides.nz, nodes_.nz, 1);
    pick(guides.px, nodes_.px, 1);
    pick(guides.py, nodes_.py, 1);
    pick(guides.pz, nodes_.pz, 1);
    pick(guides.reach, nodes_.reach, static_cast<float>(stride));

    each_row(guides.height, run, [&](int y) {
        const std::size_t width = static_cast<std::size_t>(guides.width);
        liken(y, std::span(shares_).subspan(static_cast<std::size_t>(y) * width, width));
    });
    for (int row = 0; row < nodes_.height; ++row)
        for (int column = 0; column < nodes_.width; ++column) chosen_[pixel_of(column, row)] = 1;
}

void Sketch::liken(int y, std::span<Shares> row) {
    const Between v = between(y, stride_, nodes_.height);
    const std::size_t upper = pixel_index(nodes_.width, 0, v.first),
                      lower = pixel_index(nodes_.width, 0, v.second);
    for (std::size_t x = 0; x < row.size(); ++x) {
        const std::size_t pixel = pixel_index(guides_.width, 0, y) + x;
        const Between h = between(static_cast<int>(x), stride_, nodes_.width);
        const auto left = static_cast<std::size_t>(h.first),
                   right = static_cast<std::size_t>(h.second);
        const float reach = static_cast<float>(stride_) * guides_.reach[pixel];
        const auto like = [&](std::size_t node) {
            return likeness(guides_, pixel, nodes_, node, reach);
        };
        const std::array<float, 4> w = {
            (1 - h.t) * (1 - v.t) * like(upper + left), h.t * (1 - v.t) * like(upper + right),
            (1 - h.t) * v.t * like(lower + left), h.t * v.t * like(lower + right)};
        const float sum = w[0] + w[1] + w[2] + w[3];
        if (sum >= kAlike) {
            for (std::size_t k = 0; k < 4; ++k)
                row[x][k] = static_cast<std::uint8_t>(w[k] * (kWhole / sum) + 0.5F);
        } else {
            chosen_[pixel] = look_farther(static_cast<int>(x), y).sum < kAtAll ? 1 : 0;
        }
    }
}

void Sketch::add_node(int column, int row, float weight, std::size_t pixel, Blend& blend) const {
    const std::size_t node = pixel_index(nodes_.width, column, row);
    const float reach = static_cast<float>(stride_) * guides_.reach[pixel];
    const float w = weight * likeness(guides_, pixel, nodes_, node, reach);
    if (!(w > 0)) return;
    blend.node[blend.count] = node;
    blend.weight[blend.count++] = w;
    blend.sum += w;
}

Sketch::Blend Sketch::look_farther(int x, int y) const {
    const std::size_t pixel = pixel_index(guides_.width, x, y);
    const int first_column = x / stride_ - 1, first_row = y / stride_ - 1;
    Blend blend;
    for (int row = std::max(0, first_row); row < std::min(first_row + 4, nodes_.height); ++row)
        for (int column = std::max(0, first_column);
             column < std::min(first_column + 4, nodes_.width); ++column)
            add_node(column, row, 1.0F / Blend::kMost, pixel, blend);
    return blend;
}

void Sketch::fill(int y, const Film& film, const std::vector<float>& nodes, float* out) const {
    const Between v = between(y, stride_, nodes_.height);
    const float* const upper = nodes.data() + 3 * pixel_index(nodes_.width, 0, v.first);
    const float* const lower = nodes.data() + 3 * pixel_index(nodes_.width, 0, v.second);
    for (int x = 0; x < guides_.width; ++x, out += 3) {
        const std::size_t pixel = pixel_index(guides_.width, x, y);
        const Between h = between(x, stride_, nodes_.width);
        const Shares& share = shares_[pixel];
        const int sum = share[0] + share[1] + share[2] + share[3];
        if (sum > 0) {
            const float unit = 1 / static_cast<float>(sum);
            for (int c = 0; c < 3; ++c)
                out[c] = unit * (static_cast<float>(share[0]) * upper[3 * h.first + c] +
                                 static_cast<float>(share[1]) * upper[3 * h.second + c] +
                                 static_cast<float>(share[2]) * lower[3 * h.first + c] +
                                 static_cast<float>(share[3]) * lower[3 * h.second + c]);
        } else if (chosen_[pixel] != 0) {
            const Rgb mean = film.pixels()[pixel].mean;
            out[0] = static_cast<float>(mean.r);
            out[1] = static_cast<float>(mean.g);
            out[2] = static_cast<float>(mean.b);
        } else {
            const Blend from = look_farther(x, y);
            for (std::size_t n = 0; n < from.count; ++n)
                for (std::size_t c = 0; c < 3; ++c)
                    out[c] += from.weight[n] / from.sum * nodes[3 * from.node[n] + c];
        }
    }
}

std::vector<float> Sketch::filled(const Film& film, Run& run) const {
    Film sampled(nodes_.width, nodes_.height);
    for (int row = 0; row < nodes_.height; ++row)
        for (int column = 0; column < nodes_.width; ++column)
            sampled.at(column, row) = film.pixels()[pixel_of(column, row)];
    Film calm = sampled;
    each_row(nodes_.height, run, [&](int row) {
        for (int column = 0; column < nodes_.width; ++column)
            calm.at(column, row).mean = among_neighbours(sampled, nodes_, column, row);
    });
    const std::vector<float> clean = denoised(calm, nodes_, run);

    std::vector<float> rgb(3 * film.pixels().size());
    each_row(guides_.height, run, [&](int y) {
        fill(y, film, clean, rgb.data() + 3 * pixel_index(guides_.width, 0, y));
    });
    return rgb;
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "sketch.h"

#include "picture_rows.h"

#include <algorithm>
#include <array>

namespace asperity::studio {

namespace {

/// A pixel whose neighbours are so little like it looks farther for others.
constexpr float kAlike = 0.05F;
/// And one that finds none there either is sampled itself.
constexpr float kAtAll = 0.002F;

/// How much two pixels are of one surface, 0 .. 1: by their normals, and by how far one lies off
/// the plane of the other; `reach` is as far as it may.
float likeness(const PixelGuides& a, std::size_t k, const PixelGuides& b, std::size_t m,
               float reach) {
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
      chosen_(guides.reach.size(), 0) {
    const auto pick = [&](const std::vector<float>& from, std::vector<float>& to, float factor) {
        to.reserve(static_cast<std::size_t>(nodes_.width) *
                   static_cast<std::size_t>(nodes_.height));
        for (int row = 0; row < nodes_.height; ++row)
            for (int column = 0; column < nodes_.width; ++column)
                to.push_back(
                    factor * from[pixel_of(column, row)]);
    };
    pick(guides.nx, nodes_.nx, 1);
    pick(guides.ny, nodes_.ny, 1);
    pick(guides.nz, nodes_.nz, 1);
    pick(guides.px, nodes_.px, 1);
    pick(guides.py, nodes_.py, 1);
    pick(guides.pz, nodes_.pz, 1);
    pick(guides.reach, nodes_.reach, static_cast<float>(stride));

    each_row(guides.height, run, [&](int y) {
        for (int x = 0; x < guides.width; ++x) {
            const std::size_t k = pixel_index(guides.width, x, y);
            chosen_[k] = !(guides.reach[k] > 0) || blend(x, y).sum < kAtAll ? 1 : 0;
        }
    });
    for (int row = 0; row < nodes_.height; ++row)
        for (int column = 0; column < nodes_.width; ++column)
            chosen_[pixel_of(column, row)] = 1;
}

void Sketch::add_node(int column, int row, float weight, std::size_t pixel, Blend& blend) const {
    const std::size_t node = pixel_index(nodes_.width, column, row);
    const float reach = static_cast<float>(stride_) * guides_.reach[pixel];
    if (!(nodes_.reach[node] > 0)) return;
    const float w = weight * likeness(guides_, pixel, nodes_, node, reach);
    if (!(w > 0)) return;
    blend.node[blend.count] = node;
    blend.weight[blend.count++] = w;
    blend.sum += w;
}

Sketch::Blend Sketch::blend(int x, int y) const {
    const std::size_t pixel = pixel_index(guides_.width, x, y);
    const Between h = between(x, stride_, nodes_.width), v = between(y, stride_, nodes_.height);
    Blend blend;
    add_node(h.first, v.first, (1 - h.t) * (1 - v.t), pixel, blend);
    add_node(h.second, v.first, h.t * (1 - v.t), pixel, blend);
    add_node(h.first, v.second, (1 - h.t) * v.t, pixel, blend);
    add_node(h.second, v.second, h.t * v.t, pixel, blend);
    if (blend.sum >= kAlike) return blend;
    // One farther on every side
    blend.count = 0;
    blend.sum = 0;
    for (int row = std::max(0, v.first - 1); row <= std::min(v.first + 2, nodes_.height - 1); ++row)
        for (int column = std::max(0, h.first - 1);
             column <= std::min(h.first + 2, nodes_.width - 1); ++column)
            add_node(column, row, 1.0F / Blend::kMost, pixel, blend);
    return blend;
}

std::vector<float> Sketch::filled(const Film& film, Run& run) const {
    Film sampled(nodes_.width, nodes_.height);
    for (int row = 0; row < nodes_.height; ++row)
        for (int column = 0; column < nodes_.width; ++column)
            sampled.at(column, row) = film.pixels()[pixel_of(column, row)];
    const std::vector<float> clean = denoised(sampled, nodes_, run);

    std::vector<float> rgb(3 * film.pixels().size());
    each_row(guides_.height, run, [&](int y) {
        for (int x = 0; x < guides_.width; ++x) {
            const std::size_t k = pixel_index(guides_.width, x, y);
            float* const out = rgb.data() + 3 * k;
            const Blend from = guides_.reach[k] > 0 ? blend(x, y) : Blend{};
            if (from.sum < kAtAll) {  // it has a sample of its own
                const Rgb mean = film.pixels()[k].mean;
                out[0] = static_cast<float>(mean.r);
                out[1] = static_cast<float>(mean.g);
                out[2] = static_cast<float>(mean.b);
                continue;
            }
            for (std::size_t n = 0; n < from.count; ++n) {
                const float share = from.weight[n] / from.sum;
                const float* const node = clean.data() + 3 * from.node[n];
                for (int c = 0; c < 3; ++c) out[c] += share * node[c];
            }
        }
    });
    return rgb;
}

}  // namespace asperity::studio

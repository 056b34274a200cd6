// SPDX-License-Identifier: Apache-2.0
#include "denoise.h"

#include "picture_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace asperity::studio {

namespace {

constexpr std::array<int, 4> kSteps = {1, 2, 4, 8};  // pixels between the taps of each round
constexpr std::uint32_t kKnown = 6;                  // samples from which a variance is trusted

/// A picture in planes, and the variance of the luminance of each pixel's mean.
struct Planes {
    explicit Planes(std::size_t pixels) : r(pixels), g(pixels), b(pixels), variance(pixels) {}
    std::vector<float> r, g, b, variance;

    float luminance(std::size_t k) const {
        return 0.2126F * r[k] + 0.7152F * g[k] + 0.0722F * b[k];
    }
};

/// What few samples do not tell of their own variance, the neighbourhood does.
float variance_round(const Planes& planes, int width, int height, int x, int y) {
    constexpr int kReach = 2;
    float sum = 0, squares = 0, count = 0;
    for (int v = std::max(0, y - kReach); v <= std::min(height - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(width - 1, x + kReach); ++u) {
            const float l = planes.luminance(pixel_index(width, u, v));
            sum += l;
            squares += l * l;
            count += 1;
        }
    const float mean = sum / count;
    return std::max(0.0F, squares / count - mean * mean);
}

Planes planes_of(const Film& film, const PixelGuides& guides, Run& run) {
    const int width = film.width(), height = film.height();
    Planes planes(film.pixels().size());
    each_row(height, run, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t k = pixel_index(width, x, y);
            const Rgb mean = film.pixels()[k].mean;
            planes.r[k] = static_cast<float>(mean.r);
            planes.g[k] = static_cast<float>(mean.g);
            planes.b[k] = static_cast<float>(mean.b);
        }
    });
    each_row(height, run, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t k = pixel_index(width, x, y);
            if (!(guides.reach[k] > 0)) continue;
            const Pixel& pixel = film.pixels()[k];
            const double error = pixel.standard_error();
            planes.variance[k] = pixel.samples >= kKnown
                                     ? static_cast<float>(error * error)
                                     : variance_round(planes, width, height, x, y);
        }
    });
    return planes;
}

/// Sums over the taps of one row.
struct RowSums {
    explicit RowSums(int width)
        : r(size(width)), g(size(width)), b(size(width)), variance(size(width)), w(size(width)) {}
    static std::size_t size(int width) { return static_cast<std::size_t>(width); }
    std::vector<float> r, g, b, variance, w;
};

/// Adds the pixels `to` cells away to the sums of those from `from` on, `count` of them. Loops over
/// a row without a branch, for several pixels at a time.
void add_tap(const Planes& in, const PixelGuides& guides, std::size_t from, std::ptrdiff_t to,
             std::size_t count, float kernel, float step, RowSums& sums, std::size_t at) {
    const auto pair = [from, to](const std::vector<float>& plane) {
        const float* own = plane.data() + from;
        return std::pair(own, own + to);
    };
    const auto [nx, nx2] = pair(guides.nx);
    const auto [ny, ny2] = pair(guides.ny);
    const auto [nz, nz2] = pair(guides.nz);
    const auto [px, px2] = pair(guides.px);
    const auto [py, py2] = pair(guides.py);
    const auto [pz, pz2] = pair(guides.pz);
    const auto [reach, reach2] = pair(guides.reach);
    const auto [r, r2] = pair(in.r);
    const auto [g, g2] = pair(in.g);
    const auto [b, b2] = pair(in.b);
    const auto [v, v2] = pair(in.variance);
    float* const sum_r = sums.r.data() + at;
    float* const sum_g = sums.g.data() + at;
    float* const sum_b = sums.b.data() + at;
    float* const sum_v = sums.variance.data() + at;
    float* const sum_w = sums.w.data() + at;
    for (std::size_t k = 0; k < count; ++k) {
        float alike = nx[k] * nx2[k] + ny[k] * ny2[k] + nz[k] * nz2[k];
        alike = alike > 0 ? alike : 0;
        alike *= alike;  // to the 32nd power
        alike *= alike;
        alike *= alike;
        alike *= alike;
        alike *= alike;
        const float off =
            nx[k] * (px2[k] - px[k]) + ny[k] * (py2[k] - py[k]) + nz[k] * (pz2[k] - pz[k]);
        const float far = step * reach[k] + 1e-12F;
        float near = 1 - off * off / (far * far);
        near = near > 0 ? near : 0;
        near = reach2[k] > 0 ? near : 0;
        const float difference =
            0.2126F * (r2[k] - r[k]) + 0.7152F * (g2[k] - g[k]) + 0.0722F * (b2[k] - b[k]);
        const float doubt = difference * difference / (6 * (v[k] + 0.5F * v2[k]) + 1e-10F);
        const float w = kernel * alike * near / (1 + doubt * doubt);
        sum_r[k] += w * r2[k];
        sum_g[k] += w * g2[k];
        sum_b[k] += w * b2[k];
        sum_v[k] += w * w * v2[k];
        sum_w[k] += w;
    }
}

/// The pixels of one row become means over their neighbours `step` away.
void smooth_row(const Planes& in, const PixelGuides& guides, int y, int step, Planes& out) {
    const int width = guides.width, height = guides.height;
    RowSums sums(width);
    for (int dy = -1; dy <= 1; ++dy) {
        const int v = y + dy * step;
        if (v < 0 || v >= height) continue;
        for (int dx = -1; dx <= 1; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const int first = std::max(0, -dx * step), last = width - std::max(0, dx * step);
            if (first >= last) continue;
            const float kernel = dx == 0 || dy == 0 ? 0.5F : 0.25F;
            const float distance = static_cast<float>(step) * (dx == 0 || dy == 0 ? 1.0F : 1.4142F);
            const auto to = static_cast<std::ptrdiff_t>(dy) * step * width + dx * step;
            add_tap(in, guides, pixel_index(width, first, y), to,
                    static_cast<std::size_t>(last - first), kernel, distance, sums,
                    static_cast<std::size_t>(first));
        }
    }
    for (int x = 0; x < width; ++x) {
        const std::size_t k = pixel_index(width, x, y), at = static_cast<std::size_t>(x);
        const float all = 1 + sums.w[at];
        out.r[k] = (in.r[k] + sums.r[at]) / all;
        out.g[k] = (in.g[k] + sums.g[at]) / all;
        out.b[k] = (in.b[k] + sums.b[at]) / all;
        out.variance[k] = (in.variance[k] + sums.variance[at]) / (all * all);
    }
}

}  // namespace

std::vector<float> denoised(const Film& film, const PixelGuides& guides, Run& run) {
    Planes planes = planes_of(film, guides, run), other = planes;
    for (const int step : kSteps) {
        each_row(guides.height, run, [&](int y) { smooth_row(planes, guides, y, step, other); });
        std::swap(planes, other);
    }
    std::vector<float> rgb(3 * film.pixels().size());
    each_row(guides.height, run, [&](int y) {
        for (int x = 0; x < guides.width; ++x) {
            const std::size_t k = pixel_index(guides.width, x, y);
            rgb[3 * k] = planes.r[k];
            rgb[3 * k + 1] = planes.g[k];
            rgb[3 * k + 2] = planes.b[k];
        }
    });
    return rgb;
}

}  // namespace asperity::studio

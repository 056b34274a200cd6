// SPDX-License-Identifier: Apache-2.0
#include "tone_table.h"

#include <asperity/core/parallel.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace asperity::studio {

namespace {

/// Floats that share their sign, exponent and upper mantissa lie between two neighbours here: close
/// enough together that a level or two lie between.
constexpr int kDropped = 16;
constexpr std::uint32_t kPositive = 0x7f800000;  ///< bits of infinity; those of finite ones: less

std::uint8_t level_of(const ToneMapping& mapping, float radiance) {
    const double c = static_cast<double>(radiance);
    return static_cast<std::uint8_t>(255 * apply(mapping, {c, c, c}).g + 0.5);
}

}  // namespace

ToneTable::ToneTable(const ToneMapping& mapping) : mapping_(mapping) {
    // Of floats above zero the bits are in the order of the numbers: halve the interval of the bits
    std::uint32_t low = 0;
    for (std::size_t level = 1; level < 256; ++level) {
        std::uint32_t high = kPositive;
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            if (level_of(mapping, std::bit_cast<float>(middle)) >= level) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        from_[level] = std::bit_cast<float>(low);
    }
    from_[256] = std::numeric_limits<float>::infinity();

    guesses_.resize((kPositive >> kDropped) + 1);
    std::size_t level = 0;
    for (std::size_t k = 0; k < guesses_.size(); ++k) {
        const float least = std::bit_cast<float>(static_cast<std::uint32_t>(k) << kDropped);
        while (level < 255 && least >= from_[level + 1]) ++level;
        guesses_[k] = static_cast<std::uint8_t>(level);
    }
}

std::uint8_t ToneTable::level(float radiance) const {
    if (!(radiance > 0)) return 0;  // NaN too
    std::size_t level = guesses_[std::bit_cast<std::uint32_t>(radiance) >> kDropped];
    while (radiance >= from_[level + 1] && level < 255) ++level;
    return static_cast<std::uint8_t>(level);
}

QImage ToneTable::develop(const Film& film, int threads) const {
    return develop_rows(film.width(), film.height(), threads, [&film](int x, int y) {
        const Rgb mean = film.at(x, y).mean;
        return std::array<float, 3>{static_cast<float>(mean.r), static_cast<float>(mean.g),
                                    static_cast<float>(mean.b)};
    });
}

QImage ToneTable::develop(const std::vector<float>& rgb, int width, int height, int threads) const {
    return develop_rows(width, height, threads, [&](int x, int y) {
        const float* pixel =
            rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
        return std::array<float, 3>{pixel[0], pixel[1], pixel[2]};
    });
}

template <class RgbOf>
QImage ToneTable::develop_rows(int width, int height, int threads, const RgbOf& rgb_of) const {
    QImage image(width, height, QImage::Format_RGB32);
    uchar* const bits = image.bits();  // once: it may copy, which threads must not do
    const std::size_t row = static_cast<std::size_t>(image.bytesPerLine());
    parallel_for(static_cast<std::size_t>(height), threads, [&](std::size_t y) {
        auto* const line = reinterpret_cast<QRgb*>(bits + y * row);
        for (int x = 0; x < width; ++x) {
            const std::array<float, 3> rgb = rgb_of(x, static_cast<int>(y));
            line[x] = qRgb(level(rgb[0]), level(rgb[1]), level(rgb[2]));
        }
    });
    return image;
}

}  // namespace asperity::studio

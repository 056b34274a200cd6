// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>
#include <asperity/render/tonemap.h>

#include <algorithm>
#include <cstddef>

namespace asperity {

namespace {

double shown(ToneCurve curve, double c) {
    switch (curve) {
        case ToneCurve::None:
            break;
        case ToneCurve::Reinhard:
            return c / (c + 1);
        case ToneCurve::Aces:
            return std::min(1.0, c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14));
    }
    return std::min(1.0, c);
}

double encoded(Transfer transfer, double c) {
    switch (transfer) {
        case Transfer::Srgb:
            return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
        case Transfer::Gamma22:
            return std::pow(c, 1 / 2.2);
        case Transfer::Linear:
            break;
    }
    return c;
}

/// The mapping with its power of two worked out.
class Mapper {
  public:
    explicit Mapper(const ToneMapping& mapping)
        : mapping_(mapping), gain_(std::exp2(mapping.exposure)) {}

    double operator()(double radiance) const {
        constexpr double kWhite = 1e30;  // beyond all curves; its square is still finite
        if (!(radiance > 0)) return 0;   // NaN too
        return encoded(mapping_.transfer,
                       shown(mapping_.curve, std::min(gain_ * radiance, kWhite)));
    }

  private:
    ToneMapping mapping_;
    double gain_;
};

}  // namespace

Rgb apply(const ToneMapping& mapping, Rgb radiance) {
    const Mapper map(mapping);
    return {map(radiance.r), map(radiance.g), map(radiance.b)};
}

std::vector<std::uint8_t> to_bytes(const ToneMapping& mapping, const Image& image, int threads) {
    const Mapper map(mapping);
    const std::size_t row = 3 * static_cast<std::size_t>(image.width);
    std::vector<std::uint8_t> bytes(image.rgb.size());
    parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t y) {
        for (std::size_t k = y * row; k < (y + 1) * row; ++k) {
            const double level = map(static_cast<double>(image.rgb[k]));
            bytes[k] = static_cast<std::uint8_t>(255 * level + 0.5);
        }
    });
    return bytes;
}

}  // namespace asperity

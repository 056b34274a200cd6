// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/image.h>

#include <array>
#include <cstdint>
#include <vector>

namespace asperity {

/// How radiance, 0 .. infinity, becomes what a screen can show, 0 .. 1; per channel.
enum class ToneCurve {
    None,      ///< cut at 1
    Reinhard,  ///< c / (c + 1), as in the thesis' shader (Reinhard et al. 2002, eq. 3)
    Aces,      ///< Narkowicz 2015: c (2.51 c + 0.03) / (c (2.43 c + 0.59) + 0.14), cut at 1
};

/// How light, 0 .. 1, is written as a number.
enum class Transfer {
    Srgb,     ///< IEC 61966-2-1
    Gamma22,  ///< c^(1 / 2.2), as in the thesis' shader
    Linear,
};

struct ToneMapping {
    double exposure = 0;  ///< in stops: radiance times 2^exposure, -100 .. 100
    ToneCurve curve = ToneCurve::None;
    Transfer transfer = Transfer::Srgb;
};

/// The thesis' shader: Reinhard, then 1 / 2.2.
inline constexpr ToneMapping kThesisLook{0, ToneCurve::Reinhard, Transfer::Gamma22};

/// In [0, 1]; what is negative or NaN is 0.
Rgb apply(const ToneMapping& mapping, Rgb radiance);

/// Three bytes a pixel, row 0 on top, as PNG and screens take them; rounded to nearest.
std::vector<std::uint8_t> to_bytes(const ToneMapping& mapping, const Image& image, int threads = 1);

}  // namespace asperity

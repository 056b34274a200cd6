// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/render/render_settings.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity {

namespace {

template <typename Number>
void expect_within(const char* setting, Number value, Number least, Number most) {
    if (value >= least && value <= most) return;
    throw Error(ErrorCode::Usage, fmt::format("{} is outside {} .. {}", value, least, most),
                setting);
}

}  // namespace

void check(const RenderSettings& settings) {
    constexpr int kMostSide = 16384;
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
    expect_within("width", settings.width, 1, kMostSide);
    expect_within("height", settings.height, 1, kMostSide);
    if (std::int64_t{settings.width} * settings.height > kMostPixels)
        throw Error(
            ErrorCode::Usage,
            fmt::format("{} x {} are more than 2^26 pixels", settings.width, settings.height),
            "width");
    expect_within("spp", settings.spp, 1u, 1u << 24);
    if (!(settings.until >= 0 && settings.until < 1))
        throw Error(ErrorCode::Usage, "the noise aimed at lies between 0 and 100 %", "until");
    expect_within("depth", settings.depth, 1, 1000);
    expect_within("strata", settings.strata, 1, 1024);
    const Rgb b = settings.background;
    if (!is_finite(b) || b.r < 0 || b.g < 0 || b.b < 0)
        throw Error(ErrorCode::Usage, "a colour is three finite numbers, none below 0",
                    "background");
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asperity::detail {

/// Share of the samples of a tabulated BRDF drawn from a cosine, so that no direction with light is
/// left out.
inline constexpr double kCosineShare = 0.1;

}  // namespace asperity::detail

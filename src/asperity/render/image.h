// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/rgb.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// A picture in linear light: rgb[3 * (y * width + x) + channel], row 0 on top.
struct Image {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Rgb at(int x, int y) const {
        const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x));
        return {static_cast<double>(rgb[k]), static_cast<double>(rgb[k + 1]),
                static_cast<double>(rgb[k + 2])};
    }
};

}  // namespace asperity

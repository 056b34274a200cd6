// SPDX-License-Identifier: Apache-2.0
// Hand-made measurements and a PNG reader of its own for the tests of pictures.
#pragma once

#include <asperity/formats/test_files.h>
#include <asperity/gonio/test_layers.h>
#include <asperity/pictures/canvas.h>
#include <gtest/gtest.h>
#include <png.h>

#include <string>
#include <vector>

namespace asperity::io::test {

using namespace asperity::test;

inline constexpr Colour kBlack = {0, 0, 0}, kWhite = {1, 1, 1};

/// A PNG as libpng reads it.
struct ReadPng {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;

    explicit ReadPng(const std::string& path) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return;
        image.format = PNG_FORMAT_RGB;
        bytes.resize(PNG_IMAGE_SIZE(image));
        if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) return;
        width = static_cast<int>(image.width);
        height = static_cast<int>(image.height);
    }

    std::vector<int> at(int x, int y) const {
        const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x));
        return {bytes.at(k), bytes.at(k + 1), bytes.at(k + 2)};
    }
};

/// A colour as bytes.
inline std::vector<int> rgb(Colour c) {
    Canvas one(1, 1, c);
    return {one.bytes()[0], one.bytes()[1], one.bytes()[2]};
}

}  // namespace asperity::io::test

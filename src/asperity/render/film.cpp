// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/render/film.h>

#include <fmt/format.h>

#include <limits>

namespace asperity {

Image Film::image() const {
    Image image{width_, height_, {}};
    image.rgb.reserve(3 * pixels_.size());
    for (const Pixel& pixel : pixels_)
        for (const double value : {pixel.mean.r, pixel.mean.g, pixel.mean.b})
            image.rgb.push_back(static_cast<float>(value));
    return image;
}

double noise(const Film& film) {
    double errors = 0, light = 0;
    for (const Pixel& pixel : film.pixels()) {
        if (pixel.samples < 2) return std::numeric_limits<double>::infinity();
        if (!(pixel.m2 > 0)) continue;
        const double error = pixel.standard_error(), seen = luminance(pixel.mean);
        errors += error * error;
        light += seen * seen;
    }
    return errors > 0 ? std::sqrt(errors / light) : 0.0;
}

ImageDifference compare(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} x {} pixels cannot be compared with {} x {}", a.width, a.height,
                                b.width, b.height),
                    "image");
    ImageDifference difference;
    const double pixels = static_cast<double>(a.width) * a.height;
    if (pixels == 0) return difference;

    double squares = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double in_a = luminance(a.at(x, y)), in_b = luminance(b.at(x, y));
            difference.mean_a += in_a;
            difference.mean_b += in_b;
            difference.mean_absolute += std::abs(in_a - in_b);
            squares += (in_a - in_b) * (in_a - in_b);
        }
    }
    difference.mean_a /= pixels;
    difference.mean_b /= pixels;
    difference.mean_absolute /= pixels;
    difference.rms = std::sqrt(squares / pixels);
    if (difference.mean_a != 0) difference.relative = difference.mean_absolute / difference.mean_a;
    return difference;
}

}  // namespace asperity

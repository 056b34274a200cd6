// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/image.h>

#include <array>
#include <string>

namespace asperity::io::detail {

/// What red, green, blue and white of a picture are: chromaticities x, y of CIE 1931.
struct Primaries {
    std::array<double, 2> red{0.64, 0.33}, green{0.3, 0.6}, blue{0.15, 0.06},
        white{0.3127, 0.329};  // Rec. 709
};

/// Row k, column j: how much of the file's k-th primary the j-th of Rec. 709 gets; white stays
/// white (adapted by Bradford's matrix). Throws Error(InvalidInput, path) for primaries that span
/// nothing.
std::array<std::array<double, 3>, 3> to_rec709(const Primaries& from, const std::string& path);

/// Brings a picture to our primaries; colours beyond them lose what would be negative. Throws as
/// to_rec709. Leaves every bit alone when they are ours to a thousandth.
void convert_to_rec709(Image& image, const Primaries& from, const std::string& path);

}  // namespace asperity::io::detail

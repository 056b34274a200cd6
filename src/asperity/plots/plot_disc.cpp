// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_disc.h>

#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

constexpr std::size_t kAcross = 2;  ///< places in a pixel, along x and y
constexpr std::size_t kColours = 512;

using Colours = std::array<Colour, kColours>;

Colour colour_of(io::Colour c) {
    return {c.r, c.g, c.b};
}

Colours colours_of(io::ColourMap map) {
    Colours colours{};
    for (std::size_t k = 0; k < kColours; ++k)
        colours[k] = colour_of(io::colour_of(map, static_cast<double>(k) / (kColours - 1)));
    return colours;
}

}  // namespace

Raster DiscPainter::paint(int pixels, const Detector& detector, const std::vector<double>& values,
                          const io::ValueScale& scale, io::ColourMap map) {
    if (pixels != pixels_ || detector.kind() != kind_ || detector.rows() != rows_ ||
        detector.columns() != columns_)
        find_cells(pixels, detector);
    const Colours colours = colours_of(map);
    const std::size_t side = kAcross * static_cast<std::size_t>(pixels);
    Raster disc(pixels, pixels);
    for (int j = 0; j < pixels; ++j) {
        const int* cell = cells_.data() + kAcross * static_cast<std::size_t>(j) * side;
        for (int i = 0; i < pixels; ++i, cell += kAcross) {
            double sum = 0;
            int inside = 0;
            for (const int at : {cell[0], cell[1], cell[side], cell[side + 1]}) {
                if (at < 0) continue;
                sum += values[static_cast<std::size_t>(at)];
                ++inside;
            }
            if (inside == 0) continue;
            const double place = sum > 0 ? scale.position(sum / inside) : 0;
            const Colour colour =
                sum > 0 ? colours[static_cast<std::size_t>(place * (kColours - 1) + 0.5)]
                        : colour_of(io::kZeroColour);
            disc.at(i, j) = packed(colour.with_opacity(inside / 4.0));
        }
    }
    return disc;
}

void DiscPainter::find_cells(int pixels, const Detector& detector) {
    pixels_ = pixels;
    kind_ = detector.kind();
    rows_ = detector.rows();
    columns_ = detector.columns();
    const std::size_t half = static_cast<std::size_t>(pixels), side = kAcross * half;
    cells_.assign(side * side, -1);
    const auto below = [this](int cell) {  // mirrored in the x axis
        return cell / columns_ * columns_ + columns_ - 1 - cell % columns_;
    };
    const auto beside = [this](int cell) {  // in the y axis, from the first quadrant
        return cell / columns_ * columns_ + columns_ / 2 - 1 - cell % columns_;
    };
    // Angles are worked out in one quadrant only, or in two where columns do not mirror
    for (std::size_t b = 0; b < half; ++b)
        for (std::size_t a = 0; a < half; ++a) {
            const double x = (static_cast<double>(a) + 0.5) / pixels;
            const double y = (static_cast<double>(b) + 0.5) / pixels;
            const double z2 = 1 - x * x - y * y;
            if (z2 <= 0) break;
            const int right = detector.cell_of({x, y, std::sqrt(z2)});
            const int left =
                columns_ % 2 == 0 ? beside(right) : detector.cell_of({-x, y, std::sqrt(z2)});
            int* upper = cells_.data() + (half - 1 - b) * side + half;
            int* lower = cells_.data() + (half + b) * side + half;
            upper[a] = right;
            lower[a] = below(right);
            *(upper - 1 - a) = left;
            *(lower - 1 - a) = below(left);
        }
}

}  // namespace asperity::plots

// SPDX-License-Identifier: Apache-2.0
#include "plot_disc.h"

#include <QPainter>

#include <array>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kAcross = 2;  ///< places in a pixel, along x and y
constexpr std::size_t kPlaces = kAcross * kAcross;
constexpr std::size_t kColours = 512;

QRgb rgb_of(io::Colour colour) {
    const auto byte = [](double value) { return static_cast<int>(std::lround(255 * value)); };
    return qRgb(byte(colour.r), byte(colour.g), byte(colour.b));
}

std::array<QRgb, kColours> colours_of(io::ColourMap map) {
    std::array<QRgb, kColours> colours{};
    for (std::size_t k = 0; k < kColours; ++k)
        colours[k] = rgb_of(io::colour_of(map, static_cast<double>(k) / (kColours - 1)));
    return colours;
}

/// Cuts the disc out of its square, with a smooth rim.
QImage disc_of(const QImage& square) {
    QImage disc(square.size(), QImage::Format_ARGB32_Premultiplied);
    disc.fill(Qt::transparent);
    QPainter painter(&disc);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(square);
    painter.drawEllipse(QRectF(disc.rect()));
    return disc;
}

}  // namespace

QImage DiscPainter::paint(int pixels, const Detector& detector, const std::vector<double>& values,
                          const io::ValueScale& scale, io::ColourMap map) {
    if (pixels != pixels_ || detector.kind() != kind_ || detector.rows() != rows_ ||
        detector.columns() != columns_)
        find_cells(pixels, detector);
    const std::array<QRgb, kColours> colours = colours_of(map);
    const QRgb nothing = rgb_of(io::kZeroColour);
    QImage square(pixels, pixels, QImage::Format_RGB32);
    const int* cell = cells_.data();
    for (int j = 0; j < pixels; ++j) {
        auto* line = reinterpret_cast<QRgb*>(square.scanLine(j));
        for (int i = 0; i < pixels; ++i) {
            double sum = 0;
            int inside = 0;
            for (std::size_t k = 0; k < kPlaces; ++k, ++cell) {
                if (*cell < 0) continue;
                sum += values[static_cast<std::size_t>(*cell)];
                ++inside;
            }
            line[i] = sum > 0 ? colours[static_cast<std::size_t>(
                                    scale.position(sum / inside) * (kColours - 1) + 0.5)]
                              : nothing;
        }
    }
    return disc_of(square);
}

void DiscPainter::find_cells(int pixels, const Detector& detector) {
    pixels_ = pixels;
    kind_ = detector.kind();
    rows_ = detector.rows();
    columns_ = detector.columns();
    cells_.clear();
    const std::size_t side = static_cast<std::size_t>(pixels);
    cells_.reserve(side * side * kPlaces);
    const auto place = [pixels](int pixel, int sub) {
        return 2 * (pixel + (sub + 0.5) / kAcross) / pixels - 1;
    };
    for (int j = 0; j < pixels; ++j)
        for (int i = 0; i < pixels; ++i)
            for (int sub = 0; sub < kAcross * kAcross; ++sub) {
                const double x = place(i, sub % kAcross), y = -place(j, sub / kAcross);
                const double r2 = x * x + y * y;
                cells_.push_back(r2 < 1 ? detector.cell_of({x, y, std::sqrt(1 - r2)}) : -1);
            }
}

}  // namespace asperity::studio

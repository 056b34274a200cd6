// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_style.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace asperity::plots {

namespace {

constexpr Colour from_hex(std::uint32_t rgb) {
    return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0};
}

struct InkPair {
    Colour on_light, on_dark;
};

// In the order of PlotInk.
constexpr std::array<InkPair, 15> kInks = {{
    {from_hex(0x0b62a8), from_hex(0x5db4f2)},  // simulated: blue
    {from_hex(0xd1500a), from_hex(0xff9152)},  // Cook-Torrance: vermilion
    {from_hex(0x00805d), from_hex(0x3fd6a6)},  // GGX: green
    {from_hex(0xa3407f), from_hex(0xe88fc4)},  // Beckmann: purple
    {from_hex(0x111111), from_hex(0xf2f2f2)},  // all bounces: as text
    {from_hex(0x08306b), from_hex(0xc9def2)},  // one reflection, and more, from deep to bright
    {from_hex(0x2171b5), from_hex(0x74b6e8)},
    {from_hex(0x5aa0d0), from_hex(0x3d86c6)},
    {from_hex(0xc98a00), from_hex(0xffd24a)},  // all higher orders: gold
    {from_hex(0xb58900), from_hex(0xffd24a)},  // light: yellow
    {from_hex(0x5a5a5a), from_hex(0xb8b8b8)},  // mirror direction: grey
    {from_hex(0xc98a00), from_hex(0xf0c93a)},  // fifth: orange
    {from_hex(0x111111), from_hex(0xf2f2f2)},  // sixth: as text
    {from_hex(0x3c9ed9), from_hex(0xa8dcff)},  // seventh: sky
    {from_hex(0x7a5a3a), from_hex(0xc9a57e)},  // eighth: brown
}};

double luma(Colour c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

}  // namespace

PlotInk series_ink(int k) {
    constexpr std::array<PlotInk, kSeriesInks> kSeries = {
        PlotInk::Simulated, PlotInk::CookTorrance, PlotInk::Ggx,     PlotInk::Beckmann,
        PlotInk::Fifth,     PlotInk::Sixth,        PlotInk::Seventh, PlotInk::Eighth};
    return kSeries[static_cast<std::size_t>(k) % kSeriesInks];
}

PlotStyle::PlotStyle(std::shared_ptr<const TextMeasure> measure, double font_size)
    : PlotStyle(std::move(measure), font_size, {1, 1, 1}, from_hex(0x111111)) {
    faint = from_hex(0x444444);
    grid = from_hex(0xdddddd);
}

PlotStyle::PlotStyle(std::shared_ptr<const TextMeasure> measure, double font_size,
                     Colour paper_colour, Colour text_colour)
    : paper(paper_colour),
      text(text_colour),
      faint(mix(text, paper, 0.35)),
      grid(mix(paper, text, 0.13)),
      font{font_size},
      small{std::round(9 * font_size) / 10},
      title{std::round(11 * font_size) / 10, true},
      dark(luma(paper_colour) < 0.5),
      measure_(std::move(measure)) {}

PlotStyle PlotStyle::dark_screen(std::shared_ptr<const TextMeasure> measure, double font_size) {
    return {std::move(measure), font_size, from_hex(0x16181d), from_hex(0xe8eaee)};
}

Colour PlotStyle::ink(PlotInk what) const {
    const InkPair& pair = kInks[static_cast<std::size_t>(what)];
    return dark ? pair.on_dark : pair.on_light;
}

double PlotStyle::line_height() const {
    return measure_->height(font);
}

double PlotStyle::width_of(std::string_view words, Font in) const {
    return measure_->width(words, in);
}

std::vector<std::string> PlotStyle::wrapped(const std::string& words, double width, Font in) const {
    std::vector<std::string> lines;
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
        if (!lines.empty() && width_of(lines.back() + ' ' + word, in) <= width)
            lines.back() += ' ' + word;
        else
            lines.push_back(word);
    }
    return lines;
}

}  // namespace asperity::plots

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/pictures/canvas.h>

#include <string>
#include <string_view>

namespace asperity::io {

/// A drawn letter in font units: baseline at y = 0, capitals 10 high, y up, x from 0 to `width`.
struct Glyph {
    double width = 0;
    double left = 0, right = 0;  ///< space before and after it
    std::vector<Polyline> lines;
};

/// The glyph of a code point: printable ASCII, ° · × ± − µ ≤ ≥ … θ φ α σ λ, superscripts ⁰ .. ⁹ ⁻,
/// subscripts ᵢ ₒ. Anything else is an empty box.
const Glyph& glyph_of(char32_t code);
bool has_glyph(char32_t code);

/// How text looks. `size` is the height of a line as usual for fonts [pixels]: capitals are 0.72
/// of it.
struct TextStyle {
    double size = 14;
    Colour colour = {1, 1, 1};
    double weight = 1;  ///< stroke width, as a multiple of the regular one
};

enum class Align { Left, Centre, Right };

/// Width of UTF-8 `text` [pixels].
double text_width(std::string_view text, double size);

/// Writes UTF-8 `text` with its baseline at `at.y`, beginning, centred or ending at `at.x`.
void draw_text(Canvas& canvas, Point at, std::string_view text, const TextStyle& style,
               Align align = Align::Left);

/// `text` in lines that are no wider than `width` pixels; a word that is keeps its line.
std::vector<std::string> wrapped(std::string_view text, double size, double width);

/// The size, `size` at most, at which `text` is no wider than `width` pixels: whole titles, however
/// long, in smaller letters.
double fitting_size(std::string_view text, double size, double width);

}  // namespace asperity::io

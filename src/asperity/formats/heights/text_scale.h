// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/text_table.h>

#include <optional>

namespace asperity::io {

/// What the header lines of a text say of its scale, whatever the language: units and numbers
/// decide where words are not known.
struct TextScale {
    std::optional<double> width, height;  ///< [m]
    std::optional<double> dx, dy;         ///< [m]
    std::optional<double> z;              ///< metres per number
    std::optional<double> columns, rows;
    std::string z_text, spacing_text;      ///< as found, for the report
    std::vector<TextLine> not_understood;  ///< lines that name a number or a unit to no use
};

/// Reads "Width: 16.00 µm", "pixel size=3.7e-7 m", "Value units: nm", "h=650 w=650", "height
/// conversion factor (-> m)=6.3e-8" and the like. Two lengths and a bare unit in comments, in this
/// order, are Gwyddion's export in any language.
TextScale read_text_scale(const std::vector<TextLine>& header);

}  // namespace asperity::io

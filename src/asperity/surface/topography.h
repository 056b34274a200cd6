// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace asperity {

/// A measured topography as its file has it: heights over a regular grid, some perhaps missing.
///
/// heights[j * nx + i] is the height of column i, row j; row 0 is the top row of the picture that
/// the instrument shows. Heights, dx and dy carry one unit (`unit`). The width is nx * dx: a sample
/// stands for a cell, not for a post between cells.
struct Topography {
    int nx = 0, ny = 0;
    double dx = 1, dy = 1;        ///< 0: the heights have a unit, and nothing says the spacing
    std::vector<double> heights;  ///< whatever where missing
    std::vector<std::uint8_t> missing;  ///< 1 where nothing was measured; empty: nothing is missing
    std::string unit = "cell";          ///< "cell" or "m"
    std::string name;                   ///< where it comes from, one line
    Boundary boundary = Boundary::Finite;
    Diagonal diagonal = Diagonal::Anti;
    bool isotropic = false;
    std::string found;    ///< what the file said: "heights in um from the header; spacing 0.366 um"
    std::string assumed;  ///< what it left open and how it was read; empty: nothing

    std::size_t missing_count() const;
    void mark_missing(std::size_t sample);
    /// Adds a sentence to `found` or `assumed`, apart by "; ".
    void note(const std::string& what);
    void assume(const std::string& what);
};

/// The surface to measure: heights as 32-bit floats, counted from their mean where a far offset
/// would cost their last digits (that is said in `source`). Throws Error(InvalidInput, `where`) for
/// missing points, naming how many, and what validate() throws. This is the one place where what
/// is done to a measurement before it is measured belongs.
Heightfield prepare(Topography topography, const std::string& where);

/// One line on what was found and assumed: "heights in um from the header; spacing 0.366 um; 117 of
/// 272492 points missing; first row on top; taken: ...".
std::string describe(const Topography& topography);

}  // namespace asperity

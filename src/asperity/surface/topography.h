// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/preparation.h>

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
    /// The heights were made, or made ready, before: Asperity wrote the file, or a program brings
    /// them. Nothing is done to them that is not asked for.
    bool ours = false;
    std::string found;    ///< what the file said: "heights in um from the header; spacing 0.366 um"
    std::string assumed;  ///< what it left open and how it was read; empty: nothing
    std::string prepared;  ///< what was done since, in order; empty: nothing

    std::size_t missing_count() const;
    void mark_missing(std::size_t sample);
    /// Adds a sentence to `found`, `assumed` or `prepared`, apart by "; ".
    void note(const std::string& what);
    void assume(const std::string& what);
    void did(const std::string& what);
};

/// True for heights with a unit of length that are not `ours`: they come from an instrument, in
/// whose frame the sample lay as it happened to lie.
bool is_measurement(const Topography& topography);

/// The surface to measure: made ready as `how` says, heights as 32-bit floats, counted from their
/// mean where a far offset would cost their last digits. What was done is said in `prepared` of the
/// surface, what was found in `source`. Throws Error(InvalidInput, `where`) for missing points that
/// are not to be filled, and what validate() throws; Error(Usage, "name of the setting") for
/// lengths that the topography has no room or no unit for; Error(Stopped). Same bits for any number
/// of threads.
Heightfield prepare(Topography topography, const Preparation& how, const std::string& where,
                    const Run& run);

/// One line on what was found and assumed: "heights in um from the header; spacing 0.366 um; 117 of
/// 272492 points missing; first row on top; taken: ...".
std::string describe(const Topography& topography);

}  // namespace asperity

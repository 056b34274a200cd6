// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "denoise.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity::studio {

/// A picture of which only some pixels have been sampled: the first of each square of stride x
/// stride pixels, and those that look like none of the pixels sampled about them. The others take
/// their light from the sampled ones that their guides liken them to (joint bilateral upsampling,
/// Kopf et al. 2007), after the noise was taken out of these. So the outlines of a model are there
/// at full resolution long before its light. For the screen alone, like denoised().
class Sketch {
  public:
    /// `guides` must live as long.
    Sketch(const PixelGuides& guides, int stride, Run& run);

    /// The pixels to be sampled, row by row: 1 or 0.
    const std::vector<std::uint8_t>& chosen() const { return chosen_; }

    /// Of a film in which those have samples: three floats a pixel, row by row. The same for any
    /// number of threads; unfinished when the run was stopped.
    std::vector<float> filled(const Film& film, Run& run) const;

  private:
    /// How much of the four nodes about it a pixel takes, in 255ths; all 0: it has a sample itself,
    /// or looks farther.
    using Shares = std::array<std::uint8_t, 4>;
    struct Blend;

    void liken(int y, std::span<Shares> row);
    /// Of the sixteen nodes about a pixel.
    Blend look_farther(int x, int y) const;
    void add_node(int column, int row, float weight, std::size_t pixel, Blend& blend) const;
    void fill(int y, const Film& film, const std::vector<float>& nodes, float* out) const;
    std::size_t pixel_of(int column, int row) const;

    const PixelGuides& guides_;
    int stride_;
    PixelGuides nodes_;  ///< the guides of the first pixels of the squares
    std::vector<std::uint8_t> chosen_;
    std::vector<Shares> shares_;
};

}  // namespace asperity::studio

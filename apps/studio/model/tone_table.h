// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/film.h>
#include <asperity/render/tonemap.h>

#include <QImage>

#include <array>
#include <cstdint>
#include <vector>

namespace asperity::studio {

/// A ToneMapping made fast: the same 255 steps as to_bytes(), found in a table instead of by powers
/// for each pixel, which would take longer than to trace it.
class ToneTable {
  public:
    explicit ToneTable(const ToneMapping& mapping);

    const ToneMapping& mapping() const { return mapping_; }
    std::uint8_t level(float radiance) const;
    /// A picture as to_bytes() has it of film.image(), Format_RGB32.
    QImage develop(const Film& film, int threads) const;
    /// The same of three floats a pixel, row by row.
    QImage develop(const std::vector<float>& rgb, int width, int height, int threads) const;

  private:
    template <class RgbOf>
    QImage develop_rows(int width, int height, int threads, const RgbOf& rgb_of) const;

    ToneMapping mapping_;
    std::array<float, 257> from_{};      ///< the least radiance shown at each level; then infinity
    std::vector<std::uint8_t> guesses_;  ///< by the upper bits of a float: a level, or one too low
};

}  // namespace asperity::studio

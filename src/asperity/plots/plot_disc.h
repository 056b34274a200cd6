// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/detector.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/plots/canvas.h>

#include <vector>

namespace asperity::plots {

/// Paints the hemisphere seen from above, fast enough for a layer that grows: it remembers which
/// cells lie below which pixel, which changes with size and detector only.
class DiscPainter {
  public:
    /// A disc of `pixels` across on transparent ground. A pixel shows the mean of `values`, one per
    /// cell, at four places in it: equal areas of the disc are equal projected solid angles.
    Raster paint(int pixels, const Detector& detector, const std::vector<double>& values,
                 const io::ValueScale& scale, io::ColourMap map);

  private:
    void find_cells(int pixels, const Detector& detector);

    int pixels_ = 0, rows_ = 0, columns_ = 0;
    DetectorKind kind_ = DetectorKind::LatLong;
    std::vector<int> cells_;  ///< of places twice as fine as pixels, by rows; -1: off the disc
};

}  // namespace asperity::plots

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// The areal autocorrelation of the heights about their mean, 1 at no shift, for shifts of up to
/// half the surface; the same for a shift and its opposite.
class HeightAutocorrelation {
  public:
    /// Of a periodic surface over all of it, of another over the part that overlaps with itself.
    /// All 1 for a flat surface. Throws Error(Stopped).
    HeightAutocorrelation(const Heightfield& surface, Run& run);

    int most_x() const { return most_x_; }
    int most_y() const { return most_y_; }
    /// -most_x() <= a <= most_x(), likewise b [samples].
    double at(int a, int b) const;

  private:
    int nx_, ny_, wide_, high_, most_x_, most_y_;
    bool periodic_;
    std::vector<float> values_;
};

/// The nearest and the farthest point of the contour where the autocorrelation around no shift has
/// fallen to a level [unit of the surface].
struct AutocorrelationContour {
    double nearest = 0, farthest = 0;
    bool closed = false;  ///< false: it reaches beyond half the surface, farthest does not count
};
AutocorrelationContour contour_of(const HeightAutocorrelation& autocorrelation, double dx,
                                  double dy, double level);

}  // namespace asperity

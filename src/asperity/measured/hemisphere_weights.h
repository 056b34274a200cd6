// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/measured/half_vector_map.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// What the nodes of a slice of a BakedBrdf are worth in the integral of f cos(theta_o) over wo, f
/// (cos_i + cos_o) being linear between them: by midpoints of two steps a cell.
class HemisphereWeights {
  public:
    /// `side` x `side` nodes over the square of the map.
    HemisphereWeights(const HalfVectorMap& map, int side);

    /// For light from `wi`, row by row.
    std::vector<double> of(Vec3 wi) const;

  private:
    /// A facet in the middle of a step, drawn out as the map gives it.
    struct Midpoints {
        std::vector<double> x, y, z;  ///< row by row
        std::vector<double> mirror;   ///< 2 z / length^2
        std::vector<double> area;     ///< of wo over wi . facet; 0 outside the disk
    };

    std::size_t side_, steps_;
    Midpoints midpoints_;
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// Models far from their origin, in the coordinates of a map for instance: single precision would
// leave steps of half a metre there.
#pragma once

#include <asperity/render/mesh.h>

#include <string>
#include <vector>

namespace asperity::io::detail {

/// The box round the points that triangles of a file use.
class Extent {
  public:
    /// Points that are not finite, or farther than any model may be, do not count.
    void add(Vec3 point);

    /// The origin about which the points are best kept in single precision: 0 unless they lie 16
    /// times farther from it than they are across, else the middle of the box.
    Vec3 origin() const;
    double farthest() const;  ///< largest coordinate
    double across() const;    ///< longest side

  private:
    Vec3 low_{}, high_{};
    bool empty_ = true;
};

/// `point` as seen from `origin`, in single precision.
Vec3f relative_to(Vec3 origin, Vec3 point);

/// Moves the meshes of a model about a common origin where their own coordinates are far from it,
/// and the instances the other way; the world stays as it is. For formats that store single
/// precision: remarks when their steps are a ten-thousandth of the model or more.
void recentre(Model& model, std::vector<std::string>& remarks);

/// What to say of coordinates that a reader kept about `extent.origin()`; "" when that is 0.
std::string remark_on(const Extent& extent);

}  // namespace asperity::io::detail

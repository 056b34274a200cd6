// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/topography.h>

#include <vector>

namespace asperity {

/// A polynomial in x and y of total degree `order`: the form of a surface.
class PolynomialForm {
  public:
    /// The least-squares fit to the points that are not missing. Order 0 .. 3. Points that do not
    /// determine it (all in one row) get the smallest one. Throws Error(Stopped).
    PolynomialForm(const Topography& topography, int order, const Run& run);

    double at(int i, int j) const;
    /// Its slope in the middle of the surface: that of the plane for order 1.
    Slope slope() const;

  private:
    double u(int i) const { return (2.0 * i - (nx_ - 1)) / (nx_ - 1); }
    double v(int j) const { return (2.0 * j - (ny_ - 1)) / (ny_ - 1); }

    int nx_, ny_, order_;
    double dx_, dy_;
    double origin_ = 0;
    std::vector<double> coefficients_;  ///< of products of Legendre polynomials
};

}  // namespace asperity

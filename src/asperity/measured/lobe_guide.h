// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/lattice.h>
#include <asperity/core/vec.h>
#include <asperity/measured/half_vector_map.h>
#include <asperity/measured/layer_table.h>

#include <span>
#include <vector>

namespace asperity {

/// What the lobes of all layers have in common, so that the cells of a layer need to say only how
/// they differ from it: a lobe at grazing incidence is narrower across the plane of incidence than
/// a cell (a facet's tilt sideways turns it by cos(theta_i) less), while light from above shows the
/// same facets spread over many cells.
///
///     f(wi, wo) = guide(wi, wo) g(wi, wo),   guide = (D(wm) + floor) / (sigma(wi) sigma(wo)),
///
/// D the distribution of normals that the layer nearest to normal incidence shows at the facet wm
/// between its light and wo, and sigma(w) = integral of max(0, w . wm) D dwm the area that the
/// facets show to a direction, which is cos(theta) / G1 (as in Dupuy and Jakob 2018, "An Adaptive
/// Parameterization for Efficient Material Acquisition and Rendering", eq. 7 to 11). What is left,
/// g, is smooth where single reflections count. The floor is what g has to itself where D says
/// nothing: where light comes from several reflections.
///
/// Without such a layer, or where D is so broad that cells show all of it (alpha above 0.25), the
/// guide is 1 / (sigma(wi) sigma(wo)), sigma the cosine, clamped away from zero.
class LobeGuide {
  public:
    LobeGuide() = default;
    /// `table` is of a layer whose light comes from `wi`, near the normal.
    LobeGuide(const LayerTable& table, Vec3 wi, int threads);

    bool is_known() const { return !sigma_.values.empty(); }
    /// guide(wi, wo); `m` = wi + wo, as long as it is. `wo` may lie below the horizon: it is taken
    /// to be on it.
    double operator()(Vec3 wi, Vec3 wo, Vec3 m) const;
    double sigma(Vec3 w) const;
    /// guide(wi, wo) sigma(wi) sigma(wo).
    double facets(Vec3 m) const { return is_known() ? distribution_.at(m) : 1; }

    /// The directional albedo of a BRDF that follows this guide: an integral over facets, spread by
    /// the width of D as far as it is seen, on the lattice. Lobes that move with the light lie
    /// there at one place, however narrow they are over directions.
    void albedo_over_facets(const Bsdf& brdf, Vec3 wi, FibonacciLattice lattice,
                            std::span<double> a) const;

  private:
    /// A function of directions, linear between nodes on a square round the map's disk.
    struct DirectionTable {
        HalfVectorMap map;
        int side = 0;  ///< nodes
        std::vector<float> values;

        double at(Vec3 direction) const;
        Vec3 node(int row, int column) const;  ///< unit
    };

    struct Facet {
        Vec3 wm;
        double weight = 0;  ///< D dwm
    };

    double seen_distribution(const LayerTable& table, Vec3 wi, Vec3 wm) const;
    std::vector<Facet> find_facets(const LayerTable& table, Vec3 wi);
    void find_sigma(const std::vector<Facet>& facets, int threads);

    DirectionTable distribution_, sigma_;
    double floor_ = 0;
    double tail_ = 1;  ///< alpha^2 of the distribution where it is not seen
};

}  // namespace asperity

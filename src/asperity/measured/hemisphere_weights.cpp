// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/hemisphere_weights.h>

namespace asperity {

HemisphereWeights::HemisphereWeights(const HalfVectorMap& map, int side)
    : side_(static_cast<std::size_t>(side)), steps_(2 * (side_ - 1)) {
    const double step = 2.0 / static_cast<double>(steps_);
    const auto middle = [step](std::size_t k) { return (static_cast<double>(k) + 0.5) * step - 1; };
    for (std::size_t row = 0; row < steps_; ++row) {
        for (std::size_t column = 0; column < steps_; ++column) {
            const double x = middle(column), y = middle(row);
            const Vec3 h = map.half_vector(x, y);
            const double length2 = dot(h, h);
            midpoints_.x.push_back(h.x);
            midpoints_.y.push_back(h.y);
            midpoints_.z.push_back(h.z);
            midpoints_.mirror.push_back(2 * h.z / length2);
            // HalfVectorMap::density without wi . h
            midpoints_.area.push_back(h.z > 0 ? step * step * 16 * map.stretch * map.stretch *
                                                    (1 + x * x + y * y) / (length2 * length2)
                                              : 0);
        }
    }
}

std::vector<double> HemisphereWeights::of(Vec3 wi) const {
    std::vector<double> weights(side_ * side_), shares(steps_);
    for (std::size_t row = 0; row < steps_; ++row) {
        const std::size_t begin = row * steps_;
        const double* const x = midpoints_.x.data() + begin;
        const double* const y = midpoints_.y.data() + begin;
        const double* const z = midpoints_.z.data() + begin;
        const double* const mirror = midpoints_.mirror.data() + begin;
        const double* const area = midpoints_.area.data() + begin;
        double* const share = shares.data();
        for (std::size_t k = 0; k < steps_; ++k) {
            const double along = wi.x * x[k] + wi.y * y[k] + wi.z * z[k];
            const double up = along * mirror[k] - wi.z;  // cosine of wo
            const double value = up * along * area[k] / (up + wi.z);
            share[k] = up > 0 ? value : 0;
        }
        // A midpoint lies a quarter of a cell from its near nodes, three quarters from the others.
        const double odd = row % 2 == 0 ? 0.25 : 0.75;
        double* const above = weights.data() + row / 2 * side_;
        double* const below = above + side_;
        for (std::size_t cell = 0; cell + 1 < side_; ++cell) {
            const double left = 0.75 * share[2 * cell] + 0.25 * share[2 * cell + 1];
            const double right = 0.25 * share[2 * cell] + 0.75 * share[2 * cell + 1];
            above[cell] += (1 - odd) * left;
            above[cell + 1] += (1 - odd) * right;
            below[cell] += odd * left;
            below[cell + 1] += odd * right;
        }
    }
    return weights;
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/detector.h>

#include <algorithm>
#include <cmath>

namespace asperity {

Detector::Detector(const DetectorSettings& settings)
    : kind_(settings.kind),
      rows_(std::max(1, settings.resolution / 2)),
      columns_(std::max(1, settings.resolution)) {
    theta_edges_.resize(static_cast<std::size_t>(rows_) + 1);
    for (int row = 0; row <= rows_; ++row) {
        const double share = static_cast<double>(row) / rows_;
        theta_edges_[static_cast<std::size_t>(row)] =
            kind_ == DetectorKind::LatLong ? 0.5 * kPi * share : std::asin(std::sqrt(share));
    }
    theta_edges_.back() = 0.5 * kPi;
    for (int row = 0; row < rows_; ++row) {
        // sin^2 b - sin^2 a = sin(b + a) sin(b - a), without cancellation.
        const double a = theta_edge(row), b = theta_edge(row + 1);
        projected_solid_angles_.push_back(0.5 * std::sin(b + a) * std::sin(b - a) * 2 * kPi /
                                          columns_);
    }
}

int Detector::cell_of(Vec3 wo) const {
    const double theta = std::min(polar_angle(wo), 0.5 * kPi);
    const double share =
        kind_ == DetectorKind::LatLong ? theta / (0.5 * kPi) : wo.x * wo.x + wo.y * wo.y;
    const int guess = std::clamp(static_cast<int>(share * rows_), 0, rows_ - 1);
    // The edges are the authority: rounding may have put the guess one row off.
    int row = guess;
    if (row > 0 && theta < theta_edge(row)) --row;
    if (row < rows_ - 1 && theta >= theta_edge(row + 1)) ++row;
    const int column =
        std::min(static_cast<int>(azimuth(wo) * (columns_ / (2 * kPi))), columns_ - 1);
    return row * columns_ + column;
}

Vec3 Detector::centre(int cell) const {
    return from_spherical(theta_centre(cell / columns_), phi_centre(cell % columns_));
}

double Detector::solid_angle(int row) const {
    // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2), without cancellation.
    const double a = theta_edge(row), b = theta_edge(row + 1);
    return 2 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a)) * 2 * kPi / columns_;
}

SkyMapPoint thesis_sky_map(Vec3 w) {
    // Thesis: u = atan2(x, -z) / 2 pi + 1/2, v = acos(y) / pi with y up. Its z axis is our -y.
    const double u = std::atan2(w.x, w.y) / (2 * kPi) + 0.5;
    const double v = polar_angle(w) / kPi;
    return {u < 1 ? u : 0.0, std::min(v, std::nextafter(1.0, 0.0))};
}

}  // namespace asperity

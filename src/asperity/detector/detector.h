// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/directions.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// How the hemisphere is cut into cells; see Detector.
enum class DetectorKind {
    LatLong,    ///< rows equal in theta: the upper half of the thesis' sky-map (eq. 4.5)
    EqualArea,  ///< rows equal in sin^2 theta: every cell the same projected solid angle
};

struct DetectorSettings {
    DetectorKind kind = DetectorKind::LatLong;
    int resolution = 256;  ///< Texture Resolution R: R columns, R / 2 rows
    int orders =
        4;  ///< bounce orders kept apart per cell; the last one holds all higher orders too
};

/// The hemisphere of outgoing directions, cut into rows of polar angle and columns of azimuth.
///
/// cell = row * columns + column. Row 0 touches the normal (theta_o = 0), the last row the horizon.
/// Column 0 begins at phi_o = 0; columns are equal. A cell holds its lower and not its upper edges;
/// theta_o = pi/2 belongs to the last row.
class Detector {
  public:
    Detector() = default;
    explicit Detector(const DetectorSettings& settings);

    DetectorKind kind() const { return kind_; }
    int rows() const { return rows_; }
    int columns() const { return columns_; }
    int cells() const { return rows_ * columns_; }
    /// Hemispheres: that of reflected light.
    int sides() const { return 1; }

    /// Cell of the unit vector `wo`; wo.z < 0 counts as the horizon.
    int cell_of(Vec3 wo) const;

    double theta_edge(int row) const { return theta_edges_[static_cast<std::size_t>(row)]; }
    double phi_edge(int column) const { return 2 * kPi * column / columns_; }
    double theta_centre(int row) const { return 0.5 * (theta_edge(row) + theta_edge(row + 1)); }
    double phi_centre(int column) const { return 2 * kPi * (column + 0.5) / columns_; }
    Vec3 centre(int cell) const;

    /// Integral of cos(theta) over a cell of this row [sr]:
    /// (sin^2 theta_2 - sin^2 theta_1) / 2 * 2 pi / columns. All cells together: pi.
    double projected_solid_angle(int row) const {
        return projected_solid_angles_[static_cast<std::size_t>(row)];
    }
    /// Integral of 1 over a cell of this row [sr].
    double solid_angle(int row) const;

  private:
    DetectorKind kind_ = DetectorKind::LatLong;
    int rows_ = 0, columns_ = 0;
    std::vector<double> theta_edges_;             ///< rows + 1 angles, 0 .. pi/2
    std::vector<double> projected_solid_angles_;  ///< by row; asked for at every cell
};

/// Texture coordinates of the thesis' sky-map (eq. 4.5), whose y axis is our z: u and v in [0, 1);
/// v < 1/2 above the horizon. Thesis x, y, z are our x, z, -y.
struct SkyMapPoint {
    double u = 0, v = 0;
};
SkyMapPoint thesis_sky_map(Vec3 w);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/images/primaries.h>

#include <ImathMatrix.h>
#include <ImathVec.h>
#include <asperity/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity::io::detail {
namespace {

using Imath::M33d;  // takes row vectors: xyz = rgb * M
using Imath::V3d;

constexpr double kLeastDeterminant = 1e-6;

/// Of brightness Y = 1.
V3d xyz_of(const std::array<double, 2>& xy) {
    return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

bool is_possible(const std::array<double, 2>& xy) {
    return std::isfinite(xy[0]) && std::isfinite(xy[1]) && std::abs(xy[1]) > 1e-3 &&
           std::abs(xy[0]) < 10 && std::abs(xy[1]) < 10;
}

/// From linear RGB to XYZ: the primaries, so strong that together they make the white.
M33d to_xyz(const Primaries& p, const std::string& path) {
    const auto fail = [&] {
        throw Error(ErrorCode::InvalidInput, "its primaries of colour span no colours", path);
    };
    for (const auto& xy : {p.red, p.green, p.blue, p.white}) {
        if (!is_possible(xy)) fail();
    }
    const V3d r = xyz_of(p.red), g = xyz_of(p.green), b = xyz_of(p.blue);
    const M33d rows(r.x, r.y, r.z, g.x, g.y, g.z, b.x, b.y, b.z);
    if (!(std::abs(rows.determinant()) > kLeastDeterminant)) fail();
    const V3d strength = xyz_of(p.white) * rows.inverse();
    return M33d(strength.x, 0, 0, 0, strength.y, 0, 0, 0, strength.z) * rows;
}

/// Lam's Bradford transform, transposed: XYZ as row to the responses of cones.
const M33d kBradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);

M33d adaptation(const V3d& from_white, const V3d& to_white) {
    const V3d from = from_white * kBradford, to = to_white * kBradford;
    const M33d scale(to.x / from.x, 0, 0, 0, to.y / from.y, 0, 0, 0, to.z / from.z);
    return kBradford * scale * kBradford.inverse();
}

bool is_close(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::abs(a[0] - b[0]) < 1e-3 && std::abs(a[1] - b[1]) < 1e-3;
}

}  // namespace

std::array<std::array<double, 3>, 3> to_rec709(const Primaries& from, const std::string& path) {
    const Primaries ours;
    const M33d m = to_xyz(from, path) * adaptation(xyz_of(from.white), xyz_of(ours.white)) *
                   to_xyz(ours, path).inverse();
    return {
        {{m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}}};
}

void convert_to_rec709(Image& image, const Primaries& from, const std::string& path) {
    const Primaries ours;
    if (is_close(from.red, ours.red) && is_close(from.green, ours.green) &&
        is_close(from.blue, ours.blue) && is_close(from.white, ours.white))
        return;
    const auto m = to_rec709(from, path);
    for (std::size_t k = 0; k + 2 < image.rgb.size(); k += 3) {
        std::array<double, 3> out{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                out[j] += static_cast<double>(image.rgb[k + i]) * m[i][j];
        }
        // Written so that a NaN stays one: whoever uses the picture refuses it.
        for (std::size_t j = 0; j < 3; ++j)
            image.rgb[k + j] = out[j] < 0 ? 0 : static_cast<float>(out[j]);
    }
}

}  // namespace asperity::io::detail

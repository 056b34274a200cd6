// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/bsdfs/angle_table.h>

namespace asperity::io {

/// A Bsdf of measurements in the plane of incidence: theta_o above 0 on the side of the mirror
/// direction. Between incidences lobes move with the light; out of the plane a lobe is taken as
/// round about the mirror direction: f of both sides in the plane at that distance from it,
/// weighted by where the direction lies. No model of a material is better founded there; where it
/// matters, measure. `channel_names` may be empty. Throws Error(InvalidInput, where) for angles
/// that occur twice or lie outside -90 .. 90.
std::unique_ptr<Bsdf> make_in_plane_bsdf(std::vector<AngleRow> rows,
                                         std::vector<std::string> channel_names, std::string name,
                                         const std::string& where);

}  // namespace asperity::io

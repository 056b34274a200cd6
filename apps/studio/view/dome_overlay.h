// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene_lines.h"

#include <asperity/detector/detector.h>

#include <vector>

namespace asperity::studio {

/// The edge of a cell of the detector on the dome, in the world, closed.
std::vector<Vec3> outline_of_cell(const Detector& detector, int cell);

/// Faint lines of equal angle on the far side of the dome, its horizon, and the outline of a cell
/// if one is given.
void paint_dome_lines(const SceneLines& lines, const Viewport& view);
void paint_cell(const SceneLines& lines, const Detector& detector, int cell);

}  // namespace asperity::studio

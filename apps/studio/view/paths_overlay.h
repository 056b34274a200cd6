// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene_lines.h"

#include <asperity/gonio/light_paths.h>

#include <QColor>

#include <vector>

namespace asperity::studio {

/// Colour of light after so many reflections; 0: on its way in. From 4 on it stays the same.
QColor colour_of_bounce(std::size_t reflections);
inline constexpr std::size_t kBounceColours = 5;

/// A path of light in the world of the scene: its corners from the window of the beam over the
/// facets to the dome. A path that never leaves ends on its last facet.
///
/// Its first facet lies in the tile that is shown: what the surface repeats, the path does too.
std::vector<Vec3> corners_in_world(const LightPath& path, const SurfaceBody& body);

/// Draws paths as lines coloured by bounce, with a dot on each facet.
void paint_paths(const SceneLines& lines, const std::vector<LightPath>& paths,
                 const SurfaceBody& body);

/// Of all paths: the most facets that one met.
std::size_t most_bounces(const std::vector<LightPath>& paths);

}  // namespace asperity::studio

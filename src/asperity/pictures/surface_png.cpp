// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/pictures/canvas.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/relief.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity::io {

namespace {

/// Thesis look (its figures 2.10 to 2.12): red = |n_x|, green = |n_up|, blue = |n_z|, where the
/// thesis' z axis is our -y. A flat surface is pure green.
Colour normal_colour(Slope slope) {
    const Vec3 n = normal_of(slope);
    return {std::abs(n.x), n.z, std::abs(n.y)};
}

}  // namespace

void write_surface_png(const Heightfield& surface, const std::string& path, SurfaceLook look) {
    validate(surface, path);
    if (look == SurfaceLook::Normals) {
        const auto colour = [](const Heightfield& s, int i, int j, Triangle t) {
            return normal_colour(facet_slope(s, i, j, t));
        };
        write_png(draw_facets(surface, colour), path);
        return;
    }
    write_png(relief_of(surface, ReliefShading(surface)), path);
}

}  // namespace asperity::io

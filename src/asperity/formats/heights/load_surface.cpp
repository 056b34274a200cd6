// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/tile_heights.h>

namespace asperity::io {
namespace {

// One of the two given alone counts for both.
void apply_cell_size(Heightfield& surface, const SurfaceSettings& settings) {
    if (settings.cell_x || settings.cell_y) {
        surface.dx = settings.cell_x ? *settings.cell_x : *settings.cell_y;
        surface.dy = settings.cell_y ? *settings.cell_y : *settings.cell_x;
    }
}

/// Makes the surface fill the plane and says in its `tiling` how.
void tile(Heightfield& surface, Tiling tiling) {
    const bool says_periodic = surface.boundary == Boundary::Periodic;
    if (tiling == Tiling::Finite) {
        surface.boundary = Boundary::Finite;
        surface.tiling = "a finite patch";
    } else if (tiling == Tiling::Mirrored) {
        surface = mirrored(surface);
        surface.tiling = "mirrored to a periodic tile";
    } else if (tiling == Tiling::Periodic || says_periodic) {
        surface.boundary = Boundary::Periodic;
        surface.tiling = says_periodic ? "periodic as the file says" : "taken as periodic";
    } else if (edges_fit(surface)) {
        surface.boundary = Boundary::Periodic;
        surface.tiling = "periodic, as its opposite edges fit";
    } else {
        surface = mirrored(surface);
        surface.tiling = "mirrored to a periodic tile, as its opposite edges do not fit";
    }
}

Heightfield load_file(const SurfaceSettings& settings) {
    if (settings.file.empty()) throw Error(ErrorCode::Usage, "the file name is empty", "surface");
    Heightfield surface = read_heights(settings.file);
    apply_cell_size(surface, settings);
    for (float& h : surface.heights)
        h = static_cast<float>(static_cast<double>(h) * settings.height_scale);
    if (settings.diagonal == Diagonal::Main) surface.diagonal = Diagonal::Main;

    validate(surface, settings.file);
    tile(surface, settings.boundary == Boundary::Finite ? Tiling::Finite : settings.tiling);
    if (surface.name.empty()) surface.name = settings.file;
    return surface;
}

}  // namespace

Heightfield load_surface(const SurfaceSettings& settings, Run& run) {
    return settings.kind == kSurfaceFile ? load_file(settings) : make_surface(settings, run);
}

}  // namespace asperity::io

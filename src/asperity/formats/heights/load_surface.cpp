// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/tile_heights.h>

#include <utility>

namespace asperity::io {
namespace {

// One of the two given alone counts for both.
void apply_cell_size(Topography& surface, const SurfaceSettings& settings) {
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

HeightsOptions options_of(const SurfaceSettings& settings) {
    return {settings.file_format, settings.file_channel, settings.file_decimal};
}

Heightfield load_file(const SurfaceSettings& settings, Run& run) {
    if (settings.file.empty()) throw Error(ErrorCode::Usage, "the file name is empty", "surface");
    return surface_of(read_topography(settings.file, options_of(settings), run), settings);
}

}  // namespace

Heightfield surface_of(Topography topography, const SurfaceSettings& settings) {
    apply_cell_size(topography, settings);
    Heightfield surface = prepare(std::move(topography), settings.file);
    for (float& h : surface.heights)
        h = static_cast<float>(static_cast<double>(h) * settings.height_scale);
    if (settings.diagonal == Diagonal::Main) surface.diagonal = Diagonal::Main;

    validate(surface, settings.file);
    tile(surface, settings.boundary == Boundary::Finite ? Tiling::Finite : settings.tiling);
    if (surface.name.empty()) surface.name = settings.file;
    return surface;
}

std::vector<HeightsChannel> list_channels(const SurfaceSettings& settings, Run& run) {
    return HeightsFormats().list(HeightsSource(settings.file, options_of(settings), run));
}

Heightfield load_surface(const SurfaceSettings& settings, Run& run) {
    return settings.kind == kSurfaceFile ? load_file(settings, run) : make_surface(settings, run);
}

}  // namespace asperity::io

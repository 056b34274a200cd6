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

HeightsOptions options_of(const SurfaceSettings& settings) {
    return {settings.file_format, settings.file_channel, settings.file_decimal};
}

}  // namespace

Topography read_topography(const SurfaceSettings& settings, Run& run) {
    if (settings.file.empty()) throw Error(ErrorCode::Usage, "the file name is empty", "surface");
    Topography topography = read_topography(settings.file, options_of(settings), run);
    apply_cell_size(topography, settings);
    return topography;
}

std::vector<HeightsChannel> list_channels(const SurfaceSettings& settings, Run& run) {
    return HeightsFormats().list(HeightsSource(settings.file, options_of(settings), run));
}

Heightfield patch_of(Topography topography, const SurfaceSettings& settings, const Run& run) {
    const bool finite = settings.tiling == Tiling::Finite || settings.boundary == Boundary::Finite;
    if (finite || settings.tiling == Tiling::Mirrored) topography.boundary = Boundary::Finite;
    if (settings.tiling == Tiling::Periodic && !finite) topography.boundary = Boundary::Periodic;
    Heightfield surface = prepare(std::move(topography), settings.ready, settings.file, run);
    for (float& h : surface.heights)
        h = static_cast<float>(static_cast<double>(h) * settings.height_scale);
    if (settings.diagonal == Diagonal::Main) surface.diagonal = Diagonal::Main;
    if (surface.name.empty()) surface.name = settings.file;
    validate(surface, settings.file);
    return surface;
}

Heightfield load_patch(const SurfaceSettings& settings, Run& run) {
    if (settings.kind != kSurfaceFile) return make_surface(settings, run);
    return patch_of(read_topography(settings, run), settings, run);
}

Heightfield tiled(Heightfield patch, const SurfaceSettings& settings) {
    if (settings.kind != kSurfaceFile) return patch;
    const auto say = [](Heightfield surface, const char* how) {
        surface.tiling = how;
        return surface;
    };
    if (settings.tiling == Tiling::Finite || settings.boundary == Boundary::Finite)
        return say(std::move(patch), "a finite patch");
    if (settings.tiling == Tiling::Mirrored)
        return say(mirrored(patch), "mirrored to a periodic tile");
    if (settings.tiling == Tiling::Auto && patch.boundary == Boundary::Periodic)
        return say(std::move(patch), "periodic as the file says");
    if (settings.tiling == Tiling::Auto && !edges_fit(patch))
        return say(mirrored(patch),
                   "mirrored to a periodic tile, as its opposite edges do not fit");
    patch.boundary = Boundary::Periodic;
    return say(std::move(patch), settings.tiling == Tiling::Periodic
                                     ? "taken as periodic"
                                     : "periodic, as its opposite edges fit");
}

Heightfield surface_of(Topography topography, const SurfaceSettings& settings) {
    apply_cell_size(topography, settings);
    return tiled(patch_of(std::move(topography), settings, Run()), settings);
}

Heightfield load_surface(const SurfaceSettings& settings, Run& run) {
    return tiled(load_patch(settings, run), settings);
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/make_surface.h>

#include <asperity/core/error.h>
#include <asperity/core/memory.h>
#include <asperity/core/parse_number.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/check_settings.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_params.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace asperity {

namespace {

void scale_heights(Heightfield& surface, double factor, const Run& run) {
    if (factor == 1) return;
    const auto nx = static_cast<std::size_t>(surface.nx);
    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        for (std::size_t k = static_cast<std::size_t>(first) * nx;
             k < static_cast<std::size_t>(last) * nx; ++k) {
            const double height = factor * static_cast<double>(surface.heights[k]);
            if (std::abs(height) > 1e37)
                throw Error(ErrorCode::Usage, "heights grow beyond 1e37", "height-scale");
            surface.heights[k] = static_cast<float>(height);
        }
    });
}

/// Kind and settings, "ridges, tilt 45, period 16".
std::string default_name(const SurfaceKind& kind, const SurfaceSettings& settings) {
    std::string name = kind.name;
    for (const Param<SurfaceSettings>& param : surface_params()) {
        const std::string& key = param.info.name;
        const bool its_own = find(kind.own, key) != nullptr;
        if (its_own || std::find(kind.params.begin(), kind.params.end(), key) != kind.params.end())
            name += ", " + key + " " + param.text(settings);
    }
    return name;
}

Heightfield make_checked(const SurfaceKind& kind, const SurfaceSettings& settings, Run& run) {
    const CellSize cell = cell_size(settings);
    Heightfield surface;
    surface.nx = surface.ny = settings.size;
    surface.dx = 1;
    surface.dy = cell.y / cell.x;
    surface.diagonal = settings.diagonal;
    surface.boundary = settings.boundary;
    surface.isotropic = kind.isotropic && kind.isotropic(settings);
    surface.name = kind.describe ? kind.describe(settings) : default_name(kind, settings);
    const auto size = static_cast<std::size_t>(settings.size);
    require_memory(kind.bytes_per_sample * size * size,
                   fmt::format("a surface of {0} x {0} samples", size));
    run.begin("surface", kind.steps ? kind.steps(settings) : size);
    allocate(surface.heights, size * size, run);
    kind.fill(surface, settings, run);
    surface.dx = cell.x;
    surface.dy = cell.y;
    scale_heights(surface, cell.x * settings.height_scale, run);
    run.end();
    return surface;
}

}  // namespace

Heightfield make_surface(const SurfaceSettings& settings, Run& run) {
    if (settings.kind == kSurfaceFile)
        throw Error(ErrorCode::Usage, "a surface file is read, not made", "surface");
    const std::optional<SurfaceKind> kind = find_surface_kind(settings.kind);
    if (!kind)
        throw Error(ErrorCode::Usage, in_quotes(settings.kind) + " is no kind of surface",
                    "surface");
    check_settings(settings);
    if (kind->check) kind->check(settings);
    try {
        return make_checked(*kind, settings, run);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory,
                    fmt::format("no memory for {0} x {0} samples", settings.size), "size");
    }
}

}  // namespace asperity

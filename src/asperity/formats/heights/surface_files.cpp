// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/surface_files.h>

#include <asperity/core/error.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/heights/heights_format.h>

#include <new>

namespace asperity::io {

Heightfield empty_patch(std::uint64_t nx, std::uint64_t ny, const std::string& path) {
    check_sides(nx, ny, path);
    Heightfield surface;
    surface.nx = static_cast<int>(nx);
    surface.ny = static_cast<int>(ny);
    surface.heights.resize(static_cast<std::size_t>(nx * ny));
    surface.boundary = Boundary::Finite;
    surface.name = path;
    return surface;
}

Topography read_topography(const std::string& path, const HeightsOptions& options, Run& run) {
    try {
        return HeightsFormats().read(HeightsSource(path, options, run));
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

Heightfield read_heights(const std::string& path) {
    Run run(1);
    return prepare(read_topography(path, {}, run), {}, path, run);
}

void write_heights(const Heightfield& surface, const std::string& path) {
    const HeightsFormats formats;
    const HeightsFormat& format = formats.for_writing(path);
    validate(surface, path);
    format.write(surface, path);
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

/// What a model file may ask for. Declared sizes are compared with these and with the bytes of the
/// file before anything is allocated.
struct ModelLimits {
    std::uint64_t file_bytes = std::uint64_t{4} << 30;  ///< of the file, and of each it names
    std::uint64_t triangles = std::uint64_t{1} << 28;   ///< unique, and instanced
    std::uint64_t meshes = 1 << 20, instances = 1 << 20;
    int nodes_deep = 256;  ///< of a glTF scene
};

struct ModelReadSettings {
    NormalStyle normals = NormalStyle::AsGiven;
    double crease_deg = 180;  ///< for smooth normals, see set_normals
    bool fit = true;          ///< fit_to_unit_sphere
    ModelLimits limits;
};

/// A model as read, and what was left out to get a clean picture.
struct ModelFile {
    Model model;
    std::uint64_t dropped_triangles = 0;  ///< without area, or with a vertex that is not finite
    /// One line each, no full stop: missing material files and the like, which do no harm as
    /// materials are not read.
    std::vector<std::string> remarks;
};

/// Reads .obj, .ply (text and binary), .stl (text and binary), .gltf, .glb or .3ds, known by the
/// ending. Polygons are cut into triangles; points, lines, materials, textures, cameras, lights,
/// animation and bones are left out. Scenes keep their instances. Axes stay as they are in the
/// file, all taken as y up, but for .3ds, whose z is up and becomes y. Buffers that a .gltf names
/// are read from its own folder or below only.
///
/// Every file is walked through by code of ours. OBJ, PLY and STL are read on that walk: vertices
/// are those of the file, OBJ's doubled where a corner has another normal, STL's made one where
/// they lie at one place. Of glTF and 3DS the walk makes a copy with the triangles alone, whose
/// counts, indices and offsets hold, and that copy goes on to assimp; 3DS vertices of equal place
/// and normal are made one. (assimp 5.2's own PLY reader never returns from a header that is cut,
/// and its OBJ reader gives each corner a vertex of its own.)
///
/// Throws Error(InvalidInput, place), the place being "file:line" for text, "file:byte" for binary
/// files, where known; also for a file without a triangle to be drawn, and for coordinates beyond
/// 1e15 or a model less than 1e-15 across. Error(InputOutput, path), Error(OutOfMemory, path),
/// Error(Usage, "model") for another ending, Error(Usage, "crease") as set_normals.
ModelFile read_model(const std::string& path, const ModelReadSettings& settings = {});

/// True for an ending that read_model knows.
bool is_model_file(const std::string& path);

}  // namespace asperity::io

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
/// animation and bones are left out. Scenes keep their instances; axes stay as they are in the file
/// (all taken as y up). Buffers that a .gltf names are read from its own folder or below only.
///
/// Every file is walked through first, by code of ours, and only one whose counts, indices and
/// offsets hold goes on to assimp. Throws Error(InvalidInput, place), the place being "file:line"
/// for text, "file:byte" for binary files, where known; also for a file without triangles.
/// Error(InputOutput, path), Error(OutOfMemory, path), Error(Usage, "model") for another ending.
ModelFile read_model(const std::string& path, const ModelReadSettings& settings = {});

/// True for an ending that read_model knows.
bool is_model_file(const std::string& path);

}  // namespace asperity::io

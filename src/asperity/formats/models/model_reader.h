// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/models/model_format.h>
#include <asperity/render/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

struct ModelReadSettings {
    NormalStyle normals = NormalStyle::AsGiven;
    double crease_deg = 180;  ///< for smooth normals, see set_normals
    bool fit = true;          ///< fit_to_unit_sphere
    ModelLimits limits;
    std::vector<ModelFormat> formats;  ///< tried before those of model_formats()
};

/// A model as read, and what was left out to get a clean picture.
struct ModelFile {
    Model model;
    std::uint64_t dropped_triangles = 0;  ///< without area, or with a vertex that is not finite
    /// One line each, no full stop: what had to be assumed, or was found missing.
    std::vector<std::string> remarks;
};

/// Reads Wavefront OBJ, Stanford PLY and STL (both as text and binary), glTF 2.0 (.gltf and .glb)
/// or 3D Studio (.3ds). The content decides which; the ending where that says nothing. Polygons are
/// cut into triangles; points, lines, materials, textures, cameras, lights, animation and bones are
/// left out. Scenes keep their instances. Axes stay as they are in the file, all taken as y up, but
/// for .3ds, whose z is up and becomes y. Buffers that a .gltf names are read from its own folder
/// or below only.
///
/// Vertices are those of the file that triangles use; OBJ's doubled where a corner has another
/// normal, STL's made one where they lie at one place, as are those of .3ds of one place and
/// normal. Models that lie far from their origin, in the coordinates of a map, keep the precision
/// that the file has: meshes are taken about a centre of their own, instances put them back.
///
/// Throws Error(InvalidInput, place), the place being "file:line" for text, "file:byte" for binary
/// files, where known; also for a file without a triangle to be drawn, and for coordinates beyond
/// 1e15 or a model less than 1e-15 across. Error(InputOutput, path), Error(OutOfMemory, path),
/// Error(Usage, "model") for a file of another format, Error(Usage, "crease") as set_normals.
ModelFile read_model(const std::string& path, const ModelReadSettings& settings = {});

/// True for an ending of one of model_formats(), and for a file that is one of them by its content.
bool is_model_file(const std::string& path);

}  // namespace asperity::io

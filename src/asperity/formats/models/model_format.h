// SPDX-License-Identifier: Apache-2.0
// What a format of 3D models is. A program of yours can have read_model know one more:
// ModelReadSettings::formats.
#pragma once

#include <asperity/formats/read_file.h>
#include <asperity/render/mesh.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// What a model file may ask for. Declared sizes are compared with these and with the bytes of the
/// file before anything is allocated.
struct ModelLimits {
    std::uint64_t file_bytes = std::uint64_t{4} << 30;  ///< of the file, with all those it names
    std::uint64_t triangles = std::uint64_t{1} << 28;   ///< unique, and instanced
    std::uint64_t meshes = 1 << 20, instances = 1 << 20;
    int nodes_deep = 256;  ///< of a glTF scene
};

/// The file that a reader is given, and what it remarks on.
struct ModelSource {
    std::string path;
    ModelLimits limits;
    /// One line each, no full stop: what had to be assumed or left out.
    std::vector<std::string> remarks;
};

/// One row of the list of formats.
struct ModelFormat {
    std::string name;                  ///< in messages: "Wavefront OBJ"
    std::vector<std::string> endings;  ///< small letters with the dot: ".obj"
    /// Whether a file that starts like this is one. Throws nothing.
    std::function<bool(const FileStart&)> sniff;
    /// Meshes and instances as the file has them. Triangles that cannot be drawn may still be
    /// there; indices are in range; normals are none or one a vertex. Throws as read_model.
    std::function<Model(ModelSource&)> read;
};

/// The formats that read_model knows by itself. Of two that find a file theirs the first has it.
std::span<const ModelFormat> model_formats();

}  // namespace asperity::io

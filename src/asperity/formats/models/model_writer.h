// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <string>

namespace asperity::io {

/// Writes a mesh, whole or not at all, with the shortest decimals that read back to the same bits:
/// as text with its normals, when it has any. Throws Error(InputOutput, path).
void write_obj(const TriangleMesh& mesh, const std::string& path);

/// The same as binary, little-endian PLY.
void write_ply(const TriangleMesh& mesh, const std::string& path);

}  // namespace asperity::io

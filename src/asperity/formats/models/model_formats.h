// SPDX-License-Identifier: Apache-2.0
// One reader per model format, each in a file of its own, and what they share. A reader believes
// nothing: what a file declares is compared with its bytes before memory is taken for it, and every
// index with what there is.
#pragma once

#include <asperity/formats/models/model_format.h>

#include <string>
#include <string_view>

namespace asperity::io::detail {

// The rows of model_formats().
ModelFormat obj_format();
ModelFormat ply_format();
ModelFormat stl_format();
ModelFormat gltf_format();  ///< .gltf and .glb
ModelFormat threeds_format();

/// One mesh that stands once in the world, its own origin at `origin`.
void add_mesh(Model& model, TriangleMesh mesh, Vec3 origin = {});

/// Throws Error(InvalidInput) when there are more triangles or meshes than allowed.
void check_limits(const Model& model, const ModelSource& source);

[[noreturn]] void fail_at_line(const std::string& path, std::uint64_t line, std::string why);
[[noreturn]] void fail_at_byte(const std::string& path, std::uint64_t byte, std::string why);

/// Makes vertices of equal bits, position and normal, one. The first of them stays.
void join_equal_vertices(TriangleMesh& mesh);

}  // namespace asperity::io::detail

// SPDX-License-Identifier: Apache-2.0
// One reader per model format, called by read_model. Each believes nothing: what a file declares is
// compared with its bytes before memory is taken for it, and every index with what there is.
#pragma once

#include <asperity/formats/models/model_reader.h>

#include <string>
#include <string_view>
#include <vector>

namespace asperity::io::detail {

/// What a reader needs to know and may remark on.
struct ModelSource {
    std::string path;
    ModelLimits limits;
    std::vector<std::string> remarks;
};

// Each returns meshes and instances as the file has them: triangles that cannot be drawn are still
// there, indices are in range, normals are none or one a vertex. Errors as read_model.
Model read_obj(ModelSource& source);
Model read_ply(ModelSource& source);
Model read_stl(ModelSource& source);
Model read_gltf(ModelSource& source);  ///< .gltf and .glb
Model read_3ds(ModelSource& source);

/// One mesh that stands once in the world, untransformed.
void add_mesh(Model& model, TriangleMesh mesh);

/// Throws Error(InvalidInput) when there are more triangles or meshes than allowed.
void check_limits(const Model& model, const ModelSource& source);

[[noreturn]] void fail_at_line(const std::string& path, std::uint64_t line, std::string why);
[[noreturn]] void fail_at_byte(const std::string& path, std::uint64_t byte, std::string why);

/// Makes vertices of equal bits, position and normal, one. The first of them stays.
void join_equal_vertices(TriangleMesh& mesh);

}  // namespace asperity::io::detail

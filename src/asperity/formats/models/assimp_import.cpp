// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/assimp_import.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace asperity::io::detail {
namespace {

/// Opens memory where assimp means to open files.
class MemoryFiles final : public Assimp::IOSystem {
  public:
    explicit MemoryFiles(const std::vector<MemoryFile>& files) : files_(files) {}

    bool Exists(const char* name) const override { return find(name) != nullptr; }
    char getOsSeparator() const override { return '/'; }

    Assimp::IOStream* Open(const char* name, const char* mode) override {
        const std::string* const bytes = find(name);
        if (bytes == nullptr || std::strchr(mode, 'w') != nullptr) return nullptr;
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes->data()),
                                          bytes->size());
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

  private:
    const std::string* find(std::string_view name) const {
        if (name.starts_with("./")) name.remove_prefix(2);
        const auto found = std::find_if(files_.begin(), files_.end(),
                                        [&](const MemoryFile& f) { return f.first == name; });
        return found == files_.end() ? nullptr : &found->second;
    }

    const std::vector<MemoryFile>& files_;
};

Vec3f to_vec3f(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

TriangleMesh convert(const aiMesh& from) {
    TriangleMesh mesh;
    mesh.name = from.mName.C_Str();
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
        mesh.positions.push_back(to_vec3f(from.mVertices[v]));
        if (from.HasNormals()) mesh.normals.push_back(to_vec3f(from.mNormals[v]));
    }
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices == 3)  // not a point, not a line
            mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
    return mesh;
}

Transform convert(const aiMatrix4x4& m) {
    const auto d = [](float x) { return static_cast<double>(x); };
    return {{d(m.a1), d(m.b1), d(m.c1)},
            {d(m.a2), d(m.b2), d(m.c2)},
            {d(m.a3), d(m.b3), d(m.c3)},
            {d(m.a4), d(m.b4), d(m.c4)}};
}

/// First `inner`, then `outer`.
Transform combine(const Transform& outer, const Transform& inner) {
    return {outer.vector(inner.x), outer.vector(inner.y), outer.vector(inner.z),
            outer.point(inner.origin)};
}

// As deep as ModelLimits::nodes_deep lets a file go.
void add_instances(Model& model, const aiNode& node, const Transform& parent) {
    const Transform to_world = combine(parent, convert(node.mTransformation));
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        model.instances.push_back({node.mMeshes[i], to_world, Role::Subject});
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        add_instances(model, *node.mChildren[i], to_world);
}

}  // namespace

Model import_with_assimp(const std::vector<MemoryFile>& files, const std::string& path) {
    Assimp::Importer importer;
    importer.SetIOHandler(new MemoryFiles(files));  // the importer deletes it
    const aiScene* const scene = importer.ReadFile(files.front().first, aiProcess_Triangulate);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("assimp cannot read it: {}", in_quotes(importer.GetErrorString())),
                    path);
    Model model;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m)
        model.meshes.push_back(convert(*scene->mMeshes[m]));
    add_instances(model, *scene->mRootNode, {});
    return model;
}

}  // namespace asperity::io::detail

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/model_writer.h>

#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>

namespace asperity::io {
namespace {

static_assert(std::endian::native == std::endian::little);

void append_triple(std::string& text, const char* what, Vec3f v) {
    text += fmt::format("{} {} {} {}\n", what, shortest(v.x), shortest(v.y), shortest(v.z));
}

template <typename Number>
void append(std::string& bytes, Number value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    bytes.append(raw.data(), raw.size());
}

void write_file(const std::string& path, const std::string& bytes) {
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace

void write_obj(const TriangleMesh& mesh, const std::string& path) {
    std::string text;
    if (!mesh.name.empty()) text = "o " + mesh.name + "\n";
    for (const Vec3f p : mesh.positions) append_triple(text, "v", p);
    for (const Vec3f n : mesh.normals) append_triple(text, "vn", n);
    for (const auto& t : mesh.triangles) {
        text += 'f';
        for (const std::uint32_t v : t) {
            // Indices count from 1; a vertex and its normal have the same.
            const std::uint64_t index = std::uint64_t{v} + 1;
            if (mesh.normals.empty())
                text += fmt::format(" {}", index);
            else
                text += fmt::format(" {}//{}", index, index);
        }
        text += '\n';
    }
    write_file(path, text);
}

void write_ply(const TriangleMesh& mesh, const std::string& path) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n{}"
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.positions.size(),
        mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
        mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        append(bytes, mesh.positions[v]);
        if (!mesh.normals.empty()) append(bytes, mesh.normals[v]);
    }
    for (const auto& t : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        append(bytes, t);
    }
    write_file(path, bytes);
}

}  // namespace asperity::io

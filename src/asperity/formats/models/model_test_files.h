// SPDX-License-Identifier: Apache-2.0
// One tetrahedron in every model format, for tests: corners (0,0,0), (1,0,0), (0,1,0), (0,0,1),
// four faces that turn outwards, volume 1/6.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io::test {

inline constexpr std::array<std::array<float, 3>, 4> kCorners = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<std::array<std::uint16_t, 3>, 4> kFaces = {
    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

template <typename Number>
std::string raw(Number value, std::endian order = std::endian::little) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    std::string text(bytes.data(), bytes.size());
    return order == std::endian::native ? text : std::string(text.rbegin(), text.rend());
}

inline std::string obj_file() {
    return "# a tetrahedron\nmtllib none.mtl\no tetra\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
           "vt 0.5 0.5\nusemtl red\ns off\nf 1/1 3/1 2/1\nf 1 2 4\nf -4 -1 -2\nf 2 3 4\n";
}

inline std::string ply_header(const char* format) {
    return std::string("ply\nformat ") + format +
           " 1.0\ncomment a tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nelement face 4\n"
           "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
           "element edge 1\nproperty int v1\nend_header\n";
}

inline std::string ply_text_file() {
    return ply_header("ascii") +
           "0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n"
           "3 0 2 1 0\n3 0 1 3 2 0.5 0.5\n3 0 3 2 0\n3 1 2 3 0\n7\n";
}

inline std::string ply_binary_file(std::endian order) {
    std::string file =
        ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
    for (const auto& corner : kCorners) {
        for (const float x : corner) file += raw(x, order);
        file += '\xff';
    }
    for (const auto& face : kFaces) {
        file += '\x03';
        for (const std::uint16_t v : face) file += raw(std::int32_t{v}, order);
        file += '\x01' + raw(0.5f, order);
    }
    return file + raw(std::int32_t{7}, order);
}

inline std::string stl_text_file() {
    std::string file = "solid tetra hedron\n";
    for (const auto& face : kFaces) {
        file += " facet normal 0 0 0\n  outer loop\n";
        for (const std::uint16_t v : face) {
            file += "   vertex";
            for (const float x : kCorners[v]) file += x > 0 ? " 1.0e+0" : " 0";
            file += "\n";
        }
        file += "  endloop\n endfacet\n";
    }
    return file + "endsolid tetra hedron\n";
}

inline std::string stl_binary_file() {
    std::string file = "solid in name only";  // as some programs write
    file.resize(80, ' ');
    file += raw(std::uint32_t{4});
    for (const auto& face : kFaces) {
        file += std::string(12, '\0');
        for (const std::uint16_t v : face) {
            for (const float x : kCorners[v]) file += raw(x);
        }
        file += std::string(2, '\0');
    }
    return file;
}

/// Positions, then indices.
inline std::string gltf_buffer() {
    std::string bytes;
    for (const auto& corner : kCorners) {
        for (const float x : corner) bytes += raw(x);
    }
    for (const auto& face : kFaces) {
        for (const std::uint16_t v : face) bytes += raw(v);
    }
    return bytes;
}

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const char c = i + k < bytes.size() ? bytes[i + k] : '\0';
            bits = (bits << 8) | static_cast<unsigned char>(c);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool is_padding = i + k > bytes.size();
            text += is_padding ? '=' : kDigits[(bits >> (18 - 6 * k)) & 63];
        }
    }
    return text;
}

/// The tetrahedron twice: as it is, and below a parent, twice as large and moved to x = 10.
/// `buffer` is what stands in the buffer, such as R"(,"uri":"a.bin")".
inline std::string gltf_json(const std::string& buffer) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":72)" + buffer + R"(}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},
{"buffer":0,"byteOffset":48,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"meshes":[{"name":"tetra","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":3}]}],
"nodes":[{"mesh":0},{"translation":[10,0,0],"children":[2]},{"mesh":0,"scale":[2,2,2]}],
"scenes":[{"nodes":[0,1]}],"scene":0})";
}

inline std::string gltf_file() {
    return gltf_json(R"(,"uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer()) +
                     "\"");
}

inline std::string glb_file() {
    std::string json = gltf_json("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string binary = gltf_buffer();
    const std::string body = raw(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
                             raw(static_cast<std::uint32_t>(binary.size())) +
                             std::string("BIN\0", 4) + binary;
    return "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + body.size())) +
           body;
}

inline std::string chunk_3ds(std::uint16_t id, const std::string& content) {
    return raw(id) + raw(static_cast<std::uint32_t>(6 + content.size())) + content;
}

/// Each face in a smoothing group of its own, which keeps its edges; a material and a key frame to
/// be left out.
inline std::string threeds_file() {
    std::string vertices = raw(std::uint16_t{4}), faces = raw(std::uint16_t{4}), groups;
    for (const auto& corner : kCorners) {
        for (const float x : corner) vertices += raw(x);
    }
    for (const auto& face : kFaces) {
        for (const std::uint16_t v : face) faces += raw(v);
        faces += raw(std::uint16_t{7});
        groups += raw(std::uint32_t{1} << groups.size() / 4);
    }
    const std::string mesh =
        chunk_3ds(0x4110, vertices) + chunk_3ds(0x4120, faces + chunk_3ds(0x4150, groups));
    const std::string object = std::string("tetra\0", 6) + chunk_3ds(0x4100, mesh);
    const std::string material = chunk_3ds(0xafff, chunk_3ds(0xa000, std::string("red\0", 4)));
    return chunk_3ds(0x4d4d, chunk_3ds(0x0002, raw(std::uint32_t{3})) +
                                 chunk_3ds(0x3d3d, material + chunk_3ds(0x4000, object)) +
                                 chunk_3ds(0xb000, chunk_3ds(0xb00a, std::string(8, '\0'))));
}

struct TestFile {
    const char* name;
    std::string bytes;
};

/// As GoogleTest shall name it.
inline void PrintTo(const TestFile& file, std::ostream* out) {
    *out << file.name;
}

/// The tetrahedron in every format and encoding.
inline std::vector<TestFile> model_test_files() {
    return {{"a.obj", obj_file()},
            {"text.ply", ply_text_file()},
            {"little.ply", ply_binary_file(std::endian::little)},
            {"big.ply", ply_binary_file(std::endian::big)},
            {"text.stl", stl_text_file()},
            {"binary.stl", stl_binary_file()},
            {"a.gltf", gltf_file()},
            {"a.glb", glb_file()},
            {"a.3ds", threeds_file()}};
}

}  // namespace asperity::io::test

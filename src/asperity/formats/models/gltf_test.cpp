// SPDX-License-Identifier: Apache-2.0
// The ways in which a glTF file may keep its triangles.
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/models/model_test_reading.h>
#include <asperity/formats/test_files.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace asperity::io {
namespace {

using test::expect_error;
using test::expect_tetrahedron;
using test::has_remark;
using test::put;
using test::read_bytes;
using test::TemporaryFolder;

// Position and normal side by side, in both orders: a stride of 24 bytes.
TEST(Gltf, Interleaved) {
    for (const bool normal_first : {false, true}) {
        std::string bytes;
        for (const auto& face : test::kFaces) {
            for (const std::uint16_t v : face) {
                std::string position;
                for (const float x : test::kCorners[v]) position += test::raw(x);
                const std::string normal =
                    test::raw(0.0f) + test::raw(0.0f) + test::raw(static_cast<float>(v) - 1.5f);
                bytes += normal_first ? normal + position : position + normal;
            }
        }
        const std::string json = fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":288,"uri":"data:;base64,{}"}}],
"bufferViews":[{{"buffer":0,"byteLength":288,"byteStride":24}}],
"accessors":[{{"bufferView":0,"byteOffset":{},"componentType":5126,"count":12,"type":"VEC3"}},
{{"bufferView":0,"byteOffset":{},"componentType":5126,"count":12,"type":"VEC3"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],"nodes":[{{"mesh":0}}]}})",
            test::base64(bytes), normal_first ? 12 : 0, normal_first ? 0 : 12);
        const ModelFile read = read_bytes("a.gltf", json);
        expect_tetrahedron(read, 12);
        EXPECT_EQ(read.model.meshes[0].normals[0], (Vec3f{0, 0, -1}));
        EXPECT_EQ(read.model.meshes[0].normals[1], (Vec3f{0, 0, 1}));
    }
}

// A quarter turn about y takes x to -z; then moved, then all of it twice as large by the parent.
TEST(Gltf, NodesTurnAndMove) {
    const std::string json = test::gltf_file();
    const std::string nodes = R"("nodes":[{"mesh":0,"rotation":[0,0.7071067811865476,0,)"
                              R"(0.7071067811865476],"translation":[1,2,3],"scale":[3,1,1]},
{"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,5,6,7,1],"children":[0]}])";
    const std::size_t begin = json.find("\"nodes\""), end = json.find(",\n\"scenes\"");
    const ModelFile read =
        read_bytes("a.gltf", json.substr(0, begin) + nodes + R"(,"scenes":[{"nodes":[1]}]})" +
                                 (end == std::string::npos ? "" : ""));
    const Transform& t = read.model.instances.at(0).to_world;
    const Vec3 x = t.point({1, 0, 0});
    EXPECT_NEAR(x.x, 5 + 2 * 1, 1e-12);
    EXPECT_NEAR(x.y, 6 + 2 * 2, 1e-12);
    EXPECT_NEAR(x.z, 7 + 2 * (3 - 3), 1e-12);
}

// Strips turn every second triangle: a strip over a square and a fan over it cover the same.
TEST(Gltf, StripsAndFans) {
    for (const auto& [mode, order] : {std::pair{5, "0123"}, {6, "0132"}}) {
        std::string bytes;
        constexpr float kSquare[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
        for (const char* c = order; *c != 0; ++c) {
            for (const float x : kSquare[*c - '0']) bytes += test::raw(x);
            bytes += test::raw(0.0f);
        }
        const std::string json = fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":48,"uri":"data:;base64,{}"}}],
"bufferViews":[{{"buffer":0,"byteLength":48}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{}}}]}}],"nodes":[{{"mesh":0}}]}})",
            test::base64(bytes), mode);
        const ModelFile read = read_bytes("a.gltf", json);
        const TriangleMesh& mesh = read.model.meshes.at(0);
        ASSERT_EQ(mesh.triangles.size(), 2u);
        for (const auto& t : mesh.triangles) {
            const Vec3 a = to_double(mesh.positions[t[0]]), b = to_double(mesh.positions[t[1]]),
                       c = to_double(mesh.positions[t[2]]);
            EXPECT_NEAR(cross(b - a, c - a).z, 1, 1e-12) << mode;
        }
    }
}

// Thousands of buffers that name one file of a megabyte: it is read once.
TEST(Gltf, BuffersOfOneFileAreOne) {
    const TemporaryFolder folder;
    put(folder / "a.bin", test::gltf_buffer() + std::string(1 << 20, '\0'));
    std::string buffers, views = R"({"buffer":3999,"byteOffset":48,"byteLength":24})";
    for (int i = 0; i < 4000; ++i)
        buffers += fmt::format(R"({}{{"byteLength":72,"uri":"{}a.bin"}})", i > 0 ? "," : "",
                               i % 2 ? "./" : "");
    std::string accessors, primitives;
    for (int i = 0; i < 4000; ++i) {
        views += fmt::format(R"(,{{"buffer":{},"byteLength":48}})", i);
        accessors += fmt::format(
            R"(,{{"bufferView":{},"componentType":5126,"count":4,"type":"VEC3"}})", i + 1);
        primitives += fmt::format(R"({}{{"attributes":{{"POSITION":{}}},"indices":0}})",
                                  i > 0 ? "," : "", i + 1);
    }
    put(folder / "a.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[)" + buffers + R"(],"bufferViews":[)" + views +
            R"(],"accessors":[{"bufferView":0,"componentType":5123,"count":12,"type":"SCALAR"})" +
            accessors + R"(],"meshes":[{"primitives":[)" + primitives +
            R"(]}],"nodes":[{"mesh":0}]})");
    ModelReadSettings settings;
    settings.limits.file_bytes = 2 << 20;  // all buffers together
    EXPECT_EQ(statistics(read_model(folder / "a.gltf", settings).model).meshes, 4000u);
}

/// The faces of the tetrahedron in bufferView 0; `positions` is accessor 0, accessor 1 are the
/// indices; further views begin behind the 24 bytes of the faces.
std::string scene(const std::string& positions, const std::string& views, const std::string& bytes,
                  const std::string& more = "", const std::string& node = "") {
    std::string faces;
    for (const auto& face : test::kFaces) {
        for (const std::uint16_t v : face) faces += test::raw(v);
    }
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"data:;base64,{}"}}],
"bufferViews":[{{"buffer":0,"byteLength":24}}{}],
"accessors":[{{"type":"VEC3","count":4{}}},
{{"bufferView":0,"componentType":5123,"count":12,"type":"SCALAR"}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"nodes":[{{"mesh":0{}}}]{}}})",
        faces.size() + bytes.size(), test::base64(faces + bytes), views, positions, node, more);
}

std::string view(std::size_t offset, std::size_t length, const std::string& more = "") {
    return fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", 24 + offset, length,
                       more);
}

/// Corners 1 to 3, which are not zero.
std::string corners_of_sparse_list() {
    std::string bytes;
    for (std::size_t v = 1; v < 4; ++v) {
        for (const float x : test::kCorners[v]) bytes += test::raw(x);
    }
    return bytes;
}

// Values that replace zeros, and values that replace others.
TEST(Gltf, SparseLists) {
    const std::string places{"\x01\x02\x03\x00", 4};
    const std::string values = corners_of_sparse_list();
    const auto sparse = [](int first_view) {
        return fmt::format(
            R"(,"componentType":5126,"sparse":{{"count":3,"indices":{{"bufferView":{},)"
            R"("componentType":5121}},"values":{{"bufferView":{}}}}})",
            first_view, first_view + 1);
    };
    const std::string views = view(0, 3) + view(4, 36);
    expect_tetrahedron(read_bytes("a.gltf", scene(sparse(1), views, places + values)));
    std::string wrong;
    for (int i = 0; i < 12; ++i) wrong += test::raw(i < 3 ? 0.0f : 7.0f);
    expect_tetrahedron(read_bytes("a.gltf", scene(sparse(1) + R"(,"bufferView":3)",
                                                  views + view(40, 48), places + values + wrong)));
    const TemporaryFolder folder;
    for (const char* bad : {"\x01\x03\x02", "\x01\x02\x04", "\x01\x01\x02"}) {
        put(folder / "a.gltf", scene(sparse(1), views, bad + std::string(1, '\0') + values));
        expect_error(ErrorCode::InvalidInput, "of a sparse list is",
                     [&] { read_model(folder / "a.gltf"); });
    }
    put(folder / "a.gltf", scene(sparse(1), view(0, 3) + view(4, 35), places + values));
    expect_error(ErrorCode::InvalidInput, "does not lie in its bufferView of 35",
                 [&] { read_model(folder / "a.gltf"); });
}

// Positions as whole numbers, which only a file that says so may have: as they are, scaled by the
// node, and as parts of the largest.
TEST(Gltf, QuantizedPositions) {
    const std::string used = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    const auto packed = [](auto one) {
        std::string bytes;
        for (const auto& corner : test::kCorners) {
            for (const float x : corner) bytes += test::raw(static_cast<decltype(one)>(x * one));
            bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        }
        return bytes;
    };
    const auto file = [&](int type, const std::string& bytes, const std::string& normalized,
                          const std::string& node, const std::string& extension) {
        const std::string stride = fmt::format(R"(,"byteStride":{})", bytes.size() / 4);
        return scene(fmt::format(R"(,"bufferView":1,"componentType":{}{})", type, normalized),
                     view(0, bytes.size(), stride), bytes, extension, node);
    };
    const std::string scaled = R"(,"scale":[0.01,0.01,0.01])", parts = R"(,"normalized":true)";
    const std::string bytes16 = packed(std::int16_t{100}), bytes8 = packed(std::int8_t{100});
    expect_tetrahedron(read_bytes("a.gltf", file(5122, bytes16, "", scaled, used)));
    expect_tetrahedron(read_bytes("a.gltf", file(5120, bytes8, "", scaled, used)));
    expect_tetrahedron(
        read_bytes("a.gltf", file(5122, packed(std::int16_t{32767}), parts, "", used)));
    expect_tetrahedron(
        read_bytes("a.gltf", file(5123, packed(std::uint16_t{65535}), parts, "", used)));
    expect_tetrahedron(
        read_bytes("a.gltf", file(5121, packed(std::uint8_t{255}), parts, "", used)));
    const ModelFile half = read_bytes(
        "a.gltf", file(5120, packed(std::int8_t{-128}), parts, "", used));  // -128 is -1, too
    EXPECT_EQ(half.model.meshes[0].positions[1].x, -1.0f);
    const TemporaryFolder folder;
    put(folder / "a.gltf", file(5122, bytes16, "", scaled, ""));
    expect_error(ErrorCode::InvalidInput, "wrong type", [&] { read_model(folder / "a.gltf"); });
}

// What would move the vertices and is not done is said.
TEST(Gltf, MorphTargetsAndSkinsAreSaid) {
    std::string json = test::gltf_file();
    const std::string mesh = R"("name":"tetra",)";
    json.insert(json.find(mesh), R"("weights":[0,0.5],)");
    EXPECT_TRUE(has_remark(read_bytes("a.gltf", json), "morph targets"));
    json = test::gltf_file();
    json.insert(json.find(mesh), R"("weights":[0],)");
    EXPECT_FALSE(has_remark(read_bytes("a.gltf", json), "morph targets"));
    json.insert(json.find(R"("translation")"), R"("skin":0,)");
    EXPECT_TRUE(has_remark(read_bytes("a.gltf", json), "skin"));
}

}  // namespace
}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
// What programs write that a strict reader would stumble over, and models that are far away.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/test_files.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace asperity::io {
namespace {

using test::expect_error;
using test::put;
using test::TemporaryFolder;

/// The tetrahedron of the test files, whatever the bytes around it: 4 faces, 1/6 of a cube in all.
void expect_tetrahedron(const ModelFile& file, std::size_t vertices = 4) {
    const ModelStatistics s = statistics(file.model);
    EXPECT_EQ(s.unique_triangles, 4u);
    EXPECT_EQ(s.unique_vertices, vertices);
    EXPECT_EQ(file.dropped_triangles, 0u);
    double volume = 0;
    const Instance& first = file.model.instances.at(0);
    const TriangleMesh& mesh = file.model.meshes[first.mesh];
    const Vec3 origin = first.to_world.point({});
    const auto at = [&](std::uint32_t v) {
        return first.to_world.point(to_double(mesh.positions[v])) - origin;
    };
    for (const auto& t : mesh.triangles) volume += dot(at(t[0]), cross(at(t[1]), at(t[2]))) / 6;
    EXPECT_NEAR(volume, 1 / 6.0, 1e-6);
}

ModelFile read_bytes(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    ModelReadSettings settings;
    settings.fit = false;
    return read_model(folder / name, settings);
}

bool has_remark(const ModelFile& file, const std::string& part) {
    return std::any_of(file.remarks.begin(), file.remarks.end(), [&](const std::string& remark) {
        return remark.find(part) != std::string::npos;
    });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

TEST(ModelKinds, ContentDecidesBeforeTheEnding) {
    for (const test::TestFile& file : test::model_test_files()) {
        SCOPED_TRACE(file.name);
        const TemporaryFolder folder;
        put(folder / "model", file.bytes);
        EXPECT_TRUE(is_model_file(folder / "model"));
        EXPECT_TRUE(read_model(folder / "model").remarks.size() <= 1);  // OBJ's material file
        const bool is_stl = std::string(file.name).ends_with(".stl");
        put(folder / (is_stl ? "a.ply" : "a.stl"), file.bytes);
        const ModelFile read = read_model(folder / (is_stl ? "a.ply" : "a.stl"));
        EXPECT_TRUE(has_remark(read, "whatever its ending says"));
    }
    const TemporaryFolder folder;
    put(folder / "words", "vanity\nfair\n");
    EXPECT_FALSE(is_model_file(folder / "words"));
    EXPECT_FALSE(is_model_file(folder.path()));
}

// A format of a user's own: a line of nine numbers is a triangle.
TEST(ModelKinds, AProgramAddsARow) {
    const ModelFormat lines{
        "triangles by lines",
        {".tri"},
        [](const FileStart& start) { return start.bytes.starts_with("triangles"); },
        [](ModelSource& source) {
            const std::string text = read_text_file(source.path, source.limits.file_bytes);
            TriangleMesh mesh;
            std::vector<float> numbers;
            for (const std::string_view word : split(std::string_view(text).substr(10), ' '))
                numbers.push_back(static_cast<float>(parse_double(word).value_or(0)));
            for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
                mesh.positions.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
            mesh.triangles = {{0, 1, 2}};
            Model model;
            model.meshes.push_back(mesh);
            model.instances.push_back({});
            return model;
        }};
    const TemporaryFolder folder;
    ModelReadSettings settings;
    settings.formats = {lines};
    for (const char* name : {"a.tri", "a.obj", "a"}) {
        put(folder / name, "triangles 0 0 0 1 0 0 0 1 0");
        EXPECT_EQ(statistics(read_model(folder / name, settings).model).unique_triangles, 1u);
    }
    expect_error(ErrorCode::Usage, "no model file", [&] { read_model(folder / "a.tri"); });
}

TEST(ModelKinds, ByteOrderMarks) {
    for (const test::TestFile& file : test::model_test_files()) {
        const std::string name = file.name;
        if (name == "a.glb" || name == "a.3ds" || name == "binary.stl") continue;
        SCOPED_TRACE(name);
        const ModelFile read = read_bytes(name, "\xef\xbb\xbf" + file.bytes);
        EXPECT_EQ(statistics(read.model).unique_triangles, 4u);
        const TemporaryFolder folder;
        put(folder / name, "\xff\xfe" + file.bytes);
        expect_error(ErrorCode::InvalidInput, "UTF-16", [&] { read_model(folder / name); });
    }
}

TEST(ModelKinds, LineEnds) {
    for (const char* end : {"\r\n", "\r"}) {
        expect_tetrahedron(read_bytes("a.obj", replaced(test::obj_file(), "\n", end)));
        expect_tetrahedron(read_bytes("a.ply", replaced(test::ply_text_file(), "\n", end)));
        expect_tetrahedron(read_bytes("a.stl", replaced(test::stl_text_file(), "\n", end)));
        std::string binary = test::ply_binary_file(std::endian::little);
        const std::size_t body = binary.find("end_header\n") + 11;
        binary = replaced(binary.substr(0, body), "\n", end) + binary.substr(body);
        expect_tetrahedron(read_bytes("a.ply", binary));
    }
    const TemporaryFolder folder;
    put(folder / "a.obj", "v 0 0 0\rv 1 0 0\rf 1 2 3\r");
    expect_error(ErrorCode::InvalidInput, "a.obj:3: ", [&] { read_model(folder / "a.obj"); });
}

TEST(ModelKinds, ObjWithNothingBehindItsSeparators) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\n";
    for (const char* tail : {"/", "//", "/1", "/1/", "/-1/"}) {
        const std::string f =
            replaced("f 1# 3# 2#\nf 1# 2# 4#\nf 1# 4# 3#\nf 2# 3# 4#\n", "#", tail);
        expect_tetrahedron(read_bytes("a.obj", corners + f));
    }
}

TEST(ModelKinds, StlInCapitals) {
    std::string text = test::stl_text_file();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    expect_tetrahedron(read_bytes("a.stl", text));
    expect_tetrahedron(read_bytes("a.stl", replaced(test::stl_text_file(), "facet", "Facet")));
}

// Position and normal side by side, in both orders: a stride of 24 bytes.
TEST(ModelKinds, GltfInterleaved) {
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
TEST(ModelKinds, GltfNodesTurnAndMove) {
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
TEST(ModelKinds, GltfStripsAndFans) {
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
TEST(ModelKinds, GltfBuffersOfOneFileAreOne) {
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

std::string moved_obj(double x, double y) {
    return fmt::format(
        "v {0:.3f} {1:.3f} 0\nv {2:.3f} {1:.3f} 0\nv {0:.3f} {3:.3f} 0\n"
        "v {0:.3f} {1:.3f} 1\nv 0 0 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
        x, y, x + 1, y + 1);
}

std::string moved_ply(double x, double y) {
    std::string text = replaced(test::ply_text_file(), "float", "double");
    const std::size_t body = text.find("0 0 0 255"), faces = text.find("3 0 2 1");
    return text.substr(0, body) +
           fmt::format(
               "{0:.3f} {1:.3f} 0 255\n{2:.3f} {1:.3f} 0 255\n{0:.3f} {3:.3f} 0 255\n"
               "{0:.3f} {1:.3f} 1 255\n",
               x, y, x + 1, y + 1) +
           text.substr(faces);
}

// At 5 million single precision leaves steps of half a unit: the tetrahedron would fall to pieces.
TEST(ModelKinds, FarModelsKeepTheirPrecision) {
    constexpr double kX = 4567890.125, kY = 5432109.25;
    for (const auto& [name, bytes] :
         {std::pair{"a.obj", moved_obj(kX, kY)}, {"a.ply", moved_ply(kX, kY)}}) {
        SCOPED_TRACE(name);
        const ModelFile read = read_bytes(name, bytes);
        expect_tetrahedron(read);
        EXPECT_TRUE(has_remark(read, "no precision is lost"));
        EXPECT_TRUE(has_remark(read, "tracing there loses precision"));
        EXPECT_NEAR(bounds(read.model).low.x, kX, 1e-6);
        EXPECT_NEAR(bounds(read.model).high.y, kY + 1, 1e-6);
    }
    std::string stl = test::stl_text_file();
    stl = replaced(replaced(stl, "vertex 0", "vertex 4567890"), "vertex 1.0e+0", "vertex 4567891");
    expect_tetrahedron(read_bytes("a.stl", stl));
}

// Binary files of single precision keep what they have, which is little, and say so.
TEST(ModelKinds, FarModelsOfSinglePrecisionAreRemarkedOn) {
    const auto stl_at = [](float x) {
        std::string file = test::stl_binary_file();
        for (std::size_t corner = 0; corner < 12; ++corner) {
            const std::size_t place = 84 + corner / 3 * 50 + 12 + corner % 3 * 12;
            float value;
            std::memcpy(&value, file.data() + place, sizeof value);
            file.replace(place, 4, test::raw(value + x));
        }
        return file;
    };
    const ModelFile near = read_bytes("a.stl", stl_at(100));
    expect_tetrahedron(near);
    EXPECT_TRUE(near.remarks.empty());
    EXPECT_NEAR(bounds(near.model).high.x, 101, 1e-6);
    const ModelFile far = read_bytes("a.stl", stl_at(65536));
    expect_tetrahedron(far);
    EXPECT_TRUE(has_remark(far, "single precision of the file leaves steps of 0.0078"));
}

TEST(ModelKinds, ThreedsSmoothingGroupsJoinFacets) {
    const auto with_groups = [](std::array<std::uint32_t, 4> groups) {
        std::string file = test::threeds_file();
        const std::size_t place = file.find(test::raw(std::uint16_t{0x4150})) + 6;
        for (std::size_t f = 0; f < 4; ++f) file.replace(place + 4 * f, 4, test::raw(groups[f]));
        return statistics(read_bytes("a.3ds", file).model).unique_vertices;
    };
    EXPECT_EQ(with_groups({1, 1, 1, 1}), 4u);   // all smooth
    EXPECT_EQ(with_groups({0, 0, 0, 0}), 12u);  // all flat
    EXPECT_EQ(with_groups({1, 2, 4, 8}), 12u);  // nothing in common
    EXPECT_EQ(with_groups({1, 1, 0, 0}), 10u);  // two facets share the ends of one side
    // At vertex 0 the first facet is joined to both others, those not to each other: three. At 1
    // and 2 it is joined to one, the last is flat: two each. At 3 nothing is in common: three.
    EXPECT_EQ(with_groups({3, 1, 2, 0}), 10u);
}

// All facets of an object round one vertex, each in groups of its own.
TEST(ModelKinds, ThreedsTimeIsInProportion) {
    constexpr std::uint16_t kMany = 65000;
    std::string vertices = test::raw(kMany), faces = test::raw(kMany), groups;
    for (std::uint32_t v = 0; v < kMany; ++v)
        vertices += test::raw(static_cast<float>(v % 251)) +
                    test::raw(static_cast<float>(v / 251)) + test::raw(static_cast<float>(v % 7));
    for (std::uint32_t f = 0; f < kMany; ++f) {
        faces += test::raw(std::uint16_t{0}) + test::raw(static_cast<std::uint16_t>(f)) +
                 test::raw(static_cast<std::uint16_t>((f + 1) % kMany)) +
                 test::raw(std::uint16_t{0});
        groups += test::raw(f * 2654435761u | 1u);
    }
    const std::string mesh = test::chunk_3ds(0x4110, vertices) +
                             test::chunk_3ds(0x4120, faces + test::chunk_3ds(0x4150, groups));
    const std::string object = std::string("a\0", 2) + test::chunk_3ds(0x4100, mesh);
    const ModelFile read = read_bytes(
        "a.3ds", test::chunk_3ds(0x4d4d, test::chunk_3ds(0x3d3d, test::chunk_3ds(0x4000, object))));
    EXPECT_GT(statistics(read.model).unique_triangles, 60000u);
}

TEST(ModelKinds, NormalsThatAreNoneAreReplaced) {
    const std::string file =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 1\nvn 0 0 0\nvn inf 0 0\nf 1//1 2//2 3//3\n";
    const ModelFile read = read_bytes("a.obj", file);
    for (const Vec3f n : read.model.meshes.at(0).normals) EXPECT_EQ(n, (Vec3f{0, 0, 1}));
}

}  // namespace
}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
// What programs write that a strict reader would stumble over, and models that are far away.
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/models/model_test_reading.h>
#include <asperity/formats/test_files.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

namespace asperity::io {
namespace {

using test::expect_error;
using test::expect_tetrahedron;
using test::has_remark;
using test::put;
using test::read_bytes;
using test::TemporaryFolder;

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

// The elements may come in any order, and a scan may have strips in place of faces.
TEST(ModelKinds, PlyFacesFirst) {
    const std::string text = test::ply_text_file();
    const std::size_t vertex = text.find("element vertex"), face = text.find("element face"),
                      edge = text.find("element edge"), body = text.find("end_header\n") + 11,
                      faces = text.find("3 0 2 1");
    const std::string swapped = text.substr(0, vertex) + text.substr(face, edge - face) +
                                text.substr(vertex, face - vertex) + "end_header\n" +
                                text.substr(faces, text.rfind("7\n") - faces) +
                                text.substr(body, faces - body);
    expect_tetrahedron(read_bytes("a.ply", swapped));
    const TemporaryFolder folder;
    put(folder / "a.ply", replaced(swapped, "3 1 2 3", "3 1 2 4"));
    expect_error(ErrorCode::InvalidInput, "refers to vertex 4, the file has 4",
                 [&] { read_model(folder / "a.ply"); });
}

TEST(ModelKinds, PlyStrips) {
    const auto strips = [](const std::string& indices) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" +
               indices + "\n";
    };
    expect_tetrahedron(read_bytes("a.ply", strips("6 0 2 1 3 0 2")));
    expect_tetrahedron(read_bytes("a.ply", strips("12 0 2 1 3 -1 0 3 2 -1 0 1 3")));
    const TemporaryFolder folder;
    put(folder / "a.ply", strips("3 0 2 -2"));
    expect_error(ErrorCode::InvalidInput, "refers to vertex -2",
                 [&] { read_model(folder / "a.ply"); });
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

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/model_reader.h>

#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/models/model_writer.h>
#include <asperity/formats/test_files.h>
#include <asperity/render/builtin_models.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace asperity::io {
namespace {

using test::expect_error;
using test::put;
using test::TemporaryFolder;

double volume(const Model& model) {
    double sum = 0;
    for (const Instance& instance : model.instances) {
        const TriangleMesh& mesh = model.meshes[instance.mesh];
        const auto at = [&](std::uint32_t v) {
            return instance.to_world.point(to_double(mesh.positions[v]));
        };
        for (const auto& t : mesh.triangles) sum += dot(at(t[0]), cross(at(t[1]), at(t[2]))) / 6;
    }
    return sum;
}

/// The file as it is: neither moved nor scaled.
ModelFile read_plain(const std::string& path) {
    ModelReadSettings settings;
    settings.fit = false;
    return read_model(path, settings);
}

/// Expects that a file of these bytes is refused, in a sentence that holds `part`.
void expect_refused(const std::string& name, const std::string& bytes, const std::string& part) {
    SCOPED_TRACE(part);
    const TemporaryFolder folder;
    put(folder / name, bytes);
    expect_error(ErrorCode::InvalidInput, part, [&] { read_model(folder / name); });
}

/// `text` with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

// 4 faces and 4 corners; the 3DS file keeps its edges, so each face has corners of its own, and the
// scene of glTF shows it twice, once twice as large: 1/6 + 8/6.
TEST(ModelReader, ReadsATetrahedronInEveryFormat) {
    const TemporaryFolder folder;
    for (const test::TestFile& file : test::model_test_files()) {
        SCOPED_TRACE(file.name);
        const std::string name = file.name;
        put(folder / name, file.bytes);
        EXPECT_TRUE(is_model_file(name));
        const ModelFile read = read_plain(folder / name);
        const bool is_gltf = name.find(".gl") != std::string::npos;
        const ModelStatistics s = statistics(read.model);
        EXPECT_EQ(s.meshes, 1u);
        EXPECT_EQ(s.instances, is_gltf ? 2u : 1u);
        EXPECT_EQ(s.unique_triangles, 4u);
        EXPECT_EQ(s.unique_vertices, name == "a.3ds" ? 12u : 4u);
        EXPECT_EQ(s.instanced_triangles, is_gltf ? 8u : 4u);
        EXPECT_NEAR(volume(read.model), is_gltf ? 1.5 : 1 / 6.0, 1e-6);
        EXPECT_EQ(read.dropped_triangles, 0u);
        EXPECT_EQ(read.model.name, name);
        EXPECT_EQ(read.model.meshes[0].normals.size(), read.model.meshes[0].positions.size());
        EXPECT_NEAR(bounds(read.model).high.x, is_gltf ? 12 : 1, 1e-6);
    }
}

TEST(ModelReader, FitsAndNamesWhatItDid) {
    const TemporaryFolder folder;
    put(folder / "a.obj", test::obj_file());
    const ModelFile read = read_model(folder / "a.obj");
    // The middle of the unit cube; the farthest corner lies sqrt(3) / 2 from it.
    EXPECT_NEAR(bounds(read.model).high.x, 1 / std::sqrt(3.0), 1e-12);
    ASSERT_EQ(read.remarks.size(), 1u);
    EXPECT_EQ(read.remarks[0], "line 2: material file 'none.mtl' is missing");
    EXPECT_EQ(read.model.meshes[0].name, "tetra");
}

TEST(ModelReader, NormalsAreAsAsked) {
    const TemporaryFolder folder;
    put(folder / "a.obj", test::obj_file());
    ModelReadSettings settings;
    settings.normals = NormalStyle::Facet;
    EXPECT_TRUE(read_model(folder / "a.obj", settings).model.meshes[0].normals.empty());
    settings.normals = NormalStyle::Smooth;
    settings.crease_deg = 60;
    EXPECT_EQ(read_model(folder / "a.obj", settings).model.meshes[0].positions.size(), 12u);
    settings.crease_deg = 400;
    expect_error(ErrorCode::Usage, "crease", [&] { read_model(folder / "a.obj", settings); });
}

TEST(ModelReader, EndingsInAnyCaseAreKnown) {
    EXPECT_TRUE(is_model_file("a/b.OBJ"));
    EXPECT_TRUE(is_model_file("x.GlTf"));
    EXPECT_FALSE(is_model_file("obj"));
    EXPECT_FALSE(is_model_file("a.fbx"));
    EXPECT_FALSE(is_model_file(""));
    const TemporaryFolder folder;
    put(folder / "a.fbx", "Kaydara FBX Binary");
    expect_error(ErrorCode::Usage, "Stanford PLY (.ply)", [&] { read_model(folder / "a.fbx"); });
    expect_error(ErrorCode::InputOutput, "missing.obj", [] { read_model("/missing.obj"); });
}

TEST(ModelReader, WhatIsWrittenIsReadBackToTheBit) {
    const TemporaryFolder folder;
    const TriangleMesh sphere = make_sphere(17, 9);
    for (const bool as_obj : {true, false}) {
        const std::string path = folder / (as_obj ? "s.obj" : "s.ply");
        as_obj ? write_obj(sphere, path) : write_ply(sphere, path);
        const TriangleMesh mesh = read_plain(path).model.meshes.at(0);
        ASSERT_EQ(mesh.triangles.size(), sphere.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(mesh.positions[mesh.triangles[t][k]],
                          sphere.positions[sphere.triangles[t][k]]);
                EXPECT_EQ(mesh.normals[mesh.triangles[t][k]],
                          sphere.normals[sphere.triangles[t][k]]);
            }
        }
        // OBJ leaves out two vertices that no face uses: the last of both poles' rows.
        EXPECT_EQ(mesh.positions.size(), sphere.positions.size() - (as_obj ? 2 : 0));
    }
}

TEST(ModelReader, DropsWhatCannotBeDrawn) {
    const TemporaryFolder folder;
    put(folder / "a.obj", test::obj_file() + "v nan 0 0\nv 1e99 0 0\nf 1 2 5\nf 1 2 6\nf 1 1 2\n");
    EXPECT_EQ(read_model(folder / "a.obj").dropped_triangles, 3u);
    EXPECT_EQ(statistics(read_model(folder / "a.obj").model).unique_triangles, 4u);
    put(folder / "b.3ds", with(test::threeds_file(), test::raw(1.0f), test::raw(std::nanf(""))));
    EXPECT_EQ(read_model(folder / "b.3ds").dropped_triangles, 3u);
    put(folder / "c.glb", with(test::glb_file(), test::raw(1.0f), test::raw(std::nanf(""))));
    EXPECT_EQ(read_model(folder / "c.glb").dropped_triangles, 3u);
    // A node without a volume.
    put(folder / "d.gltf", with(test::gltf_file(), "[2,2,2]", "[2,2,0]"));
    EXPECT_EQ(read_model(folder / "d.gltf").dropped_triangles, 4u);
    expect_refused("e.obj", "v 0 0 0\nv 1 1 1\nf 1 2 2\n", "no triangle");
}

TEST(ModelReader, ObjFacesMayComeFirstAndLinesGoOn) {
    const TemporaryFolder folder;
    put(folder / "a.obj",
        "f 1 2 \\\r\n  3\r\nv 0 0 0\r\nv 1 0 0 1\r\nv +0 1 0 0.5 0.5 0.5\r\n"
        "o two\nf 1//1 2//1 3//2\nvn 0 0 1\nvn 0 1 0\nfancy 1 2\n");
    const ModelFile read = read_plain(folder / "a.obj");
    ASSERT_EQ(read.model.meshes.size(), 2u);
    EXPECT_EQ(read.model.meshes[1].name, "two");
    EXPECT_EQ(read.model.meshes[1].normals[2], (Vec3f{0, 1, 0}));
    ASSERT_EQ(read.remarks.size(), 1u);
    EXPECT_NE(read.remarks[0].find("line 10: statement 'fancy'"), std::string::npos);
}

TEST(ModelReader, ObjErrorsNameTheLine) {
    const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    expect_refused("a.obj", "", "no triangle");
    expect_refused("a.obj", good, "no triangle");
    expect_refused("a.obj", good + "f 1 2 4\n",
                   "a.obj:4: a face refers to vertex 4, the file has 3");
    expect_refused("a.obj", good + "f 1 2 -4\n", "a.obj:4: index -4 of 3");
    expect_refused("a.obj", good + "f 1 2 0\n", "a.obj:4: index 0");
    expect_refused("a.obj", good + "f 1 2\n", "a.obj:4: a face of 2 corners");
    expect_refused("a.obj", good + "\nf 1 2 x\n", "a.obj:5: 'x' is not an index");
    expect_refused("a.obj", good + "f 1/1/1/1 2 3\n", "is not a corner");
    expect_refused("a.obj", good + "f 1//9 2//9 3//9\n", "a face refers to normal 9");
    expect_refused("a.obj", good + "f 1/9 2/9 3/9\n", "a face refers to texture coordinate 9");
    expect_refused("a.obj", good + "f 1 2 99999999999999999999\n", "is not an index");
    expect_refused("a.obj", good + "f 1 2 5000000000\n", "is too large");
    expect_refused("a.obj", "v 0 0\n", "a.obj:1: a vertex needs three numbers");
    expect_refused("a.obj", "v 0 zero 0\n", "a.obj:1: 'zero' is not a number");
    expect_refused("a.obj", "\x7f\x45LF\x02\x01\n", "is not a statement of OBJ");
    expect_refused("a.obj", "v 1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 2 3\n", "limits");
}

TEST(ModelReader, PlyErrorsNameThePlace) {
    const std::string text = test::ply_text_file();
    const std::string binary = test::ply_binary_file(std::endian::little);
    expect_refused("a.ply", "", "a.ply:1: the file ends inside the header");
    expect_refused("a.ply", "plx\n", "it does not start with 'ply'");
    expect_refused("a.ply", with(text, "ascii", "morse"), "a.ply:2: 'morse' is not a format");
    expect_refused("a.ply", with(text, "vertex 4", "vertex 4000000000"), "do not fit");
    expect_refused("a.ply", with(text, "vertex 4", "vertex -4"), "not a number of elements");
    expect_refused("a.ply", with(text, "face 4", "face 9999"), "do not fit");
    expect_refused("a.ply", with(binary, "face 4", "face 9"), "a list of 7 values in 3 bytes");
    expect_refused("a.ply", with(text, "float x", "real x"), "'real' is not a type");
    expect_refused("a.ply", with(text, "float x", "float q"), "no x, y and z");
    expect_refused("a.ply", with(text, "vertex_indices", "corners"), "no list 'vertex_indices'");
    expect_refused("a.ply", with(text, "\n3 0 2 1", "\n3 0 2 4"),
                   "a.ply:19: a face refers to vertex 4, the file has 4");
    expect_refused("a.ply", with(text, "\n3 0 2 1", "\n3 0 2 1.5"), "refers to vertex 1.5");
    expect_refused("a.ply", with(text, "\n3 0 2 1", "\n2 0 2"), "a face of 2 corners");
    expect_refused("a.ply", with(text, "\n3 0 2 1", "\n3000 0 2 1"), "a list of 3000 values");
    expect_refused("a.ply", text.substr(0, text.size() - 4), "the file ends before");
    expect_refused("a.ply", binary.substr(0, binary.size() - 1),
                   "a.ply:" + std::to_string(binary.size() - 4) + ": the file ends before");
    expect_refused("a.ply",
                   with(text, "end_header", "element vertex 4\nproperty int x\nend_header"),
                   "a second element 'vertex'");
}

TEST(ModelReader, StlErrorsNameThePlace) {
    const std::string text = test::stl_text_file(), binary = test::stl_binary_file();
    expect_refused("a.stl", "", "a.stl:0: not an STL file");
    expect_refused("a.stl", "solid\nendsolid\n", "no triangle");
    expect_refused("a.stl", with(text, "outer", "inner"), "a.stl:3: 'inner' where outer should be");
    expect_refused("a.stl", with(text, "1.0e+0", "one"), "'one' where a number should be");
    expect_refused("a.stl", text.substr(0, text.find("endloop")),
                   "a.stl:7: the file ends where endloop should follow");
    expect_refused("a.stl", with(binary, "solid", "Solid").substr(0, binary.size() - 1),
                   "a.stl:80: 4 triangles are announced, the file holds 3");
    expect_refused("a.stl", std::string(84, '\0'), "no triangle");
}

TEST(ModelReader, GltfErrorsNameTheReason) {
    const std::string good = test::gltf_file();
    const auto refused = [&](const std::string& from, const std::string& to, const char* part) {
        expect_refused("a.gltf", with(good, from, to), part);
    };
    expect_refused("a.gltf", "", "a.gltf:1: not JSON");
    expect_refused("a.gltf", "[]", "is not an object");
    expect_refused("a.gltf", "{}", "asset.version");
    expect_refused("a.gltf", std::string(100000, '['), "not JSON");
    refused("\"2.0\"", "\"1.0\"", "only 2 is read");
    refused("\"scene\":0", "\"scene\":0,\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]",
            "KHR_draco_mesh_compression");
    refused("\"byteLength\":72", "\"byteLength\":73", "announces 73 bytes, it has 72");
    refused("\"byteLength\":48", "\"byteLength\":73", "does not lie in its buffer");
    refused("\"byteLength\":48", "\"byteLength\":47", "does not lie in its bufferView");
    refused("\"count\":4", "\"count\":4000000000", "does not lie in its bufferView");
    refused("\"count\":4", "\"count\":3", "refers to vertex 3, the primitive has 3");
    refused("\"count\":4", "\"count\":0", "is empty");
    refused("\"count\":4", "\"count\":-4", "not a whole number");
    refused("\"count\":4", "\"count\":1e400", "too large");
    refused("\"bufferView\":0", "\"bufferView\":7", "index 7 into bufferViews");
    refused("\"buffer\":0", "\"buffer\":2", "index 2 into buffers");
    refused("\"indices\":1", "\"indices\":0", "wrong type");
    refused("\"indices\":1", "\"indices\":9", "index 9 into accessors");
    refused("\"indices\":1", "\"mode\":9", "not a mode");
    refused("\"mesh\":0", "\"mesh\":5", "refers to mesh 5");
    refused("\"children\":[2]", "\"children\":[3]", "index 3 into nodes");
    refused("\"children\":[2]", "\"children\":[1]", "twice");
    refused("\"children\":[2]", "\"children\":[0]", "twice");
    refused("[10,0,0]", "[10,0]", "needs 3 numbers");
    refused("base64,", "base64,?", "not base64");
    refused(";base64", "", "not base64");
    for (const char* uri : {"../a.bin", "/etc/passwd", "b/../../a.bin", "%2e%2e/a.bin",
                            "http://a/b.bin", "", "a\\n.bin", "..\\\\a.bin"}) {
        expect_refused("a.gltf", test::gltf_json(R"(,"uri":")" + std::string(uri) + "\""),
                       "does not lie in the folder");
    }
    expect_refused("a.gltf", test::gltf_json(""), "has no uri");
    const std::string glb = test::glb_file();
    expect_refused("a.glb", glb.substr(0, glb.size() - 1), "bytes are announced");
    expect_refused("a.glb", with(glb, "glTF" + test::raw(2u), "glTF" + test::raw(1u)), "version 1");
    expect_refused("a.glb", with(glb, "JSON", "JSOX"), "no JSON chunk");
}

TEST(ModelReader, GltfBuffersMayLieInAFolderBelow) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "parts");
    put(folder / "parts/my data.bin", test::gltf_buffer());
    put(folder / "a.gltf", test::gltf_json(R"(,"uri":"parts/my%20data.bin")"));
    EXPECT_EQ(statistics(read_model(folder / "a.gltf").model).instanced_triangles, 8u);
    put(folder / "a.gltf", test::gltf_json(R"(,"uri":"parts/none.bin")"));
    expect_error(ErrorCode::InputOutput, "none.bin", [&] { read_model(folder / "a.gltf"); });
}

// A chain of nodes, each the only child of the one before.
TEST(ModelReader, GltfNodesAreNotFollowedForever) {
    const auto chain = [](int deep) {
        std::string nodes = "\"nodes\":[{\"mesh\":0}";
        for (int i = 1; i < deep; ++i) nodes += ",{\"children\":[" + std::to_string(i - 1) + "]}";
        const std::string json = test::gltf_file();
        const std::size_t begin = json.find("\"nodes\":[{\"mesh\"");
        return json.substr(0, begin) + nodes + "],\"scenes\":[{\"nodes\":[" +
               std::to_string(deep - 1) + "]}]}";
    };
    expect_refused("a.gltf", chain(257), "more than 256 deep");
    const TemporaryFolder folder;
    put(folder / "a.gltf", chain(256));
    EXPECT_EQ(statistics(read_model(folder / "a.gltf").model).instances, 1u);
}

TEST(ModelReader, ThreedsErrorsNameTheByte) {
    const std::string good = test::threeds_file();
    const std::size_t faces = good.find(test::raw(std::uint16_t{0x4120}));
    expect_refused("a.3ds", "", "a.3ds:0: not a 3DS file");
    expect_refused("a.3ds", "MM", "not a 3DS file");
    expect_refused("a.3ds", good.substr(0, good.size() - 1), "a.3ds:0: chunk 4d4d claims");
    expect_refused("a.3ds", test::chunk_3ds(0x4d4d, ""), "no triangle");
    std::string bad = good;
    bad[faces + 8] = 4;  // the first index
    expect_refused(
        "a.3ds", bad,
        ":" + std::to_string(faces + 8) + ": a face refers to vertex 4, the object has 4");
    bad = good;
    bad[faces + 6] = 100;  // how many faces
    expect_refused("a.3ds", bad, "100 entries in");
}

TEST(ModelReader, KeepsItsLimits) {
    const TemporaryFolder folder;
    for (const test::TestFile& file : test::model_test_files()) {
        SCOPED_TRACE(file.name);
        put(folder / file.name, file.bytes);
        ModelReadSettings settings;
        settings.limits.triangles = 3;
        expect_error(ErrorCode::InvalidInput, "more than 3 triangles",
                     [&] { read_model(folder / file.name, settings); });
        settings.limits = {};
        settings.limits.file_bytes = 50;
        expect_error(ErrorCode::InvalidInput, "more than the 50 allowed",
                     [&] { read_model(folder / file.name, settings); });
    }
    ModelReadSettings settings;
    settings.limits.instances = 1;
    expect_error(ErrorCode::InvalidInput, "more than 1 instances",
                 [&] { read_model(folder / "a.gltf", settings); });
}

}  // namespace
}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
// Reading a model that a test has made.
#pragma once

#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/test_files.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace asperity::io::test {

/// The tetrahedron of the test files, whatever the bytes around it: 4 faces, 1/6 of a cube in all.
inline void expect_tetrahedron(const ModelFile& file, std::size_t vertices = 4) {
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

inline ModelFile read_bytes(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    ModelReadSettings settings;
    settings.fit = false;
    return read_model(folder / name, settings);
}

inline bool has_remark(const ModelFile& file, const std::string& part) {
    return std::any_of(file.remarks.begin(), file.remarks.end(), [&](const std::string& remark) {
        return remark.find(part) != std::string::npos;
    });
}

}  // namespace asperity::io::test

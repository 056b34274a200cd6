// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <string>
#include <vector>

namespace asperity {

/// One model that needs no file.
struct BuiltinModel {
    std::string name;         ///< as --model takes it
    std::string description;  ///< one line for the help
};

/// sphere   radius 1, 512 x 256 quads, exact normals
/// plane    the square -1 .. 1 in x and z, facing +y, one quad
/// knot     a torus knot (2, 3), closed, smooth
/// ball     material preview: a ball with an inlaid ring and a foot, on a dish; three meshes
/// bowl     a shape with deep concavities: light is reflected to and fro in it
/// in this order. The names are part of the command line: keep them.
std::vector<BuiltinModel> builtin_models();

bool is_builtin_model(const std::string& name);

/// Closed but for the plane, within the unit sphere about the origin, all parts Role::Subject
/// unless they are something to stand on. Throws Error(Usage, "model") naming the models there are.
Model make_builtin_model(const std::string& name);

/// A sphere of radius 1: `slices` round the y axis, `stacks` from pole to pole, no doubled vertices
/// but the seam and the poles: (slices + 1) * (stacks + 1) vertices, 2 * slices * (stacks - 1)
/// triangles. Exact normals. slices >= 3, stacks >= 2. Throws Error(Usage, "slices" | "stacks").
TriangleMesh make_sphere(int slices, int stacks);

/// Adds a round Role::Stage floor just below the model, facing +y, `radius` wide.
void add_floor(Model& model, double radius = 20);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/gltf_transform.h>

#include <cmath>

namespace asperity::io::detail {
namespace {

/// p turned by the unit quaternion v + w.
Vec3 turned(Vec3 v, double w, Vec3 p) {
    const Vec3 t = 2 * cross(v, p);
    return p + w * t + cross(v, t);
}

}  // namespace

Transform combined(const Transform& outer, const Transform& inner) {
    return {outer.vector(inner.x), outer.vector(inner.y), outer.vector(inner.z),
            outer.point(inner.origin)};
}

Transform transform_of(const GltfDocument& document, const GltfDocument::Json& node) {
    const std::vector<double> m = document.numbers(node, "matrix", 16);
    const std::vector<double> t = document.numbers(node, "translation", 3);
    const std::vector<double> r = document.numbers(node, "rotation", 4);
    const std::vector<double> s = document.numbers(node, "scale", 3);
    if (!m.empty())
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    Transform transform;
    if (!s.empty()) transform = {{s[0], 0, 0}, {0, s[1], 0}, {0, 0, s[2]}, {}};
    if (!r.empty()) {
        const Vec3 v{r[0], r[1], r[2]};
        const double size = std::sqrt(dot(v, v) + r[3] * r[3]);
        if (!(size > 0)) document.fail("a rotation that is no quaternion");
        for (Vec3* const column : {&transform.x, &transform.y, &transform.z})
            *column = turned((1 / size) * v, r[3] / size, *column);
    }
    if (!t.empty()) transform.origin = {t[0], t[1], t[2]};
    return transform;
}

}  // namespace asperity::io::detail

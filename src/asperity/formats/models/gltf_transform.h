// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/models/gltf_document.h>

namespace asperity::io::detail {

/// First `inner`, then `outer`.
Transform combined(const Transform& outer, const Transform& inner);

/// Where a node of glTF stands in its parent: its matrix, column by column, or its scale, then
/// rotation (a quaternion x, y, z, w), then translation. Throws Error(InvalidInput).
Transform transform_of(const GltfDocument& document, const GltfDocument::Json& node);

}  // namespace asperity::io::detail

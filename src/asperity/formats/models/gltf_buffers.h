// SPDX-License-Identifier: Apache-2.0
// Where a glTF scene keeps its bytes: in a .glb, in data: URIs, in files beside it.
#pragma once

#include <asperity/formats/models/model_formats.h>

#include <optional>
#include <string>
#include <string_view>

namespace asperity::io::detail {

/// A .gltf, or a .glb taken apart.
struct GltfContainer {
    std::string json;
    std::uint64_t json_start = 0;       ///< in the file
    std::optional<std::string> binary;  ///< of a .glb
};

/// Throws Error(InvalidInput, "path:byte").
GltfContainer open_gltf(const ModelSource& source);

/// The bytes of a buffer's "uri": base64 or a file in the model's folder or below it. Throws
/// Error(InvalidInput, path) for another place, Error(InputOutput) when it cannot be read.
std::string read_gltf_uri(std::string_view uri, const ModelSource& source);

}  // namespace asperity::io::detail

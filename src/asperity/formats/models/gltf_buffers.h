// SPDX-License-Identifier: Apache-2.0
// Where a glTF scene keeps its bytes: in a .glb, in data: URIs, in files beside it.
#pragma once

#include <asperity/formats/models/model_formats.h>

#include <cstdint>
#include <map>
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

/// The buffers of a scene, by their "uri": base64, or a file in the model's folder or below it. A
/// file that several buffers name is read once.
class GltfFiles {
  public:
    explicit GltfFiles(const ModelSource& source) : source_(source) {}

    /// Throws Error(InvalidInput, path) for another place, or when all files together are larger
    /// than allowed; Error(InputOutput) when one cannot be read. The bytes live as long as this.
    std::string_view read(std::string_view uri);

    std::uint64_t bytes_read() const { return bytes_read_; }

  private:
    std::string_view keep(const std::string& name, std::string bytes);

    const ModelSource& source_;
    std::map<std::string, std::string> files_;
    std::uint64_t bytes_read_ = 0;
};

}  // namespace asperity::io::detail

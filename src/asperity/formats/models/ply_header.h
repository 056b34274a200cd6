// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file: which elements follow, and what each consists of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io::detail {

enum class PlyEncoding { Text, LittleEndian, BigEndian };

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;  ///< of the value, or of each value of a list
    bool is_list = false;
    PlyType count_type = PlyType::Uint8;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Bytes that each takes at least.
    std::uint64_t least_bytes(PlyEncoding encoding) const;
    /// Its place among the properties, or -1.
    int find(std::string_view property) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Text;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;    ///< that it takes in the file
    std::uint64_t lines = 0;  ///< as well
    char end_of_line = '\n';
};

/// Throws Error(InvalidInput, "path:line"), also when the elements claim more than the file can
/// hold.
PlyHeader read_ply_header(std::string_view file, const std::string& path);

}  // namespace asperity::io::detail

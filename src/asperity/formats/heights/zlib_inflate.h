// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// What a zlib stream holds, exactly `size` bytes. Nothing is allocated for a claim that deflate
/// cannot keep (1032 to one). Throws Error(InvalidInput, path).
std::vector<std::byte> inflated(std::span<const std::byte> zipped, std::uint64_t size,
                                const std::string& path);

}  // namespace asperity::io

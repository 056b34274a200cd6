// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace asperity {

/// Memory that this process may still take, and who says so: "on this machine", "under the limit of
/// its control group".
struct MemoryRoom {
    std::uint64_t bytes = 0;
    const char* whose = "";
};

/// The least of what the machine has free (swap included) and of what the control groups of this
/// process, version 1 or 2, and those above them leave; what the system would give back when asked
/// counts as free. None where the system does not tell (Linux does). `root` is where /proc and /sys
/// are looked for.
std::optional<MemoryRoom> memory_room(const std::string& root = "");

/// Throws Error(OutOfMemory, what) with both figures when `bytes` are more than there is room for:
/// better than being killed half way. `bytes` should be what is needed at least.
void require_memory(std::uint64_t bytes, const std::string& what);
void require_memory(std::uint64_t bytes, const std::string& what, std::optional<MemoryRoom> room);

/// "13.8 GB", "650 MB": in powers of 1000.
std::string bytes_text(std::uint64_t bytes);

}  // namespace asperity

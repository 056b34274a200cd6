// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/memory.h>

#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

namespace asperity {

namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The number at the start of a file; none if there is none ("max").
std::optional<std::uint64_t> number_in(const std::string& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return number;
    return std::nullopt;
}

/// The number behind a key at the start of a line.
std::optional<std::uint64_t> number_behind(const std::string& path, std::string_view key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        std::uint64_t number = 0;
        if (words >> word && word == key && words >> number) return number;
    }
    return std::nullopt;
}

/// The names of what versions 1 and 2 say alike.
struct GroupFiles {
    const char *folder, *limit, *used, *given_back;
};
constexpr GroupFiles kVersion1 = {"/sys/fs/cgroup/memory", "/memory.limit_in_bytes",
                                  "/memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"/sys/fs/cgroup", "/memory.max", "/memory.current",
                                  "inactive_file"};

/// What one group leaves.
std::uint64_t room_of_group(const std::string& folder, const GroupFiles& files) {
    const auto limit = number_in(folder + files.limit), used = number_in(folder + files.used);
    if (!limit || !used) return kNoLimit;
    // Pages of files that nobody has used lately make place
    const std::uint64_t idle = number_behind(folder + "/memory.stat", files.given_back).value_or(0);
    const std::uint64_t held = *used > idle ? *used - idle : 0;
    return *limit > held ? *limit - held : 0;
}

/// What a group and those above it leave; a container may see its own group as the topmost one.
std::uint64_t room_of_groups(const std::string& root, std::string group, const GroupFiles& files) {
    std::uint64_t room = room_of_group(root + files.folder, files);
    for (; group.size() > 1; group.resize(group.rfind('/')))
        room = std::min(room, room_of_group(root + files.folder + group, files));
    return room;
}

std::uint64_t room_under_limits(const std::string& root) {
    // "4:memory:/a/b" of version 1, "0::/a/b" of version 2
    std::ifstream groups(root + "/proc/self/cgroup");
    std::uint64_t room = kNoLimit;
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos || line.compare(second + 1, 1, "/") != 0) continue;
        const std::string kind = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        if (kind == "memory") room = std::min(room, room_of_groups(root, group, kVersion1));
        if (kind.empty()) room = std::min(room, room_of_groups(root, group, kVersion2));
    }
    return room;
}

}  // namespace

std::optional<MemoryRoom> memory_room(const std::string& root) {
    const std::string machine = root + "/proc/meminfo";
    const auto available = number_behind(machine, "MemAvailable:");
    const std::uint64_t limit = room_under_limits(root);
    if (!available && limit == kNoLimit) return std::nullopt;
    const std::uint64_t free =
        available ? 1024 * (*available + number_behind(machine, "SwapFree:").value_or(0))
                  : kNoLimit;
    if (limit < free) return MemoryRoom{limit, "under the limit of its control group"};
    return MemoryRoom{free, "on this machine"};
}

std::string bytes_text(std::uint64_t bytes) {
    const auto count = static_cast<double>(bytes);
    if (count >= 1e9) return fmt::format("{:.1f} GB", count / 1e9);
    if (count >= 1e6) return fmt::format("{:.0f} MB", count / 1e6);
    return fmt::format("{:.0f} kB", count / 1e3);
}

void require_memory(std::uint64_t bytes, const std::string& what, std::optional<MemoryRoom> room) {
    if (room && bytes > room->bytes)
        throw Error(ErrorCode::OutOfMemory,
                    fmt::format("needs at least {} of memory, {} are free {}", bytes_text(bytes),
                                bytes_text(room->bytes), room->whose),
                    what);
}

void require_memory(std::uint64_t bytes, const std::string& what) {
    // Little is never asked about
    constexpr std::uint64_t kLittle = 64'000'000;
    if (bytes > kLittle) require_memory(bytes, what, memory_room());
}

}  // namespace asperity

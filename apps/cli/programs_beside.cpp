// SPDX-License-Identifier: Apache-2.0
#include "programs_beside.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace asperity::cli {
namespace {

bool is_word(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Where programs are looked for: the folder of this one first.
std::vector<std::filesystem::path> folders() {
    std::vector<std::filesystem::path> found;
    std::error_code unknown;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (!unknown) found.push_back(self.parent_path());
    if (const char* path = std::getenv("PATH")) {
        std::istringstream list(path);
        for (std::string folder; std::getline(list, folder, ':');)
            if (!folder.empty()) found.emplace_back(folder);
    }
    return found;
}

}  // namespace

void become_program_beside(int argc, char** argv) {
    if (argc < 2 || !is_word(argv[1])) return;
    const std::string name = std::string("asperity-") + argv[1];
    for (const std::filesystem::path& folder : folders()) {
        const std::string program = (folder / name).string();
        if (::access(program.c_str(), X_OK) != 0) continue;
        std::vector<char*> arguments(argv + 1, argv + argc);
        arguments.push_back(nullptr);
        ::execv(program.c_str(), arguments.data());
    }
}

}  // namespace asperity::cli

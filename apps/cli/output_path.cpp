// SPDX-License-Identifier: Apache-2.0
#include "output_path.h"

#include <asperity/core/error.h>

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace asperity::cli {

namespace fs = std::filesystem;

namespace {

void check_parent_folder(const std::string& path) {
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        throw Error(ErrorCode::InputOutput, "there is no folder " + folder, path);
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw Error(ErrorCode::InputOutput,
                    "cannot write into folder " + folder + ": " + std::strerror(errno), path);
    }
}

}  // namespace

void check_output_file(const std::string& path) {
    if (path.empty()) throw Error(ErrorCode::Usage, "the name of the output file is empty");
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status) || path.back() == '/') {
        throw Error(ErrorCode::InputOutput, "is a folder, a file name is needed", path);
    }
    // Results are renamed into place: over a device or a pipe that would replace it.
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw Error(ErrorCode::InputOutput, "is not a regular file", path);
    }
    check_parent_folder(path);
}

void check_output_folder(const std::string& path) {
    std::error_code ignored;
    std::string name = path;
    while (name.size() > 1 && name.back() == '/') name.pop_back();
    if (!fs::exists(name, ignored)) {
        check_parent_folder(name);
    } else if (!fs::is_directory(name, ignored)) {
        throw Error(ErrorCode::InputOutput, "is not a folder", path);
    } else if (access(name.c_str(), W_OK | X_OK) != 0) {
        throw Error(ErrorCode::InputOutput, std::string("cannot write: ") + std::strerror(errno),
                    path);
    }
}

std::string ending(const std::string& path) {
    std::string text = fs::path(path).extension().string();
    if (!text.empty()) text.erase(0, 1);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace asperity::cli

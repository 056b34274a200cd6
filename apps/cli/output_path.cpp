// SPDX-License-Identifier: Apache-2.0
#include "output_path.h"

#include "console.h"

#include <asperity/core/error.h>

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace asperity::cli {

namespace fs = std::filesystem;

namespace {

/// Tries what will be done in the end: to make a file there.
void check_writable(const std::string& folder, const std::string& path) {
    std::string name = folder + "/.asperity-XXXXXX";
    const int file = mkstemp(name.data());
    if (file < 0) {
        throw Error(ErrorCode::InputOutput,
                    "cannot write into folder " + folder + ": " + std::strerror(errno), path);
    }
    close(file);
    unlink(name.c_str());
}

void check_parent_folder(const std::string& path) {
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        throw Error(ErrorCode::InputOutput, "there is no folder " + folder, path);
    }
    check_writable(folder, path);
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
    } else {
        check_writable(name, path);
    }
}

StandardOutputFile::StandardOutputFile(const std::string& ending) {
    if (isatty(STDOUT_FILENO) == 1)
        throw Error(ErrorCode::Usage, "a terminal shows no such file; write it into a pipe",
                    "standard output");
    std::error_code failure;
    folder_ = (fs::temp_directory_path(failure) / "asperity-XXXXXX").string();
    if (failure || mkdtemp(folder_.data()) == nullptr)
        throw Error(ErrorCode::InputOutput, "no place for a temporary file", folder_);
    path_ = folder_ + "/output." + ending;
}

StandardOutputFile::~StandardOutputFile() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void StandardOutputFile::send() const {
    std::ifstream file(path_, std::ios::binary);
    std::string bytes(std::size_t{1} << 16, '\0');
    while (file) {
        file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (file.gcount() > 0) write_bytes({bytes.data(), static_cast<std::size_t>(file.gcount())});
    }
    if (!file.eof()) throw Error(ErrorCode::InputOutput, "cannot be read", path_);
}

std::string ending(const std::string& path) {
    std::string text = fs::path(path).extension().string();
    if (!text.empty()) text.erase(0, 1);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace asperity::cli

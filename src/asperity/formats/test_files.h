// SPDX-License-Identifier: Apache-2.0
// Helpers shared by the tests of this folder.
#pragma once

#include <asperity/core/error.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

namespace asperity::io::test {

/// A folder that lives as long as the object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "asperity-io-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
    std::string path() const { return folder_.string(); }
    /// How many files it holds, hidden ones included.
    long files() const {
        return std::distance(std::filesystem::directory_iterator(folder_),
                             std::filesystem::directory_iterator());
    }

  private:
    std::filesystem::path folder_;
};

inline void put(const std::string& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string get(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Calls check(place) with the byte at each of the first `places` of the file set to 00, FF,
/// 7F and 80 in turn, in place: writing the file anew each time would cost seconds.
template <typename Check>
void with_each_byte_damaged(const std::string& path, std::size_t places, Check&& check) {
    const std::string good = get(path);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto set = [&](std::size_t place, char byte) {
        file.seekp(static_cast<std::streamoff>(place));
        file.put(byte).flush();
    };
    for (std::size_t place = 0; place < std::min(places, good.size()); ++place) {
        for (const char byte : {'\x00', '\xff', '\x7f', '\x80'}) {
            set(place, byte);
            check(place);
        }
        set(place, good[place]);
    }
}

/// Calls check(length) with the file cut to every length below its own, the longest first.
template <typename Check>
void with_each_cut(const std::string& path, Check&& check) {
    for (std::uintmax_t length = std::filesystem::file_size(path); length-- > 0;) {
        std::filesystem::resize_file(path, length);
        check(length);
    }
}

/// Whether /dev/full is the device that refuses every write, as it is on a whole system.
inline bool has_full_device() {
    return std::filesystem::is_character_file("/dev/full");
}

/// The Error that `call` throws; nothing when it throws none. Other exceptions pass through.
template <typename Call>
std::optional<Error> error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

/// Expects that `call` throws Error(code) whose text contains `part`.
template <typename Call>
void expect_error(ErrorCode code, const std::string& part, Call&& call) {
    const auto error = error_of(call);
    ASSERT_TRUE(error) << "no error; expected: " << part;
    EXPECT_EQ(error->code(), code) << error->what();
    EXPECT_NE(std::string(error->what()).find(part), std::string::npos)
        << "'" << error->what() << "' lacks '" << part << "'";
    EXPECT_EQ(std::string(error->what()).find('\n'), std::string::npos) << error->what();
}

/// While it lives, files of this process can grow to `bytes` and no further, like a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::uintmax_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{static_cast<rlim_t>(bytes), before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

}  // namespace asperity::io::test

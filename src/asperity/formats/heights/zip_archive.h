// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct zip;

namespace asperity::io {

/// A ZIP archive in memory. Throws Error(InvalidInput, path) for whatever is wrong with it; sizes
/// that the packed bytes cannot hold are refused before anything is allocated.
class ZipArchive {
  public:
    /// `bytes` must outlive the object.
    ZipArchive(std::span<const std::byte> bytes, std::string path);

    const std::vector<std::string>& names() const { return names_; }
    bool has(const std::string& name) const;
    std::vector<std::byte> read(const std::string& name) const;

  private:
    struct Close {
        void operator()(zip* archive) const;
    };
    [[noreturn]] void refuse(const std::string& why) const;

    std::string path_;
    std::size_t packed_bytes_;
    std::unique_ptr<zip, Close> archive_;
    std::vector<std::string> names_;
};

/// Whether a file that begins like this is a ZIP archive.
bool is_zip(std::string_view head);

}  // namespace asperity::io

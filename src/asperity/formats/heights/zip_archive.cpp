// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/zip_archive.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <utility>

namespace asperity::io {
namespace {

constexpr std::uint64_t kMaxDeflate = 1032;
constexpr zip_int64_t kMaxEntries = 100000;

}  // namespace

void ZipArchive::Close::operator()(zip* archive) const {
    zip_discard(archive);
}

void ZipArchive::refuse(const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, why, path_);
}

ZipArchive::ZipArchive(std::span<const std::byte> bytes, std::string path)
    : path_(std::move(path)), packed_bytes_(bytes.size()) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive_) {
        const std::string why = zip_error_strerror(&error);
        zip_error_fini(&error);
        if (source != nullptr) zip_source_free(source);
        refuse("ZIP: " + why);
    }
    zip_error_fini(&error);
    const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
    if (count > kMaxEntries) refuse(fmt::format("a ZIP archive of {} files", count));
    for (zip_int64_t k = 0; k < count; ++k) {
        const char* name = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(k), 0);
        if (name != nullptr) names_.emplace_back(name);
    }
}

bool ZipArchive::has(const std::string& name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::vector<std::byte> ZipArchive::read(const std::string& name) const {
    zip_stat_t about;
    zip_stat_init(&about);
    if (zip_stat(archive_.get(), name.c_str(), 0, &about) != 0 ||
        (about.valid & ZIP_STAT_SIZE) == 0)
        refuse(in_quotes(name) + " is missing in the archive");
    if (about.size / kMaxDeflate > packed_bytes_)
        refuse(fmt::format("{} cannot be {} bytes in an archive of {}", in_quotes(name), about.size,
                           packed_bytes_));
    std::vector<std::byte> bytes(static_cast<std::size_t>(about.size));
    zip_file_t* file = zip_fopen(archive_.get(), name.c_str(), 0);
    if (file == nullptr)
        refuse(fmt::format("{}: {}", in_quotes(name), zip_strerror(archive_.get())));
    const zip_int64_t got = zip_fread(file, bytes.data(), bytes.size());
    // The checksum is only looked at where the end is reached.
    char after = 0;
    const zip_int64_t more =
        got == static_cast<zip_int64_t>(bytes.size()) ? zip_fread(file, &after, 1) : 0;
    const std::string why = zip_file_strerror(file);
    zip_fclose(file);
    if (got != static_cast<zip_int64_t>(bytes.size()) || more != 0)
        refuse(fmt::format("{} cannot be unpacked: {}", in_quotes(name), why));
    return bytes;
}

bool is_zip(std::string_view head) {
    return head.starts_with("PK\x03\x04");
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/zlib_inflate.h>

#include <asperity/core/error.h>
#include <fmt/format.h>
#include <zlib.h>

namespace asperity::io {

std::vector<std::byte> inflated(std::span<const std::byte> zipped, std::uint64_t size,
                                const std::string& path) {
    constexpr std::uint64_t kMaxDeflate = 1032;
    if (size / kMaxDeflate > zipped.size())
        throw Error(
            ErrorCode::InvalidInput,
            fmt::format("{} bytes cannot hold the {} that are announced", zipped.size(), size),
            path);
    std::vector<std::byte> out(static_cast<std::size_t>(size));
    uLongf length = out.size();
    const int status = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &length,
                                    reinterpret_cast<const Bytef*>(zipped.data()), zipped.size());
    if (status != Z_OK || length != out.size())
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("a compressed block does not unpack to {} bytes", size), path);
    return out;
}

}  // namespace asperity::io

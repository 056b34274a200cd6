// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/images/image_formats.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace asperity::io {

Image read_image(const std::string& path) {
    const InputFile file(path);
    std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), 4)), '\0');
    file.read(0, std::as_writable_bytes(std::span(start)));
    if (start == "\x76\x2f\x31\x01") return read_exr_image(path);
    if (start.starts_with("#?")) return read_hdr_image(path);
    throw Error(ErrorCode::InvalidInput, "neither an OpenEXR nor a Radiance HDR picture", path);
}

void check_image_size(std::uint64_t width, std::uint64_t height, const std::string& path) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::InvalidInput, fmt::format("{} x {} pixels, {}", width, height, why),
                    path);
    };
    if (std::min(width, height) < 1 || std::max(width, height) > kMaxImageSide)
        refuse(fmt::format("1 to {} on a side are allowed", kMaxImageSide));
    if (width * height > kMaxImagePixels)
        refuse(fmt::format("{} in all are allowed", kMaxImagePixels));
}

}  // namespace asperity::io

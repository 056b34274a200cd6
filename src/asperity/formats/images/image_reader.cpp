// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/images/image_formats.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace asperity::io {

std::span<const ImageFormat> image_formats() {
    static const std::vector<ImageFormat> kFormats = {detail::exr_format(), detail::hdr_format()};
    return kFormats;
}

Image read_image(const std::string& path, const ImageReadSettings& settings) {
    const FileStart start = read_start(path);
    std::vector<ImageFormat> formats = settings.formats;
    formats.insert(formats.end(), image_formats().begin(), image_formats().end());
    std::string names;
    for (const ImageFormat& format : formats) {
        if (format.sniff(start)) return format.read(path);
        names += (names.empty() ? "" : ", ") + format.name;
    }
    throw Error(ErrorCode::InvalidInput, "it is none of: " + names, path);
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

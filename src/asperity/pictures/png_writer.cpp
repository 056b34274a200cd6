// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/png_writer.h>

#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <fmt/format.h>
#include <png.h>

#include <cstddef>
#include <span>
#include <vector>

namespace asperity::io {

void write_png(const Canvas& canvas, const std::string& path) {
    AtomicFile file(path);  // first: it tells of a folder that may not be written
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(canvas.width());
    image.height = static_cast<png_uint_32>(canvas.height());
    image.format = PNG_FORMAT_RGB;
    constexpr int kStandardDepth = 0;  // of the simplified interface: 8 bits as given
    constexpr int kPackedRows = 0;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(size);
    const int written = png_image_write_to_memory(&image, bytes.data(), &size, kStandardDepth,
                                                  canvas.bytes().data(), kPackedRows, nullptr);
    if (written == 0)
        throw Error(ErrorCode::InputOutput, fmt::format("cannot write the PNG ({})", image.message),
                    path);
    file.write(std::span(bytes).first(size));
    file.commit();
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/png_writer.h>

#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <fmt/format.h>
#include <png.h>

namespace asperity::io {

void write_png(const Canvas& canvas, const std::string& path) {
    AtomicFile file(path);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(canvas.width());
    image.height = static_cast<png_uint_32>(canvas.height());
    image.format = PNG_FORMAT_RGB;
    constexpr int kStandardDepth = 0;  // of the simplified interface: 8 bits as given
    constexpr int kPackedRows = 0;
    const int written =
        png_image_write_to_file(&image, file.temporary_path().c_str(), kStandardDepth,
                                canvas.bytes().data(), kPackedRows, nullptr);
    if (written == 0)
        throw Error(ErrorCode::InputOutput, fmt::format("cannot write the PNG ({})", image.message),
                    path);
    file.commit();
}

}  // namespace asperity::io

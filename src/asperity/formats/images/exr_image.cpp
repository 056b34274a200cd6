// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <asperity/formats/exr/exr_errors.h>
#include <asperity/formats/exr/exr_outline.h>
#include <asperity/formats/images/image_formats.h>
#include <asperity/formats/images/image_reader.h>
#include <fmt/format.h>

#include <array>

namespace asperity::io {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::InvalidInput, why, path);
}

/// The channels to read: R, G and B, or Y in the place of R.
std::vector<std::string> channels_of(const Imf::Header& header, const std::string& path) {
    const Imf::ChannelList& list = header.channels();
    std::vector<std::string> channels;
    if (list.findChannel("R") && list.findChannel("G") && list.findChannel("B"))
        channels = {"R", "G", "B"};
    else if (list.findChannel("Y"))
        channels = {"Y"};
    else
        refuse(path, "no channels R, G and B, nor Y");
    for (const std::string& name : channels) {
        const Imf::Channel& channel = list[name.c_str()];
        if (channel.type == Imf::UINT)
            refuse(path,
                   fmt::format("channel {} holds integers, a picture needs half or float", name));
        if (channel.xSampling != 1 || channel.ySampling != 1)
            refuse(path, fmt::format("channel {} is subsampled", name));
    }
    return channels;
}

Image read_pixels(const std::string& path) {
    Imf::InputFile file(path.c_str());
    if (!file.isComplete()) refuse(path, "the image is incomplete");
    const std::vector<std::string> channels = channels_of(file.header(), path);

    const auto box = file.header().dataWindow();
    Image image{box.max.x - box.min.x + 1, box.max.y - box.min.y + 1, {}};
    constexpr std::size_t kPixel = 3 * sizeof(float);
    const auto width = static_cast<std::size_t>(image.width);
    image.rgb.resize(3 * width * static_cast<std::size_t>(image.height));

    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c)
        frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, image.rgb.data() + c, box, kPixel,
                                                   kPixel * width));
    file.setFrameBuffer(frame);
    file.readPixels(box.min.y, box.max.y);
    if (channels.size() == 1)
        for (std::size_t k = 0; k < image.rgb.size(); k += 3)
            image.rgb[k + 1] = image.rgb[k + 2] = image.rgb[k];
    return image;
}

}  // namespace

Image read_exr_image(const std::string& path) {
    check_exr_outline(InputFile(path), ExrContent::Picture, check_image_size);
    Image image;
    translating_exr(path, ErrorCode::InvalidInput, [&] { image = read_pixels(path); });
    return image;
}

}  // namespace asperity::io

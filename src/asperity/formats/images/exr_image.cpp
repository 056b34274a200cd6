// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/exr/exr_errors.h>
#include <asperity/formats/exr/exr_outline.h>
#include <asperity/formats/images/image_formats.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/images/primaries.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io::detail {
namespace {

// A picture may be mostly black around what the file has, up to a point.
constexpr std::uint64_t kFreePixels = 1 << 22, kMostBlack = 100;

constexpr std::size_t kSlice = 1 << 22;  // pixels that are read at a time

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::InvalidInput, why, path);
}

std::string in_small_letters(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// "" for "R", "beauty." for "beauty.R".
std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot + 1);
}

/// Layers that hold red, green and blue, whatever the letters: the names of the three.
std::map<std::string, std::vector<std::string>> layers_of_colours(const Imf::ChannelList& list) {
    std::map<std::string, std::vector<std::string>> layers;
    for (auto c = list.begin(); c != list.end(); ++c) layers[layer_of(c.name())].resize(3);
    for (auto& [layer, names] : layers) {
        for (auto c = list.begin(); c != list.end(); ++c) {
            const std::string name = c.name();
            if (layer_of(name) != layer) continue;
            const std::string colour = in_small_letters(name.substr(layer.size()));
            constexpr std::array<std::array<std::string_view, 2>, 3> kNames = {
                {{"r", "red"}, {"g", "green"}, {"b", "blue"}}};
            for (std::size_t k = 0; k < 3; ++k) {
                if (colour == kNames[k][0] || colour == kNames[k][1]) names[k] = name;
            }
        }
    }
    std::erase_if(layers, [](const auto& layer) {
        return std::any_of(layer.second.begin(), layer.second.end(),
                           [](const std::string& name) { return name.empty(); });
    });
    return layers;
}

/// The channels to read: red, green and blue of the picture itself or of its only layer, or Y.
std::vector<std::string> channels_of(const Imf::Header& header, const std::string& path) {
    const Imf::ChannelList& list = header.channels();
    auto layers = layers_of_colours(list);
    std::vector<std::string> channels;
    if (const auto own = layers.find(""); own != layers.end()) {
        channels = own->second;
    } else if (list.findChannel("Y")) {
        if (list.findChannel("RY") || list.findChannel("BY"))
            refuse(path, "its colours are luminance and chroma (Y, RY, BY), save it as RGB");
        channels = {"Y"};
    } else if (layers.size() == 1) {
        channels = layers.begin()->second;
    } else if (layers.empty()) {
        refuse(path, "no channels R, G and B, nor Y");
    } else {
        std::string names;
        for (const auto& [layer, three] : layers)
            names += fmt::format("{}{}", names.empty() ? "" : ", ",
                                 in_quotes(layer.substr(0, layer.size() - 1)));
        refuse(path, fmt::format("several layers ({}), save the one that is the picture", names));
    }
    for (const std::string& name : channels) {
        const Imf::Channel& channel = list[name.c_str()];
        if (channel.type == Imf::UINT)
            refuse(path, fmt::format("channel {} holds integers, a picture needs half or float",
                                     in_quotes(name)));
        if (channel.xSampling != 1 || channel.ySampling != 1)
            refuse(path, fmt::format("channel {} is subsampled", in_quotes(name)));
    }
    return channels;
}

/// Rec. 709 where the file says nothing else.
Primaries primaries_of(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return {};
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    const auto xy = [](const Imath::V2f& v) {
        return std::array<double, 2>{static_cast<double>(v.x), static_cast<double>(v.y)};
    };
    return {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

/// The window that a viewer shows: what is not in the file is black there, and what lies outside of
/// it is not shown.
Image empty_picture(const Imath::Box2i& shown, const Imath::Box2i& data, const std::string& path) {
    const auto side = [](int low, int high) {
        return static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
    };
    const std::uint64_t width = side(shown.min.x, shown.max.x);
    const std::uint64_t height = side(shown.min.y, shown.max.y);
    check_image_size(width, height, path);
    if (!shown.intersects(data)) refuse(path, "no pixel lies in its display window");
    const std::uint64_t there = side(data.min.x, data.max.x) * side(data.min.y, data.max.y);
    if (width * height > kFreePixels && width * height / kMostBlack > there)
        refuse(path, fmt::format("{} x {} pixels are shown, {} are there", width, height, there));
    return {static_cast<int>(width), static_cast<int>(height),
            std::vector<float>(static_cast<std::size_t>(3 * width * height))};
}

/// Copies lines of the data window, from `top` on, to where they are shown.
void show(const std::vector<float>& lines, int top, int bottom, const Imath::Box2i& data,
          const Imath::Box2i& shown, Image& image) {
    const int left = std::max(data.min.x, shown.min.x), right = std::min(data.max.x, shown.max.x);
    const auto data_width = static_cast<std::size_t>(data.max.x - data.min.x + 1);
    const auto count = static_cast<std::size_t>(3 * (right - left + 1));
    for (int y = std::max(top, shown.min.y); y <= std::min(bottom, shown.max.y); ++y) {
        const auto from = static_cast<std::size_t>(y - top) * data_width +
                          static_cast<std::size_t>(left - data.min.x);
        const auto to =
            static_cast<std::size_t>(y - shown.min.y) * static_cast<std::size_t>(image.width) +
            static_cast<std::size_t>(left - shown.min.x);
        std::copy_n(lines.begin() + static_cast<std::ptrdiff_t>(3 * from), count,
                    image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * to));
    }
}

Image read_pixels(const std::string& path) {
    Imf::InputFile file(path.c_str());
    if (!file.isComplete()) refuse(path, "the image is incomplete");
    const std::vector<std::string> channels = channels_of(file.header(), path);
    const Imath::Box2i data = file.header().dataWindow(), shown = file.header().displayWindow();

    // A slice first: memory for the picture is taken when its first lines were there.
    const auto width = static_cast<std::size_t>(data.max.x - data.min.x + 1);
    const int step = static_cast<int>(std::max<std::size_t>(kSlice / width, 1));
    std::vector<float> lines;
    Image image;
    for (int top = data.min.y; top <= data.max.y; top += step) {
        const int bottom = std::min(top + step - 1, data.max.y);
        const Imath::Box2i slice({data.min.x, top}, {data.max.x, bottom});
        lines.resize(3 * width * static_cast<std::size_t>(bottom - top + 1));
        constexpr std::size_t kPixel = 3 * sizeof(float);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < channels.size(); ++c)
            frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, lines.data() + c, slice, kPixel,
                                                       kPixel * width));
        file.setFrameBuffer(frame);
        file.readPixels(top, bottom);
        for (std::size_t k = 0; channels.size() == 1 && k < lines.size(); k += 3)
            lines[k + 1] = lines[k + 2] = lines[k];
        if (top == data.min.y) image = empty_picture(shown, data, path);
        show(lines, top, bottom, data, shown, image);
    }
    if (channels.size() == 3) convert_to_rec709(image, primaries_of(file.header()), path);
    return image;
}

bool is_exr(const FileStart& start) {
    return start.bytes.starts_with("\x76\x2f\x31\x01");
}

Image read_exr(const std::string& path) {
    check_exr_outline(InputFile(path), ExrContent::Picture, check_image_size);
    Image image;
    translating_exr(path, ErrorCode::InvalidInput, [&] { image = read_pixels(path); });
    return image;
}

}  // namespace

ImageFormat exr_format() {
    return {"OpenEXR", {".exr"}, is_exr, read_exr};
}

}  // namespace asperity::io::detail

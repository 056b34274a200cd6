// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/printable.h>
#include <asperity/formats/exr/exr_errors.h>
#include <asperity/formats/exr/exr_outline.h>
#include <asperity/formats/exr/exr_stream.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace asperity::io {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::InvalidInput, why, path);
}

/// The one channel, or R, G and B, which must be alike.
std::vector<std::string> usable_channels(const Imf::Header& header, const std::string& path) {
    std::string names;
    std::vector<std::string> all;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        const std::string name = it.name();
        all.push_back(name);
        names += (names.empty() ? "" : ", ") + name;
        if (it.channel().type == Imf::UINT)
            refuse(path, fmt::format("channel {} holds integers, heights need half or float",
                                     in_quotes(name)));
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            refuse(path, fmt::format("channel {} is subsampled", in_quotes(name)));
    }
    if (all.size() != 1 && all != std::vector<std::string>{"B", "G", "R"})
        refuse(path,
               fmt::format("{} channels ({}), heights need one", all.size(), printable(names)));
    return all;
}

Heightfield read_image(const HeightsSource& source) {
    const std::string& path = source.path();
    Imf::InputFile image(path.c_str());
    if (!image.isComplete()) refuse(path, "the image is incomplete");
    const std::vector<std::string> channels = usable_channels(image.header(), path);

    const auto box = image.header().dataWindow();
    const auto nx = static_cast<std::uint64_t>(box.max.x - box.min.x + 1);
    const auto ny = static_cast<std::uint64_t>(box.max.y - box.min.y + 1);
    Heightfield surface = empty_patch(nx, ny, path);

    const auto row_bytes = static_cast<std::size_t>(nx) * sizeof(float);
    std::vector<std::vector<float>> others(channels.size() - 1,
                                           std::vector<float>(surface.heights.size()));
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* const values = c == 0 ? surface.heights.data() : others[c - 1].data();
        frame.insert(channels[c],
                     Imf::Slice::Make(Imf::FLOAT, values, box, sizeof(float), row_bytes));
    }
    image.setFrameBuffer(frame);
    source.for_each_row(surface.ny, [&](int j) { image.readPixels(box.min.y + j); });
    for (const std::vector<float>& other : others)
        for (std::size_t k = 0; k < other.size(); ++k) {
            const float a = surface.heights[k], b = other[k];
            if (a != b && !(std::isnan(a) && std::isnan(b)))
                refuse(path,
                       fmt::format("the colours differ at sample {}, heights need one channel", k));
        }
    return surface;
}

}  // namespace

Heightfield read_exr_heights(const HeightsSource& source) {
    const std::string& path = source.path();
    const InputFile file(path);
    check_exr_outline(file, ExrContent::Heights, check_sides);
    Heightfield surface;
    translating_exr(path, ErrorCode::InvalidInput, [&] { surface = read_image(source); });
    return surface;
}

void write_exr_heights(const Heightfield& surface, const std::string& path) {
    write_exr(path, [&](Imf::OStream& stream) {
        Imf::Header header(surface.nx, surface.ny);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        Imf::OutputFile image(stream, header);
        Imf::FrameBuffer frame;
        const auto row_bytes = static_cast<std::size_t>(surface.nx) * sizeof(float);
        frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, surface.heights.data(), header.dataWindow(),
                                           sizeof(float), row_bytes));
        image.setFrameBuffer(frame);
        image.writePixels(surface.ny);
    });
}

}  // namespace asperity::io

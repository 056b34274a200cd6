// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <asperity/formats/exr/exr_stream.h>
#include <asperity/formats/images/render_writer.h>
#include <fmt/format.h>

#include <array>
#include <map>

namespace asperity::io {

namespace {

constexpr std::array<const char*, 4> kChannels = {"R", "G", "B", "stderr.Y"};

Imf::Header header_of(const Film& film, const Provenance& provenance) {
    Imf::Header header(film.width(), film.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // of Rec. 709
    for (const char* channel : kChannels) header.channels().insert(channel, Imf::FLOAT);
    for (const auto& [name, value] : labelled(provenance))
        header.insert(name, Imf::StringAttribute(value));
    return header;
}

/// All channels of a pixel side by side, in the order of kChannels.
std::vector<float> values_of(const Film& film) {
    std::vector<float> values;
    values.reserve(kChannels.size() * film.pixels().size());
    for (const Pixel& pixel : film.pixels())
        for (const double value :
             {pixel.mean.r, pixel.mean.g, pixel.mean.b, pixel.standard_error()})
            values.push_back(static_cast<float>(value));
    return values;
}

}  // namespace

Provenance labelled(const Provenance& provenance) {
    Provenance labels;
    std::map<std::string, int> seen;
    for (const auto& [name, value] : provenance) {
        const int count = ++seen[name];
        labels.emplace_back(count == 1 ? fmt::format("asperity:{}", name)
                                       : fmt::format("asperity:{}.{}", name, count),
                            value);
    }
    return labels;
}

void write_render_exr(const Film& film, const Provenance& provenance, const std::string& path) {
    write_exr(path, [&](Imf::OStream& stream) {
        std::vector<float> values = values_of(film);
        constexpr std::size_t kPixelBytes = kChannels.size() * sizeof(float);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < kChannels.size(); ++c)
            frame.insert(
                kChannels[c],
                Imf::Slice(Imf::FLOAT, static_cast<char*>(static_cast<void*>(values.data() + c)),
                           kPixelBytes, kPixelBytes * static_cast<std::size_t>(film.width())));
        Imf::OutputFile file(stream, header_of(film, provenance));
        file.setFrameBuffer(frame);
        file.writePixels(film.height());
    });
}

}  // namespace asperity::io

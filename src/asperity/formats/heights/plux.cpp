// SPDX-License-Identifier: Apache-2.0
// Sensofar's .plux: a ZIP archive of index.xml and raw layers of 32-bit floats [um].
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>
#include <asperity/formats/heights/zip_archive.h>

#include <pugixml.hpp>

namespace asperity::io {
namespace {

struct Index {
    std::uint64_t nx = 0, ny = 0;
    double dx = 0, dy = 0;           ///< [um]
    std::vector<std::string> files;  ///< of the layers
};

bool recognises(std::string_view head) {
    return is_zip(head) && (head.find("index.xml") != std::string_view::npos ||
                            head.find("LAYER_0") != std::string_view::npos);
}

Index read_index(const ZipArchive& archive, const HeightsSource& source) {
    const std::vector<std::byte> text = archive.read("index.xml");
    pugi::xml_document xml;
    const auto parsed = xml.load_buffer(text.data(), text.size());
    if (!parsed)
        source.refuse(fmt::format("index.xml at byte {}: {}", parsed.offset, parsed.description()));
    const pugi::xml_node root = xml.document_element(), general = root.child("GENERAL");
    const auto number = [&](const char* key) {
        const std::string word(trimmed(general.child(key).text().get()));
        const auto value = parse_double(word);
        if (!value || *value <= 0)
            source.refuse(fmt::format("{} {} is no positive number", key, in_quotes(word)));
        return *value;
    };
    Index index;
    const double nx = number("IMAGE_SIZE_X"), ny = number("IMAGE_SIZE_Y");
    if (nx > 4e9 || ny > 4e9) source.refuse(fmt::format("{} x {} is no size", nx, ny));
    index.nx = static_cast<std::uint64_t>(nx), index.ny = static_cast<std::uint64_t>(ny);
    index.dx = number("FOV_X"), index.dy = number("FOV_Y");
    for (const pugi::xml_node& node : root.children()) {
        if (!std::string_view(node.name()).starts_with("LAYER_")) continue;
        const std::string file(trimmed(node.child("FILENAME_Z").text().get()));
        if (!file.empty()) index.files.push_back(file);
    }
    return index;
}

Topography read(const HeightsSource& source, const std::string& file) {
    const ZipArchive archive(source.bytes(), source.path());
    const Index index = read_index(archive, source);
    const std::vector<std::byte> bytes = archive.read(file);
    const BinaryView view(bytes, source.path());
    check_sides(index.nx, index.ny, source.path());
    if (view.size() != index.nx * index.ny * sizeof(float))
        source.refuse(fmt::format("{} holds {} bytes, {} x {} samples need {}", in_quotes(file),
                                  view.size(), index.nx, index.ny,
                                  index.nx * index.ny * sizeof(float)));
    Topography t =
        read_grid(source, view, index.nx, index.ny, {NumberType::F32, false, 0, 0, 1e-6, 0},
                  [](double n) { return n == 1000001; });
    set_spacing(t, index.dx * 1e-6, index.dy * 1e-6, "um", source.path());
    t.note("first row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const ZipArchive archive(source.bytes(), source.path());
    const Index index = read_index(archive, source);
    std::vector<HeightsChannel> channels;
    for (const std::string& file : index.files)
        channels.push_back(
            {index.files.size() == 1 ? "heights" : file, index.nx, index.ny, {}, [source, file] {
                 return read(source, file);
             }});
    return channels;
}

}  // namespace

HeightsFormat plux_format() {
    return {"plux", {"plux"}, "Sensofar .plux: layers of heights in um", recognises, open, nullptr};
}

}  // namespace asperity::io

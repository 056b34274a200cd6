// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/bsdfs/window_xml.h>

#include <asperity/core/error.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace asperity::io {
namespace {

/// Text that may stand in an XML comment: no "--".
std::string comment_text(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    for (std::size_t at; (at = text.find("--")) != text.npos;) text.replace(at, 2, "- -");
    return "<!--\n" + text + "-->\n";
}

}  // namespace

std::string window_opening(const ExportSource& source) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<WindowElement xmlns=\"http://windows.lbl.gov\">\n" +
           comment_text(source.provenance()) +
           "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n"
           "<Optical>\n<Layer>\n<Material>\n<Name>Simulated surface</Name>\n"
           "<Manufacturer>Asperity</Manufacturer>\n<Thickness unit=\"Meter\">0</Thickness>\n"
           "<DeviceType>Other</DeviceType>\n</Material>\n";
}

std::string window_closing() {
    return "</Layer>\n</Optical>\n</WindowElement>\n";
}

pugi::xml_node read_window_layer(const std::string& path, pugi::xml_document& document) {
    const std::string text = read_text_file(path, 256u << 20);
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} at byte {}", parsed.description(), parsed.offset), path);
    return document.child("WindowElement").child("Optical").child("Layer");
}

const char* visible_reflection(pugi::xml_node layer, const std::string& path) {
    for (const pugi::xml_node data : layer.children("WavelengthData")) {
        const pugi::xml_node block = data.child("WavelengthDataBlock");
        if (std::string_view(data.child_value("Wavelength")) == "Visible" &&
            std::string_view(block.child_value("WavelengthDataDirection")) == "Reflection Back")
            return block.child_value("ScatteringData");
    }
    throw Error(ErrorCode::InvalidInput, "has no Visible data of Reflection Back", path);
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/bsdfs/window_xml.h>

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

}  // namespace asperity::io

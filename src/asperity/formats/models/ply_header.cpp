// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/ply_header.h>

#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_formats.h>
#include <asperity/formats/models/model_text.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::size_t kMostHeaderBytes = 1 << 20;
constexpr std::size_t kMostElements = 100, kMostProperties = 1000;

struct TypeName {
    std::string_view old_name, name;
    PlyType type;
};

constexpr std::array<TypeName, 8> kTypes = {{{"char", "int8", PlyType::Int8},
                                             {"uchar", "uint8", PlyType::Uint8},
                                             {"short", "int16", PlyType::Int16},
                                             {"ushort", "uint16", PlyType::Uint16},
                                             {"int", "int32", PlyType::Int32},
                                             {"uint", "uint32", PlyType::Uint32},
                                             {"float", "float32", PlyType::Float32},
                                             {"double", "float64", PlyType::Float64}}};

class HeaderReader {
  public:
    HeaderReader(std::string_view file, const std::string& path)
        : file_(file),
          path_(path),
          lines_(file.substr(0, kMostHeaderBytes), 1,
                 end_of_line(file.substr(0, kMostHeaderBytes))) {}

    PlyHeader read() {
        if (next_line() != "ply") fail("not a PLY file (it does not start with 'ply')");
        for (std::string_view line = next_line(); line != "end_header"; line = next_line())
            read_statement(line);
        if (!has_format_) fail("the header names no format");
        header_.bytes = std::min(file_.size(), kMostHeaderBytes) - lines_.left();
        header_.lines = lines_.line() - 1;
        header_.end_of_line = end_of_line(file_.substr(0, kMostHeaderBytes));
        check_sizes();
        return std::move(header_);
    }

  private:
    std::string_view next_line() {
        if (lines_.left() == 0) fail("the file ends inside the header");
        line_ = lines_.line();
        return trimmed(lines_.rest_of_line());
    }

    void read_statement(std::string_view line) {
        Words words(line);
        const std::string_view what = words.next();
        if (what == "format")
            read_format(words.next());
        else if (what == "element")
            read_element(words);
        else if (what == "property")
            read_property(words);
        else if (!what.empty() && what != "comment" && what != "obj_info")
            fail(fmt::format("{} is not a statement of a PLY header", in_quotes(what)));
    }

    void read_format(std::string_view name) {
        if (name == "ascii")
            header_.encoding = PlyEncoding::Text;
        else if (name == "binary_little_endian")
            header_.encoding = PlyEncoding::LittleEndian;
        else if (name == "binary_big_endian")
            header_.encoding = PlyEncoding::BigEndian;
        else
            fail(fmt::format("{} is not a format of PLY", in_quotes(name)));
        has_format_ = true;
    }

    void read_element(Words& words) {
        PlyElement element;
        element.name = std::string(words.next());
        const std::string_view count = words.next();
        const auto number = parse_integer<std::uint64_t>(count);
        if (!number) fail(fmt::format("{} is not a number of elements", in_quotes(count)));
        element.count = *number;
        if (header_.elements.size() >= kMostElements) fail("too many kinds of elements");
        header_.elements.push_back(std::move(element));
    }

    void read_property(Words& words) {
        if (header_.elements.empty()) fail("a property before the first element");
        PlyProperty property;
        std::string_view word = words.next();
        property.is_list = word == "list";
        if (property.is_list) {
            property.count_type = type(words.next());
            if (property.count_type >= PlyType::Float32) fail("a list needs a whole number first");
            word = words.next();
        }
        property.type = type(word);
        property.name = std::string(words.next());
        if (property.name.empty()) fail("a property without a name");
        auto& properties = header_.elements.back().properties;
        if (properties.size() >= kMostProperties) fail("too many properties");
        properties.push_back(std::move(property));
    }

    PlyType type(std::string_view name) const {
        for (const TypeName& t : kTypes) {
            if (name == t.name || name == t.old_name) return t.type;
        }
        fail(fmt::format("{} is not a type of PLY", in_quotes(name)));
    }

    void check_sizes() const {
        std::uint64_t left = file_.size() - header_.bytes;
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty() && element.count > 0)
                fail(fmt::format("element {} has no properties", in_quotes(element.name)));
            const std::uint64_t each =
                std::max<std::uint64_t>(element.least_bytes(header_.encoding), 1);
            if (element.count > left / each)
                fail(fmt::format("{} elements {} do not fit in {} bytes", element.count,
                                 in_quotes(element.name), left));
            left -= element.count * each;
        }
    }

    [[noreturn]] void fail(std::string why) const { fail_at_line(path_, line_, std::move(why)); }

    std::string_view file_;
    const std::string& path_;
    Words lines_;
    std::uint64_t line_ = 1;
    bool has_format_ = false;
    PlyHeader header_;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::Uint8:
            return 1;
        case PlyType::Int16:
        case PlyType::Uint16:
            return 2;
        case PlyType::Int32:
        case PlyType::Uint32:
        case PlyType::Float32:
            return 4;
        case PlyType::Float64:
            break;
    }
    return 8;
}

std::uint64_t PlyElement::least_bytes(PlyEncoding encoding) const {
    std::uint64_t sum = 0;
    for (const PlyProperty& p : properties) {
        // As text at least a digit; its separator may be missing from the last.
        if (encoding == PlyEncoding::Text)
            ++sum;
        else
            sum += bytes_of(p.is_list ? p.count_type : p.type);
    }
    return sum;
}

int PlyElement::find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == property) return static_cast<int>(i);
    }
    return -1;
}

PlyHeader read_ply_header(std::string_view file, const std::string& path) {
    return HeaderReader(file, path).read();
}

}  // namespace asperity::io::detail

// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/x3p_document.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::io {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string_view local(const char* name) {
    const std::string_view all(name);
    const std::size_t colon = all.find(':');
    return colon == std::string_view::npos ? all : all.substr(colon + 1);
}

// The child of this name, whatever its prefix.
pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node& each : node.children())
        if (local(each.name()) == name) return each;
    return {};
}

std::string text_in(const pugi::xml_node& node, std::string_view name) {
    return std::string(trimmed(child(node, name).text().get()));
}

// The main.xml that stands highest, without what macOS adds.
std::string main_entry(const ZipArchive& archive) {
    std::string best;
    for (const std::string& name : archive.names()) {
        const bool is_main = name == "main.xml" || name.ends_with("/main.xml");
        if (!is_main || name.starts_with("__MACOSX/")) continue;
        if (best.empty() || name.size() < best.size()) best = name;
    }
    return best;
}

}  // namespace

double X3pNumbers::at(std::size_t point, std::size_t item) const {
    if (!texts.empty()) return texts[point * types.size() + item];
    std::size_t place = point * point_bytes();
    for (std::size_t k = 0; k < item; ++k) place += static_cast<std::size_t>(size_of(types[k]));
    return number_at(BinaryView(bytes, path), types[item], place);
}

std::size_t X3pNumbers::point_bytes() const {
    std::size_t sum = 0;
    for (const NumberType type : types) sum += static_cast<std::size_t>(size_of(type));
    return sum;
}

void X3pDocument::refuse(const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, why, path_);
}

X3pDocument::X3pDocument(const HeightsSource& source)
    : path_(source.path()), archive_(source.bytes(), source.path()) {
    const std::string main = main_entry(archive_);
    if (main.empty()) refuse("the archive holds no main.xml");
    folder_ = main.substr(0, main.size() - std::string_view("main.xml").size());
    if (!folder_.empty()) remarks.push_back("everything lies in a folder of the archive");
    const std::vector<std::byte> text = archive_.read(main);
    const auto parsed = xml_.load_buffer(text.data(), text.size());
    if (!parsed)
        refuse(fmt::format("main.xml at byte {}: {}", parsed.offset, parsed.description()));
    const pugi::xml_node root = xml_.document_element();
    if (!local(root.name()).starts_with("ISO5436"))
        refuse(fmt::format("main.xml has the root {}, not ISO5436_2", in_quotes(root.name())));
    if (local(root.name()) != "ISO5436_2")
        remarks.push_back(fmt::format("the root element is {}", in_quotes(root.name())));
    read_axes(child(root, "Record1"));
    read_size(child(root, "Record3"));
    read_validity(child(child(root, "Record3"), "DataLink"));
}

void X3pDocument::read_axes(const pugi::xml_node& record) {
    feature = text_in(record, "FeatureType");
    if (feature != "SUR" && feature != "PRF" && feature != "PCL")
        refuse(fmt::format("the feature type {} is none of SUR, PRF, PCL", in_quotes(feature)));
    const pugi::xml_node axes = child(record, "Axes");
    x = read_axis(axes, "CX", false);
    y = read_axis(axes, "CY", false);
    z = read_axis(axes, "CZ", true);
    const pugi::xml_node rotation = child(axes, "Rotation");
    for (const char* cosine : {"r11", "r22", "r33"})
        if (const auto value = parse_double(text_in(rotation, cosine)); value && *value != 1) {
            remarks.push_back("the rotation of the header is left out");
            break;
        }
}

X3pAxis X3pDocument::read_axis(const pugi::xml_node& axes, const char* name, bool is_z) const {
    const pugi::xml_node node = child(axes, name);
    if (!node) refuse(fmt::format("the axis {} is missing", name));
    X3pAxis axis;
    const std::string kind = text_in(node, "AxisType");
    if (kind != "A" && kind != "I")
        refuse(fmt::format("axis {}: {} is neither A nor I", name, in_quotes(kind)));
    axis.absolute = kind == "A";
    if (is_z && !axis.absolute) refuse("the axis CZ must be absolute (A)");
    const std::string type = text_in(node, "DataType");
    constexpr std::pair<const char*, NumberType> kTypes[] = {{"I", NumberType::I16},
                                                             {"L", NumberType::I32},
                                                             {"F", NumberType::F32},
                                                             {"D", NumberType::F64}};
    const auto known = std::find_if(std::begin(kTypes), std::end(kTypes),
                                    [&](const auto& row) { return type == row.first; });
    if (known == std::end(kTypes) && axis.absolute)
        refuse(
            fmt::format("axis {}: the data type {} is none of I, L, F, D", name, in_quotes(type)));
    if (known != std::end(kTypes)) axis.type = known->second;
    const auto number = [&](const char* key, double otherwise) {
        const std::string text = text_in(node, key);
        if (text.empty()) return otherwise;
        const auto value = parse_double(text);
        if (!value)
            refuse(fmt::format("axis {}: {} {} is not a number", name, key, in_quotes(text)));
        return *value;
    };
    axis.increment = number("Increment", 1);
    axis.offset = number("Offset", 0);
    return axis;
}

void X3pDocument::read_size(const pugi::xml_node& record) {
    const auto count = [&](const pugi::xml_node& node, const char* name) {
        const std::string text = text_in(node, name);
        const auto value = parse_integer<std::uint64_t>(text);
        if (!value || *value == 0 || *value > 0xffffffffu)
            refuse(fmt::format("{} {} is no number of points", name, in_quotes(text)));
        return *value;
    };
    if (const pugi::xml_node matrix = child(record, "MatrixDimension")) {
        nx = count(matrix, "SizeX");
        ny = count(matrix, "SizeY");
        if (const std::uint64_t layers = count(matrix, "SizeZ"); layers != 1)
            refuse(fmt::format("{} layers, one is read", layers));
        if (feature != "PRF") check_sides(nx, ny, path_);
        return;
    }
    list = true;
    nx = count(record, "ListDimension");
    ny = 1;
}

// One bit a point, 1 = valid, the lowest bit of a byte first.
void X3pDocument::read_validity(const pugi::xml_node& link) {
    const std::string name = text_in(link, "ValidPointsLink");
    if (name.empty()) return;
    valid_ = archive_.read(entry(name));
    if (valid_.size() < (points() + 7) / 8)
        refuse(fmt::format("{} holds {} bytes, {} points need {}", in_quotes(name), valid_.size(),
                           points(), (points() + 7) / 8));
}

bool X3pDocument::valid(std::size_t point) const {
    if (valid_.empty()) return true;
    return ((std::to_integer<unsigned>(valid_[point / 8]) >> (point % 8)) & 1u) != 0;
}

std::string X3pDocument::entry(const std::string& name) const {
    if (archive_.has(folder_ + name)) return folder_ + name;
    if (archive_.has(name)) return name;
    refuse(fmt::format("{} is missing in the archive", in_quotes(name)));
}

X3pNumbers X3pDocument::numbers(std::size_t per_point) const {
    X3pNumbers numbers;
    numbers.path = path_;
    if (x.absolute) numbers.types.push_back(x.type);
    if (y.absolute) numbers.types.push_back(y.type);
    numbers.types.push_back(z.type);
    const pugi::xml_node record = child(xml_.document_element(), "Record3");
    if (const pugi::xml_node datums = child(record, "DataList")) {
        numbers.texts = read_datums(datums, per_point);
        return numbers;
    }
    const std::string name = text_in(child(record, "DataLink"), "PointDataLink");
    if (name.empty()) refuse("main.xml has neither a DataList nor a PointDataLink");
    numbers.bytes = archive_.read(entry(name));
    if (numbers.bytes.size() / numbers.point_bytes() < points())
        refuse(fmt::format("{} holds {} bytes, {} points need {} each", in_quotes(name),
                           numbers.bytes.size(), points(), numbers.point_bytes()));
    return numbers;
}

std::vector<double> X3pDocument::read_datums(const pugi::xml_node& datums,
                                             std::size_t per_point) const {
    std::vector<double> values;
    std::uint64_t count = 0;
    for (const pugi::xml_node& datum : datums.children()) {
        if (datum.type() != pugi::node_element) continue;
        ++count;
        const std::string_view text = trimmed(datum.text().get());
        if (text.empty()) {
            values.insert(values.end(), per_point, kNaN);
            continue;
        }
        const auto parts = split(text, ';');
        if (parts.size() != per_point)
            refuse(fmt::format("datum {} has {} numbers, not {}", count, parts.size(), per_point));
        for (const std::string_view part : parts) {
            const auto value = parse_double(part);
            if (!value && part != "NaN" && part != "nan")
                refuse(fmt::format("datum {}: {} is not a number", count, in_quotes(part)));
            values.push_back(value.value_or(kNaN));
        }
    }
    if (count != points())
        refuse(fmt::format("{} points are announced, {} are there", points(), count));
    return values;
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
// NumPy's .npy: one array of two axes, rows first.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

struct Header {
    NumberType type = NumberType::F64;
    bool big = false, columns_first = false;
    std::uint64_t rows = 0, columns = 0, data = 0;
};

bool recognises(std::string_view head) {
    return head.starts_with(kMagic);
}

// What stands behind "'key':" in the header's dictionary.
std::string_view value_of(std::string_view header, std::string_view key, const BinaryView& view) {
    const std::string quoted = fmt::format("'{}':", key);
    const std::size_t at = header.find(quoted);
    if (at == std::string_view::npos)
        view.refuse(fmt::format("'{}' is missing in the header", key));
    return trimmed(header.substr(at + quoted.size()));
}

void read_type(Header& header, std::string_view descr, const BinaryView& view) {
    struct Row {
        std::string_view code;
        NumberType type;
    };
    constexpr Row kTypes[] = {
        {"f4", NumberType::F32}, {"f8", NumberType::F64}, {"u1", NumberType::U8},
        {"i1", NumberType::I8},  {"u2", NumberType::U16}, {"i2", NumberType::I16},
        {"u4", NumberType::U32}, {"i4", NumberType::I32}, {"i8", NumberType::I64}};
    const bool quoted = descr.size() > 4 && descr[0] == '\'' && descr[4] == '\'';
    if (quoted && std::string_view("<>|=").find(descr[1]) != std::string_view::npos)
        for (const Row& row : kTypes)
            if (descr.substr(2, 2) == row.code) {
                header.type = row.type;
                header.big = descr[1] == '>';
                return;
            }
    view.refuse(fmt::format("numbers of type {} are not read", in_quotes(descr.substr(0, 12))));
}

void read_shape(Header& header, std::string_view shape, const BinaryView& view) {
    const std::size_t end = shape.find(')');
    if (!shape.starts_with('(') || end == std::string_view::npos) view.refuse("no shape");
    const auto sides = split(shape.substr(1, end - 1), ',');
    const bool two = sides.size() == 2 && !sides[1].empty();
    const auto rows = parse_integer<std::uint64_t>(sides[0]);
    const auto columns = two ? parse_integer<std::uint64_t>(sides[1]) : std::nullopt;
    if (!rows || !columns)
        view.refuse(fmt::format("the array {} has not two axes", shape.substr(0, end + 1)));
    header.rows = *rows;
    header.columns = *columns;
}

Header read_header(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a NumPy file (wrong magic)");
    const int version = view.little<std::uint8_t>(6);
    if (version < 1 || version > 3) view.refuse(fmt::format("version {} is not read", version));
    const std::uint64_t start = version == 1 ? 10 : 12;
    const std::uint64_t length =
        version == 1 ? view.little<std::uint16_t>(8) : view.little<std::uint32_t>(8);
    view.need(start, length);
    const std::string_view text =
        source.text().substr(static_cast<std::size_t>(start), static_cast<std::size_t>(length));
    Header header;
    header.data = start + length;
    read_type(header, value_of(text, "descr", view), view);
    header.columns_first = value_of(text, "fortran_order", view).starts_with("True");
    read_shape(header, value_of(text, "shape", view), view);
    return header;
}

Topography transposed(Topography t) {
    Topography out = t;
    std::swap(out.nx, out.ny);
    for (int j = 0; j < out.ny; ++j)
        for (int i = 0; i < out.nx; ++i) {
            const auto to = static_cast<std::size_t>(j) * static_cast<std::size_t>(out.nx) +
                            static_cast<std::size_t>(i);
            const auto from = static_cast<std::size_t>(i) * static_cast<std::size_t>(t.nx) +
                              static_cast<std::size_t>(j);
            out.heights[to] = t.heights[from];
            if (!t.missing.empty()) out.missing[to] = t.missing[from];
        }
    return out;
}

Topography read(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    const Header header = read_header(source);
    const GridNumbers numbers{header.type, header.big, header.data, 0, 1, 0};
    const std::uint64_t expected =
        header.data + header.rows * header.columns * size_of(header.type);
    check_sides(header.columns, header.rows, source.path());
    if (view.size() != expected)
        view.refuse(fmt::format("{} bytes are needed, the file has {}", expected, view.size()));
    Topography t =
        header.columns_first
            ? transposed(
                  read_grid(source, view, header.rows, header.columns, numbers, never_missing))
            : read_grid(source, view, header.columns, header.rows, numbers, never_missing);
    t.note("first axis down, second axis to the right");
    t.assume("no scale in the file: spacing 1 cell, heights in cells");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const Header header = read_header(source);
    return {{"heights", header.columns, header.rows, {}, [source] { return read(source); }}};
}

}  // namespace

HeightsFormat npy_format() {
    return {"npy", {"npy"}, "NumPy .npy: an array of two axes", recognises, open, nullptr};
}

}  // namespace asperity::io

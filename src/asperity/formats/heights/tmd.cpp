// SPDX-License-Identifier: Apache-2.0
// TrueMap .tmd: a line of magic, a comment, sizes in mm, 32-bit floats in mm.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "Binary TrueMap Data File v";
constexpr std::size_t kMagicBytes = 32;
constexpr std::size_t kMaxComment = 4096;

bool recognises(std::string_view head) {
    return head.starts_with(kMagic);
}

// After the comment and its NUL.
std::uint64_t header_place(const HeightsSource& source) {
    const std::string_view text = source.text();
    if (text.size() < kMagicBytes) source.refuse("the file ends within its header");
    const std::size_t end = text.substr(0, kMagicBytes + kMaxComment).find('\0', kMagicBytes);
    if (end == std::string_view::npos) source.refuse("the comment is not ended by a NUL byte");
    return end + 1;
}

Topography read(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    const std::uint64_t at = header_place(source);
    const auto nx = view.little<std::uint32_t>(at), ny = view.little<std::uint32_t>(at + 4);
    Topography t = read_grid(source, view, nx, ny, {NumberType::F32, false, at + 24, 0, 1e-3, 0},
                             never_missing);
    set_spacing(t, static_cast<double>(view.little<float>(at + 8)) * 1e-3 / nx,
                static_cast<double>(view.little<float>(at + 12)) * 1e-3 / ny, "mm", source.path());
    t.note("first row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a TrueMap file (wrong magic)");
    const std::uint64_t at = header_place(source);
    return {{"heights",
             view.little<std::uint32_t>(at),
             view.little<std::uint32_t>(at + 4),
             {},
             [source] { return read(source); }}};
}

}  // namespace

HeightsFormat tmd_format() {
    return {"tmd", {"tmd"}, "TrueMap .tmd: lengths and heights in mm", recognises, open, nullptr};
}

}  // namespace asperity::io

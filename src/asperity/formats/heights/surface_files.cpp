// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/surface_files.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/heights/height_files.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>

namespace asperity::io {
namespace {

using Reader = Heightfield (*)(const std::string&);
using Writer = void (*)(const Heightfield&, const std::string&);

struct Format {
    const char* ending;
    Reader read;
    Writer write;  ///< nullptr: read only
};

constexpr Format kFormats[] = {
    {".gsf", read_gsf, write_gsf},       {".exr", read_exr_heights, write_exr_heights},
    {".png", read_png_heights, nullptr}, {".txt", read_text_matrix, write_text_matrix},
    {".csv", read_text_matrix, nullptr}, {".asc", read_text_matrix, nullptr},
    {".dat", read_text_matrix, nullptr},
};

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

const Format* format_of(const std::string& path) {
    const std::string ending = ending_of(path);
    for (const Format& format : kFormats)
        if (ending == format.ending) return &format;
    return nullptr;
}

}  // namespace

void check_sides(std::uint64_t nx, std::uint64_t ny, const std::string& path) {
    constexpr std::uint64_t kMax = kMaxSurfaceSide;
    if (nx < 2 || ny < 2 || nx > kMax || ny > kMax)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} x {} samples, 2 to {} on a side are allowed", nx, ny, kMax),
                    path);
}

Heightfield empty_patch(std::uint64_t nx, std::uint64_t ny, const std::string& path) {
    check_sides(nx, ny, path);
    Heightfield surface;
    surface.nx = static_cast<int>(nx);
    surface.ny = static_cast<int>(ny);
    surface.heights.resize(static_cast<std::size_t>(nx * ny));
    surface.boundary = Boundary::Finite;
    surface.name = path;
    return surface;
}

Heightfield read_heights(const std::string& path) {
    const Format* format = format_of(path);
    if (format == nullptr)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("heights are read from .gsf, .exr, .png, .txt, .csv, .asc and "
                                ".dat files, not {}",
                                in_quotes(ending_of(path))),
                    path);
    try {
        Heightfield surface = format->read(path);
        validate(surface, path);
        return surface;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

void write_heights(const Heightfield& surface, const std::string& path) {
    const Format* format = format_of(path);
    if (format == nullptr || format->write == nullptr)
        throw Error(ErrorCode::Usage,
                    fmt::format("heights are written to .gsf, .exr and .txt files, not {}",
                                in_quotes(ending_of(path))),
                    path);
    validate(surface, path);
    format->write(surface, path);
}

}  // namespace asperity::io

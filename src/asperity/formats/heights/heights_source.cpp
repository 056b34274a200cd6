// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/heights_source.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::io {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 30;

struct Unit {
    const char* word;
    double metres;
};

constexpr Unit kUnits[] = {
    {"m", 1},
    {"meter", 1},
    {"metre", 1},
    {"meters", 1},
    {"metres", 1},
    {"dm", 1e-1},
    {"cm", 1e-2},
    {"mm", 1e-3},
    {"millimeter", 1e-3},
    {"millimeters", 1e-3},
    {"um", 1e-6},
    {"\xc2\xb5m", 1e-6},  // micro sign, UTF-8
    {"\xce\xbcm", 1e-6},  // Greek mu, UTF-8
    {"\xb5m", 1e-6},      // Latin-1
    {"\xe6m", 1e-6},      // code page 437, in Digital Surf's files
    {"~m", 1e-6},         // SPIP
    {"micron", 1e-6},
    {"microns", 1e-6},
    {"micrometer", 1e-6},
    {"micrometers", 1e-6},
    {"nm", 1e-9},
    {"nanometer", 1e-9},
    {"nanometers", 1e-9},
    {"pm", 1e-12},
    {"\xc3\x85", 1e-10},      // Angstrom letter, UTF-8
    {"\xe2\x84\xab", 1e-10},  // Angstrom sign, UTF-8
    {"\xc5", 1e-10},          // Latin-1
    {"Angstrom", 1e-10},
    {"km", 1e3},
};

}  // namespace

HeightsSource::HeightsSource(const std::string& path, HeightsOptions options, Run& run)
    : path_(path),
      options_(std::move(options)),
      run_(&run),
      bytes_(std::make_shared<std::vector<std::byte>>()) {
    const InputFile file(path);
    head_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kSniffedHeights)));
    file.read(0, std::as_writable_bytes(std::span(head_)));
}

std::span<const std::byte> HeightsSource::bytes() const {
    if (bytes_->empty()) *bytes_ = read_file(path_, kMaxBytes);
    return *bytes_;
}

std::string_view HeightsSource::text() const {
    const auto all = bytes();
    return {reinterpret_cast<const char*>(all.data()), all.size()};
}

void HeightsSource::for_each_row(int ny, const std::function<void(int)>& row) const {
    run_->begin("reading heights", static_cast<std::uint64_t>(ny));
    for (int j = 0; j < ny; ++j) {
        if (!run_->keep_going()) throw Error(ErrorCode::Stopped, "stopped while reading", path_);
        row(j);
        run_->advance(1);
    }
    run_->end();
}

void HeightsSource::refuse(const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, why, path_);
}

void HeightsSource::refuse_line(std::size_t line, const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", path_, line));
}

void check_sides(std::uint64_t nx, std::uint64_t ny, const std::string& path) {
    constexpr std::uint64_t kMax = kMaxSurfaceSide;
    if (nx < 2 || ny < 2 || nx > kMax || ny > kMax)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} x {} samples, 2 to {} on a side are allowed", nx, ny, kMax),
                    path);
}

Topography empty_topography(std::uint64_t nx, std::uint64_t ny, const std::string& path) {
    check_sides(nx, ny, path);
    Topography topography;
    topography.nx = static_cast<int>(nx);
    topography.ny = static_cast<int>(ny);
    topography.heights.resize(static_cast<std::size_t>(nx * ny));
    return topography;
}

void set_spacing(Topography& topography, double dx, double dy, const std::string& heights_in,
                 const std::string& path) {
    for (const double step : {dx, dy})
        if (!(step > 0) || !std::isfinite(step))
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("a spacing of {:.6g} m is no positive length", step), path);
    topography.unit = "m";
    topography.dx = dx;
    topography.dy = dy;
    topography.note("heights in " + heights_in);
    topography.note("spacing " + length_text(dx) + (dx == dy ? "" : " x " + length_text(dy)));
}

std::string length_text(double metres) {
    constexpr Unit kShown[] = {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
    for (const Unit& unit : kShown)
        if (std::abs(metres) >= 0.1 * unit.metres)
            return fmt::format("{:.6g} {}", metres / unit.metres, unit.word);
    return fmt::format("{:.6g} m", metres);
}

double metres_per(std::string_view unit) {
    for (const Unit& known : kUnits)
        if (unit == known.word) return known.metres;
    return 0;
}

}  // namespace asperity::io

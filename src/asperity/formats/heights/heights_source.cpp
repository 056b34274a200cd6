// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/heights_source.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/printable.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::io {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 30;
constexpr std::size_t kPiece = 8 << 20;  // bytes read between two looks at a stop

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
    if (!bytes_->empty()) return *bytes_;
    const InputFile file(path_);
    if (file.size() > kMaxBytes)
        refuse(fmt::format("{} bytes are more than the {} allowed", file.size(), kMaxBytes));
    std::vector<std::byte> bytes(static_cast<std::size_t>(file.size()));
    run_->begin("reading the file", file.size());
    for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
        throw_if_stopped();
        const std::size_t count = std::min(kPiece, bytes.size() - at);
        file.read(at, std::span(bytes).subspan(at, count));
        run_->advance(count);
    }
    run_->end();
    return *bytes_ = std::move(bytes);
}

std::string_view HeightsSource::text() const {
    const auto all = bytes();
    return {reinterpret_cast<const char*>(all.data()), all.size()};
}

void HeightsSource::for_each_row(int ny, const std::function<void(int)>& row) const {
    run_->begin("reading heights", static_cast<std::uint64_t>(ny));
    for (int j = 0; j < ny; ++j) {
        throw_if_stopped();
        row(j);
        run_->advance(1);
    }
    run_->end();
}

void HeightsSource::throw_if_stopped() const {
    if (!run_->keep_going()) throw Error(ErrorCode::Stopped, "stopped while reading", path_);
}

void HeightsSource::refuse(const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, printable(why), path_);
}

void HeightsSource::refuse_line(std::size_t line, const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, printable(why), fmt::format("{}:{}", path_, line));
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

void set_heights_alone(Topography& topography, const std::string& heights_in) {
    topography.unit = "m";
    topography.dx = topography.dy = 0;
    topography.note("heights in " + heights_in);
}

}  // namespace asperity::io

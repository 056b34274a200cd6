// SPDX-License-Identifier: Apache-2.0
// Zygo's MetroPro .dat: a big-endian header, intensities, then phases as 32-bit integers.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "\x88\x1b\x03";
constexpr double kMissing = 2147483640;
constexpr double kResolutions[] = {4096, 32768, 131072};

bool recognises(std::string_view head) {
    return head.starts_with(kMagic) && head.size() > 3 && head[3] >= 0x6f && head[3] <= 0x71;
}

Topography read(const HeightsSource& source, std::uint64_t at) {
    const BinaryView view(source.bytes(), source.path());
    const auto resolution = view.big<std::int16_t>(218);
    if (resolution < 0 || resolution > 2)
        view.refuse(fmt::format("the phase resolution {} is none of 0, 1, 2", resolution));
    const double wavelength = static_cast<double>(view.big<float>(168));
    const double scale = static_cast<double>(view.big<float>(164)) *
                         static_cast<double>(view.big<float>(176)) * wavelength /
                         kResolutions[resolution];
    if (!std::isfinite(scale) || scale == 0)
        view.refuse("scale factor, obliquity and wavelength give no height of a count");
    GridNumbers numbers{NumberType::I32, true, at, 0, scale, 0};
    if (view.big<std::int16_t>(232) != 0) numbers.scale = -scale;
    Topography t = read_grid(source, view, view.big<std::uint16_t>(68), view.big<std::uint16_t>(70),
                             numbers, [](double n) { return n >= kMissing; });
    const auto step = static_cast<double>(view.big<float>(184));
    const std::string unit =
        fmt::format("{:.4g} nm a count (phase resolution {})", std::abs(scale) * 1e9, resolution);
    if (step > 0) {
        set_spacing(t, step, step, unit, source.path());
    } else {
        set_heights_alone(t, unit);
    }
    t.note("first row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a MetroPro file (wrong magic)");
    const std::uint64_t header = view.big<std::uint32_t>(6);
    if (header < 834) view.refuse(fmt::format("a header of {} bytes is too short", header));
    const std::uint64_t intensities = std::uint64_t{2} * view.big<std::uint16_t>(56) *
                                      view.big<std::uint16_t>(52) * view.big<std::uint16_t>(54);
    const std::uint64_t at = header + intensities;
    return {{"phase", view.big<std::uint16_t>(68), view.big<std::uint16_t>(70), {}, [source, at] {
                 return read(source, at);
             }}};
}

}  // namespace

HeightsFormat metropro_format() {
    return {"metropro", {}, "Zygo MetroPro .dat: phases", recognises, open, nullptr};
}

}  // namespace asperity::io

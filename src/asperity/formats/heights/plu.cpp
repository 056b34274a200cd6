// SPDX-License-Identifier: Apache-2.0
// Sensofar's .plu: no magic; a date, a comment, a header of 500 bytes, layers of 32-bit floats
// [um].
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

namespace asperity::io {
namespace {

constexpr std::uint64_t kCalibration = 388, kConfiguration = kCalibration + 40;
constexpr std::uint64_t kSettings = kConfiguration + 20;
constexpr std::uint64_t kTail = kSettings + 40, kLayers = kTail + 12;
constexpr std::uint32_t kTopography = 3;
constexpr double kMissing = 1000001;

// No magic: "Fri Mar 10 16:35:59 2023" and a plausible type of measurement.
bool recognises(std::string_view head) {
    if (head.size() < kLayers) return false;
    constexpr std::string_view kPattern = "Aaa Aaa 00 00:00:00 0000";
    for (std::size_t k = 0; k < kPattern.size(); ++k) {
        const char c = head[k];
        const bool digit = c >= '0' && c <= '9';
        const bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        if (kPattern[k] == '0'                         ? !digit && c != ' '
            : kPattern[k] == 'A' || kPattern[k] == 'a' ? !letter
                                                       : c != kPattern[k])
            return false;
    }
    return head[kPattern.size()] == '\0';
}

Topography read(const HeightsSource& source, std::uint64_t at) {
    const BinaryView view(source.bytes(), source.path());
    const std::uint64_t ny = view.little<std::uint32_t>(at),
                        nx = view.little<std::uint32_t>(at + 4);
    Topography t = read_grid(source, view, nx, ny, {NumberType::F32, false, at + 8, 0, 1e-6, 0},
                             [](double n) { return n == kMissing; });
    set_spacing(t, static_cast<double>(view.little<float>(kCalibration + 16)) * 1e-6,
                static_cast<double>(view.little<float>(kCalibration + 20)) * 1e-6, "um",
                source.path());
    t.note("first row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    const auto type = view.little<std::uint32_t>(kConfiguration);
    if (type != kTopography)
        view.refuse(fmt::format("a Sensofar measurement of type {} is no topography (3)", type));
    const auto layers = view.little<std::uint8_t>(kTail + 1);
    std::vector<HeightsChannel> channels;
    std::uint64_t at = kLayers;
    for (int k = 0; k < layers; ++k) {
        const std::uint64_t ny = view.little<std::uint32_t>(at),
                            nx = view.little<std::uint32_t>(at + 4);
        check_sides(nx, ny, source.path());
        view.need(at + 8, nx * ny, sizeof(float));
        channels.push_back(
            {layers == 1 ? "heights" : fmt::format("layer {}", k + 1), nx, ny, {}, [source, at] {
                 return read(source, at);
             }});
        at += 8 + nx * ny * sizeof(float) + 8;
    }
    return channels;
}

}  // namespace

HeightsFormat plu_format() {
    return {"plu", {"plu", "apx"}, "Sensofar .plu: topographies in um", recognises, open, nullptr};
}

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
// NanoFocus' .nms: a header of 3468 bytes, then 16-bit counts over the range of heights.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

namespace asperity::io {
namespace {

constexpr std::uint64_t kHeaderBytes = 3468, kRange = 16, kKind = 32, kSides = 1368,
                        kSpacing = 1376;
constexpr double kCounts = 65534;  ///< from the lowest to the highest height

bool recognises(std::string_view head) {
    return head.size() > kKind && head.substr(kKind).starts_with("OM_MS_");
}

Topography read(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    view.need(0, kHeaderBytes);
    const auto low = view.little<double>(kRange), high = view.little<double>(kRange + 8);
    if (!(high > low) || !std::isfinite(high - low))
        view.refuse(fmt::format("heights from {:.6g} to {:.6g} um are no range", low, high));
    const GridNumbers numbers{
        NumberType::U16, false, kHeaderBytes, 0, (high - low) / kCounts * 1e-6, low * 1e-6};
    Topography t = read_grid(source, view, view.little<std::uint32_t>(kSides),
                             view.little<std::uint32_t>(kSides + 4), numbers, never_missing);
    set_spacing(t, view.little<double>(kSpacing) * 1e-9, view.little<double>(kSpacing + 8) * 1e-9,
                fmt::format("{:.6g} to {:.6g} um from the header", low, high), source.path());
    t.note("first row on top");
    t.assume("the spacing in the header is in nm; no count stands for a missing point");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    return {{"heights",
             view.little<std::uint32_t>(kSides),
             view.little<std::uint32_t>(kSides + 4),
             {},
             [source] { return read(source); }}};
}

}  // namespace

HeightsFormat nms_format() {
    return {"nms", {"nms"}, "NanoFocus .nms: the confocal heights", recognises, open, nullptr};
}

}  // namespace asperity::io

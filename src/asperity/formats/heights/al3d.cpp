// SPDX-License-Identifier: Apache-2.0
// Alicona Imaging's .al3d: tags of 52 bytes, then 32-bit floats in rows padded to 8 bytes.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <limits>
#include <map>

namespace asperity::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "AliconaImaging\0\r\n"sv;
constexpr std::uint64_t kKeyBytes = 20, kValueBytes = 30, kTagBytes = 52;
constexpr std::uint64_t kMaxTags = 10000;

using Tags = std::map<std::string, std::string>;

bool recognises(std::string_view head) {
    return head.starts_with(kMagic);
}

void add_tag(Tags& tags, const BinaryView& view, std::uint64_t at) {
    view.need(at, kTagBytes);
    if (view.little<std::uint16_t>(at + kTagBytes - 2) != 0x0a0d)
        view.refuse(fmt::format("the tag at byte {} does not end with a line end", at));
    tags.emplace(view.text(at, kKeyBytes), view.text(at + kKeyBytes, kValueBytes));
}

double number(const Tags& tags, const std::string& key, const BinaryView& view) {
    const auto tag = tags.find(key);
    if (tag == tags.end()) view.refuse("the tag " + key + " is missing");
    const auto value = parse_double(tag->second);
    if (!value) view.refuse(key + " " + in_quotes(tag->second) + " is not a number");
    return *value;
}

std::uint64_t count(const Tags& tags, const std::string& key, const BinaryView& view) {
    const double value = number(tags, key, view);
    if (!(value >= 0 && value < 1e15) || value != std::floor(value))
        view.refuse(fmt::format("{} {} is no whole number", key, value));
    return static_cast<std::uint64_t>(value);
}

Tags read_tags(const BinaryView& view) {
    Tags tags;
    add_tag(tags, view, kMagic.size());
    add_tag(tags, view, kMagic.size() + kTagBytes);
    const std::uint64_t more = count(tags, "TagCount", view);
    if (more > kMaxTags) view.refuse(fmt::format("{} tags are too many", more));
    view.need(kMagic.size() + 2 * kTagBytes, more, kTagBytes);
    for (std::uint64_t k = 0; k < more; ++k)
        add_tag(tags, view, kMagic.size() + (2 + k) * kTagBytes);
    return tags;
}

Topography read(const HeightsSource& source, const Tags& tags) {
    const BinaryView view(source.bytes(), source.path());
    const std::uint64_t nx = count(tags, "Cols", view), ny = count(tags, "Rows", view);
    check_sides(nx, ny, source.path());
    const std::uint64_t row_bytes = (nx * sizeof(float) + 7) / 8 * 8;
    const std::uint64_t at = count(tags, "DepthImageOffset", view);
    if (at == 0) view.refuse("the file has no depth image");
    const float invalid = tags.contains("InvalidPixelValue")
                              ? static_cast<float>(number(tags, "InvalidPixelValue", view))
                              : std::numeric_limits<float>::quiet_NaN();
    Topography t = read_grid(source, view, nx, ny, {NumberType::F32, false, at, row_bytes, 1, 0},
                             [&](double n) { return static_cast<float>(n) == invalid; });
    set_spacing(t, number(tags, "PixelSizeXMeter", view), number(tags, "PixelSizeYMeter", view),
                "m", source.path());
    t.note("first row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not an Alicona file (wrong magic)");
    const Tags tags = read_tags(view);
    return {{"depth", count(tags, "Cols", view), count(tags, "Rows", view), {}, [source, tags] {
                 return read(source, tags);
             }}};
}

}  // namespace

HeightsFormat al3d_format() {
    return {"al3d", {"al3d"}, "Alicona Imaging .al3d: the depth image", recognises, open, nullptr};
}

}  // namespace asperity::io

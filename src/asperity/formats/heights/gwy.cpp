// SPDX-License-Identifier: Apache-2.0
// Gwyddion's .gwy: objects of named, typed components; heights in GwyDataField /N/data.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <map>
#include <optional>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "GWYP";

/// A component: where its value stands. For strings and objects without their headers.
struct Component {
    char type = 0;
    std::uint64_t at = 0, count = 0;  ///< of arrays, strings (bytes) and objects (bytes)
    std::string object;               ///< type name of an object
};
using Components = std::map<std::string, Component>;

bool recognises(std::string_view head) {
    return head.starts_with(kMagic);
}

// The text from `at` to its NUL, which is passed.
std::string read_word(const BinaryView& view, std::uint64_t& at, std::uint64_t end) {
    std::uint64_t stop = at;
    while (stop < end && view.little<char>(stop) != '\0') ++stop;
    if (stop >= end) view.refuse(fmt::format("a name at byte {} has no end", at));
    const std::string word = view.text(at, stop - at);
    at = stop + 1;
    return word;
}

std::uint64_t item_size(char type) {
    switch (type) {
        case 'b':
        case 'c':
        case 'C':
            return 1;
        case 'i':
        case 'I':
            return 4;
        case 'q':
        case 'Q':
        case 'd':
        case 'D':
            return 8;
        case 'f':
        case 'F':
            return 4;
    }
    return 0;
}

Component read_object_head(const BinaryView& view, std::uint64_t& at, std::uint64_t end) {
    Component object{'o', 0, 0, read_word(view, at, end)};
    object.count = view.little<std::uint32_t>(at);
    at += 4;
    object.at = at;
    if (object.count > end - std::min(at, end))
        view.refuse(
            fmt::format("object {} is larger than what holds it", in_quotes(object.object)));
    at += object.count;
    return object;
}

// An array of strings or objects, which heights do not need, is stepped over.
void skip_items(const BinaryView& view, char type, std::uint64_t count, std::uint64_t& at,
                std::uint64_t end) {
    for (std::uint64_t k = 0; k < count; ++k) {
        if (type == 'S')
            read_word(view, at, end);
        else
            read_object_head(view, at, end);
    }
}

Component read_value(const BinaryView& view, char type, std::uint64_t& at, std::uint64_t end) {
    if (type == 'o') return read_object_head(view, at, end);
    Component value{type, at, 1, {}};
    if (type == 's') {
        read_word(view, at, end);
        value.count = at - value.at - 1;
        return value;
    }
    const bool array = type >= 'A' && type <= 'Z';
    if (array) {
        value.count = view.little<std::uint32_t>(at);
        at += 4;
        value.at = at;
    }
    if (type == 'S' || type == 'O') {
        skip_items(view, type, value.count, at, end);
        return value;
    }
    const std::uint64_t size = item_size(type);
    if (size == 0) view.refuse(fmt::format("a component at byte {} is of an unknown type", at));
    view.need(at, value.count, size);
    at += value.count * size;
    if (at > end) view.refuse("a component is larger than its object");
    return value;
}

Components read_components(const BinaryView& view, const Component& object) {
    Components components;
    std::uint64_t at = object.at;
    const std::uint64_t end = object.at + object.count;
    while (at < end) {
        const std::string name = read_word(view, at, end);
        const char type = view.little<char>(at++);
        components[name] = read_value(view, type, at, end);
    }
    return components;
}

double number(const BinaryView& view, const Components& components, const std::string& name,
              double otherwise) {
    const auto found = components.find(name);
    if (found == components.end()) return otherwise;
    if (found->second.type == 'i') return view.little<std::int32_t>(found->second.at);
    if (found->second.type == 'd') return view.little<double>(found->second.at);
    view.refuse(in_quotes(name) + " is no number");
}

/// The text of a GwySIUnit; empty when there is none.
std::string unit_of(const BinaryView& view, const Components& field, const std::string& name) {
    const auto found = field.find(name);
    if (found == field.end() || found->second.type != 'o') return {};
    const Components unit = read_components(view, found->second);
    const auto text = unit.find("unitstr");
    if (text == unit.end() || text->second.type != 's') return {};
    return view.text(text->second.at, text->second.count);
}

struct Field {
    std::uint64_t nx = 0, ny = 0;
    Component data;
    Components components;
};

Field read_field(const BinaryView& view, const Component& object) {
    Field field;
    field.components = read_components(view, object);
    const double nx = number(view, field.components, "xres", 0),
                 ny = number(view, field.components, "yres", 0);
    if (nx <= 0 || ny <= 0) view.refuse(fmt::format("{} x {} is no size of a field", nx, ny));
    field.nx = static_cast<std::uint64_t>(nx), field.ny = static_cast<std::uint64_t>(ny);
    const auto data = field.components.find("data");
    if (data == field.components.end() || data->second.type != 'D')
        view.refuse("a data field has no data");
    field.data = data->second;
    if (field.data.count != field.nx * field.ny)
        view.refuse(fmt::format("{} x {} samples are announced, {} are there", field.nx, field.ny,
                                field.data.count));
    return field;
}

// A mask lies over the points that somebody wants left out: they count as missing.
void apply_mask(Topography& t, const BinaryView& view, const Component& object) {
    const Field mask = read_field(view, object);
    if (mask.nx != static_cast<std::uint64_t>(t.nx) || mask.ny != static_cast<std::uint64_t>(t.ny))
        view.refuse("the mask is not of the size of its field");
    std::size_t masked = 0;
    for (std::size_t k = 0; k < t.heights.size(); ++k) {
        if (!(view.little<double>(mask.data.at + 8 * k) >= 0.5)) continue;
        t.mark_missing(k);
        ++masked;
    }
    if (masked > 0) t.assume(fmt::format("the {} points under the mask count as missing", masked));
}

Topography read(const HeightsSource& source, const Component& object,
                const std::optional<Component>& mask, const std::string& title) {
    const BinaryView view(source.bytes(), source.path());
    const Field field = read_field(view, object);
    Topography t = read_grid(source, view, field.nx, field.ny,
                             {NumberType::F64, false, field.data.at, 0, 1, 0}, never_missing);
    const double width = number(view, field.components, "xreal", 0),
                 height = number(view, field.components, "yreal", 0);
    const double xy = metres_per(unit_of(view, field.components, "si_unit_xy"));
    const std::string z_word = unit_of(view, field.components, "si_unit_z");
    const double z = metres_per(z_word);
    if (xy > 0 && z > 0) {
        for (double& h : t.heights) h *= z;
        set_spacing(t, width * xy / t.nx, height * xy / t.ny, z_word, source.path());
    } else if (xy == 0 && z_word.empty()) {
        t.assume("no units: spacing and heights in cells");
        if (width > 0 && height > 0) t.dx = width / t.nx, t.dy = height / t.ny;
    } else {
        source.refuse("widths and heights need units of length both");
    }
    t.note("first row on top");
    t.name = title;
    if (mask) apply_mask(t, view, *mask);
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a Gwyddion file (wrong magic)");
    std::uint64_t at = kMagic.size();
    const Component root = read_object_head(view, at, view.size());
    if (root.object != "GwyContainer") view.refuse("the file holds no GwyContainer");
    const Components all = read_components(view, root);

    std::map<int, HeightsChannel> channels;
    for (const auto& entry : all) {
        const std::string& name = entry.first;
        const Component& component = entry.second;
        if (component.type != 'o' || component.object != "GwyDataField") continue;
        if (!name.starts_with('/') || !name.ends_with("/data")) continue;
        const std::string id = name.substr(1, name.size() - 6);
        const auto number_of = parse_integer<int>(id);
        if (!number_of) continue;
        std::string title = "channel " + id;
        if (const auto text = all.find(name + "/title");
            text != all.end() && text->second.type == 's')
            title = view.text(text->second.at, text->second.count);
        std::optional<Component> mask;
        if (const auto found = all.find("/" + id + "/mask");
            found != all.end() && found->second.type == 'o')
            mask = found->second;
        const Field field = read_field(view, component);
        const std::string z = unit_of(view, field.components, "si_unit_z");
        const std::string other = z.empty() || metres_per(z) > 0 ? "" : "in " + in_quotes(z);
        channels[*number_of] = {title, field.nx, field.ny, other, [source, component, mask, title] {
                                    return read(source, component, mask, title);
                                }};
    }
    std::vector<HeightsChannel> list;
    for (auto& [id, channel] : channels) list.push_back(std::move(channel));
    return list;
}

}  // namespace

HeightsFormat gwy_format() {
    return {"gwy", {"gwy"}, "Gwyddion .gwy: channels of heights, masks", recognises, open, nullptr};
}

}  // namespace asperity::io

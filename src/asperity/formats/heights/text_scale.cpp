// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/text_scale.h>

#include <asperity/core/parse_number.h>

#include <algorithm>
#include <array>

namespace asperity::io {
namespace {

/// "key: number unit", "key (unit) = number", "key: unit".
struct Entry {
    std::string key;  ///< small letters
    std::optional<double> number;
    std::string unit;
    const TextLine* line = nullptr;

    double metres() const { return metres_per(unit); }
    bool is_length() const { return number && *number > 0 && metres() > 0; }
    bool is_unit() const { return !number && metres() > 0; }
};

std::string small(std::string_view text) {
    std::string copy(text);
    for (char& c : copy)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return copy;
}

std::string_view without_brackets(std::string_view unit) {
    unit = trimmed(unit);
    if (unit.size() > 1 && (unit.front() == '(' || unit.front() == '[') &&
        (unit.back() == ')' || unit.back() == ']'))
        unit = trimmed(unit.substr(1, unit.size() - 2));
    if (unit.starts_with("->")) unit = trimmed(unit.substr(2));
    return unit;
}

Entry read_entry(std::string_view key, std::string_view value, const TextLine& line) {
    Entry entry;
    entry.line = &line;
    value = trimmed(value);
    std::size_t end = value.find_first_not_of("0123456789+-.,eE");
    end = std::min(end, value.size());
    entry.number = table_number(value.substr(0, end), true);
    entry.unit = without_brackets(entry.number ? value.substr(end) : value);
    key = trimmed(key);
    const std::size_t bracket = key.find_last_of("([");
    if (bracket != std::string_view::npos && bracket > 0) {
        if (entry.unit.empty()) entry.unit = without_brackets(key.substr(bracket));
        key = trimmed(key.substr(0, bracket));
    }
    entry.key = small(key);
    return entry;
}

void add_entries(std::vector<Entry>& entries, const TextLine& line) {
    const std::string_view text = line.text;
    if (std::count(text.begin(), text.end(), '=') > 1) {
        std::size_t at = 0;
        while (at < text.size()) {
            const std::size_t end = std::min(text.find_first_of(" \t;", at), text.size());
            const std::string_view word = text.substr(at, end - at);
            if (const std::size_t equals = word.find('='); equals != std::string_view::npos)
                entries.push_back(
                    read_entry(word.substr(0, equals), word.substr(equals + 1), line));
            at = end + 1;
        }
        return;
    }
    const std::size_t sign = text.find_first_of("=:");
    if (sign == std::string_view::npos) return;
    entries.push_back(read_entry(text.substr(0, sign), text.substr(sign + 1), line));
}

bool has_any(const std::string& key, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return key.find(word) != std::string::npos; });
}

bool is_any(const std::string& key, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), key) != words.end();
}

// True when the words of the key say what the entry is.
bool take_known(TextScale& scale, const Entry& e) {
    const std::string& key = e.key;
    if (e.is_length() && has_any(key, {"pixel size", "pixelsize", "pixel_size", "spacing", "step",
                                       "lateral res", "increment", "sampling"})) {
        const double metres = *e.number * e.metres();
        const bool y = has_any(key, {" y", "y ", "_y", "y-", "ysp", "yst"});
        const bool x = has_any(key, {" x", "x ", "_x", "x-", "xsp", "xst"}) && !y;
        if (!y) scale.dx = metres;
        if (!x) scale.dy = metres;
        return true;
    }
    if (has_any(key, {"conversion", "z scale", "height scale", "z-scale"}) && e.is_length()) {
        scale.z = *e.number * e.metres();
        scale.z_text = length_text(*scale.z) + " a count";
        return true;
    }
    if (e.is_unit() &&
        has_any(key, {"value unit", "z unit", "z-unit", "zunit", "height unit", "data unit"})) {
        if (!scale.z) scale.z = e.metres(), scale.z_text = e.unit;
        return true;
    }
    if (e.number && e.unit.empty()) {
        if (is_any(key, {"w", "width", "columns", "cols", "xres", "x-pixels", "nx"})) {
            scale.columns = *e.number;
            return true;
        }
        if (is_any(key, {"h", "height", "rows", "yres", "y-pixels", "ny"})) {
            scale.rows = *e.number;
            return true;
        }
    }
    return false;
}

// Gwyddion's export in any language: two lengths, then perhaps a unit alone.
void take_by_units(TextScale& scale, std::vector<Entry>& open) {
    std::vector<const Entry*> lengths, units;
    for (const Entry& e : open) {
        if (e.is_length()) lengths.push_back(&e);
        if (e.is_unit()) units.push_back(&e);
    }
    std::vector<const TextLine*> used;
    if (lengths.size() == 2 && !scale.dx && !scale.dy) {
        if (has_any(lengths[0]->key, {"height"}) && has_any(lengths[1]->key, {"width"}))
            std::swap(lengths[0], lengths[1]);
        scale.width = *lengths[0]->number * lengths[0]->metres();
        scale.height = *lengths[1]->number * lengths[1]->metres();
        for (const Entry* e : lengths) used.push_back(e->line);
    }
    if (units.size() == 1 && !scale.z) {
        scale.z = units[0]->metres();
        scale.z_text = units[0]->unit;
        used.push_back(units[0]->line);
    }
    std::erase_if(open, [&](const Entry& e) {
        return std::find(used.begin(), used.end(), e.line) != used.end();
    });
}

}  // namespace

TextScale read_text_scale(const std::vector<TextLine>& header) {
    std::vector<Entry> entries, open;
    for (const TextLine& line : header) add_entries(entries, line);
    TextScale scale;
    for (const Entry& e : entries)
        if (!take_known(scale, e)) open.push_back(e);
    take_by_units(scale, open);
    for (const Entry& e : open)
        if (e.number || e.metres() > 0) scale.not_understood.push_back(*e.line);
    return scale;
}

}  // namespace asperity::io

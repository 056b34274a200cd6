// SPDX-License-Identifier: Apache-2.0
// One row per setting: what it is called, which values it takes, what it does. Text, options and
// their help, forms, JSON and the reference page are all made from these rows.
#pragma once

#include <asperity/core/error.h>
#include <asperity/params/range.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace asperity {

/// The value of any setting. std::monostate: the setting is left open, as its word `absent` says.
/// A choice is its name. In a list NaN stands for an entry left open.
using ParamValue = std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double,
                                std::string, std::vector<double>>;

enum class ParamType {
    Flag,
    Integer,
    Natural,  ///< a whole number from 0 on: counts and seeds, all 64 bits
    Real,
    Choice,  ///< one of `choices`
    Text,
    List,  ///< numbers between commas; "0:80:10" stands for 0, 10, ... 80
    Pair,  ///< two numbers, "0.3,0.1"; "0.3" alone counts for both
};

/// What is known of a setting without a value at hand.
struct ParamInfo {
    std::string name = {};     ///< key of files and, behind "--", option: small letters, dashes
    std::string label = {};    ///< in a form, "Correlation Length"; empty: made from the name
    std::string group = {};    ///< heading in files, forms and help
    std::string metavar = {};  ///< of the value in help; empty: made from the type
    std::string unit = {};     ///< "degrees", "cells", "nm"; empty: none
    Range range = {};          ///< of a number, and of every number of a list
    std::vector<std::string> choices = {};
    std::string absent = {};  ///< word for no value, "auto" or "none"; empty: there is always one
    std::string doc = {};     ///< one sentence, without a capital and without its full stop
    std::string otherwise =
        {};                  ///< what holds where nothing is set, if the default does not say it
    std::string users = {};  ///< who uses it, "gaussian, ggx"; empty: all
    bool written_where_used = false;      ///< in files only where it counts: newer than old files
    bool written_unless_default = false;  ///< in files only where it is not the default: likewise
    bool percent = false;                 ///< numbers may end in '%'
    std::size_t most = SIZE_MAX;          ///< entries of a list
    ParamType type = ParamType::Text;     ///< the makers of rows below set it
};

// Text, value and range. Each throws Error(Usage, message, info.name).

/// The value a text stands for; whole numbers may be written as 1e6. Ranges are not looked at.
ParamValue parse(const ParamInfo& info, std::string_view text);
/// Numbers must lie in the range and choices must exist.
void check(const ParamInfo& info, const ParamValue& value);
[[noreturn]] void refuse(const ParamInfo& info, std::string why);

/// The text that parse() reads back to the same bits.
std::string format(const ParamInfo& info, const ParamValue& value);
/// The name of the value in help: "N", "X[,Y]", the choices.
std::string metavar(const ParamInfo& info);
/// Who uses it, what it does, and its range: a line of help.
std::string help_text(const ParamInfo& info);
/// "correlation-length" -> "Correlation Length" where the row brings no label.
std::string label(const ParamInfo& info);

/// A setting of the struct Settings.
template <typename Settings>
struct Param {
    ParamInfo info;
    std::function<ParamValue(const Settings&)> get;
    /// Takes what parse() gives for the row and stores it; refuses what its field cannot hold.
    std::function<void(Settings&, const ParamValue&)> set;
    /// Why the other settings leave this one without effect, as a sentence about it; empty when
    /// they do not. Not set: it always counts.
    std::function<std::string(const Settings&)> unused = {};

    bool used(const Settings& settings) const { return !unused || unused(settings).empty(); }
    /// Whether files hold it.
    bool written(const Settings& settings) const {
        return !(info.written_where_used && !used(settings)) &&
               !(info.written_unless_default && text(settings) == default_text());
    }
    std::string text(const Settings& settings) const { return format(info, get(settings)); }
    std::string default_text() const { return text(Settings{}); }
    /// Reads and checks. Throws Error(Usage, name).
    void apply(Settings& settings, std::string_view value) const {
        const ParamValue parsed = parse(info, value);
        asperity::check(info, parsed);
        set(settings, parsed);
    }
    void check(const Settings& settings) const { asperity::check(info, get(settings)); }
};

template <typename Settings>
using ParamTable = std::vector<Param<Settings>>;

/// The row of that name, or nullptr.
template <typename Settings>
const Param<Settings>* find(const ParamTable<Settings>& table, std::string_view name) {
    for (const Param<Settings>& param : table)
        if (param.info.name == name) return &param;
    return nullptr;
}

/// Throws Error(Usage, name) for the first setting outside its range, whether or not it counts.
template <typename Settings>
void check_all(const ParamTable<Settings>& table, const Settings& settings) {
    for (const Param<Settings>& param : table) param.check(settings);
}

/// Adds the rows of a part to those of the struct that holds it: append(t, rows, &Whole::part).
template <typename Part, typename Whole, typename Base>
void append(ParamTable<Whole>& table, const ParamTable<Part>& part, Part Base::*member) {
    for (const Param<Part>& row : part) {
        Param<Whole> lifted;
        lifted.info = row.info;
        lifted.get = [get = row.get, member](const Whole& w) { return get(w.*member); };
        lifted.set = [set = row.set, member](Whole& w, const ParamValue& v) { set(w.*member, v); };
        if (row.unused)
            lifted.unused = [unused = row.unused, member](const Whole& w) {
                return unused(w.*member);
            };
        table.push_back(std::move(lifted));
    }
}

}  // namespace asperity

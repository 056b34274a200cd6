// SPDX-License-Identifier: Apache-2.0
// Rows made from the fields of a settings struct. The type of the field is that of the row.
#pragma once

#include <asperity/params/param.h>

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace asperity {

/// The names of an enumeration in the order of its values.
template <typename Enum, std::size_t N>
using Names = std::array<std::pair<const char*, Enum>, N>;

template <typename Enum, std::size_t N>
const char* name_of(const Names<Enum, N>& names, Enum value) {
    for (const auto& [name, named] : names)
        if (named == value) return name;
    return "";
}

namespace detail {

template <typename T>
constexpr ParamType type_of() {
    if constexpr (std::same_as<T, bool>)
        return ParamType::Flag;
    else if constexpr (std::same_as<T, int> || std::same_as<T, std::int64_t>)
        return ParamType::Integer;
    else if constexpr (std::same_as<T, std::uint64_t>)
        return ParamType::Natural;
    else if constexpr (std::same_as<T, double>)
        return ParamType::Real;
    else if constexpr (std::same_as<T, std::string>)
        return ParamType::Text;
    else {
        static_assert(std::same_as<T, std::vector<double>>, "no setting has this type");
        return ParamType::List;
    }
}

template <typename T>
ParamValue to_value(const ParamInfo& info, const T& field) {
    if constexpr (std::same_as<T, int>)
        return static_cast<std::int64_t>(field);
    else {
        if constexpr (!std::same_as<T, bool> && !std::same_as<T, std::vector<double>>)
            if (!info.absent.empty() && field == T{}) return std::monostate{};
        return field;
    }
}

template <typename T>
void from_value(const ParamInfo& info, const ParamValue& value, T& field) {
    if (std::holds_alternative<std::monostate>(value)) {
        field = T{};
    } else if constexpr (std::same_as<T, int>) {
        const std::int64_t wide = std::get<std::int64_t>(value);
        if (wide < std::numeric_limits<int>::min() || wide > std::numeric_limits<int>::max())
            refuse(info, "the number is too large");
        field = static_cast<int>(wide);
    } else {
        field = std::get<T>(value);
    }
}

template <typename Settings, typename Access>
Param<Settings> row(ParamInfo info, Access access) {
    using T = std::remove_cvref_t<decltype(access(std::declval<Settings&>()))>;
    info.type = type_of<T>();
    return {info, [=](const Settings& s) { return to_value<T>(info, access(s)); },
            [=](Settings& s, const ParamValue& v) { from_value<T>(info, v, access(s)); }};
}

template <typename Settings, typename Enum, std::size_t N, typename Access>
Param<Settings> choice_row(ParamInfo info, const Names<Enum, N>& names, Access access) {
    info.type = ParamType::Choice;
    for (const auto& [name, value] : names) info.choices.emplace_back(name);
    return {info, [=](const Settings& s) { return std::string(name_of(names, access(s))); },
            [=](Settings& s, const ParamValue& v) {
                for (const auto& [name, value] : names)
                    if (std::get<std::string>(v) == name) access(s) = value;
            }};
}

inline double to_entry(double x) {
    return x;
}
inline double to_entry(const std::optional<double>& x) {
    // NaN says that the entry is open: one that was given becomes infinite, which no range takes.
    if (x && std::isnan(*x)) return std::numeric_limits<double>::infinity();
    return x.value_or(std::numeric_limits<double>::quiet_NaN());
}
inline void from_entry(double entry, double& x) {
    x = entry;
}
inline void from_entry(double entry, std::optional<double>& x) {
    x = std::isnan(entry) ? std::nullopt : std::optional(entry);
}

}  // namespace detail

/// Rows for what access(settings) refers to, a field of a field for instance.
template <typename S, typename Access>
Param<S> field_at(Access access, ParamInfo info) {
    return detail::row<S>(std::move(info), access);
}
template <typename S, typename Access, typename Enum, std::size_t N>
Param<S> field_at(Access access, const Names<Enum, N>& names, ParamInfo info) {
    return detail::choice_row<S>(std::move(info), names, access);
}

/// A row for a field of type bool, int, std::uint64_t, double, std::string or a list of double.
/// Where `info.absent` names a word, it stands for zero or an empty text.
template <typename S, typename T>
Param<S> field(T S::*member, ParamInfo info) {
    return detail::row<S>(
        std::move(info), [member](auto& s) -> auto& { return s.*member; });
}

/// A row for a field whose values have names.
template <typename S, typename Enum, std::size_t N>
Param<S> field(Enum S::*member, const Names<Enum, N>& names, ParamInfo info) {
    return detail::choice_row<S>(
        std::move(info), names, [member](auto& s) -> auto& { return s.*member; });
}

/// A row for two numbers; std::optional ones may be left open.
template <typename S, typename T>
Param<S> pair_field(T S::*first, T S::*second, ParamInfo info) {
    info.type = ParamType::Pair;
    if constexpr (!std::same_as<T, double>) info.absent = "auto";
    return {info,
            [=](const S& s) {
                return std::vector{detail::to_entry(s.*first), detail::to_entry(s.*second)};
            },
            [=](S& s, const ParamValue& v) {
                const auto& both = std::get<std::vector<double>>(v);
                detail::from_entry(both.front(), s.*first);
                detail::from_entry(both.back(), s.*second);
            }};
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the laws check of their settings; inside this folder only.

#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>

#include <fmt/format.h>

#include <initializer_list>

namespace asperity::detail {

[[noreturn]] inline void reject(const char* setting, std::string message) {
    throw Error(ErrorCode::Usage, std::move(message), setting);
}

struct NamedList {
    const char* name;
    const std::vector<double>& values;
};

/// Settings that `kind` does not read must not be given: silence would hide a mistake.
inline void require_absent(const char* kind, std::initializer_list<NamedList> lists) {
    for (const NamedList& list : lists)
        if (!list.values.empty()) reject(list.name, fmt::format("has no meaning with {}", kind));
}

inline void require_no_material(const char* kind, const OpticsSettings& s) {
    if (!s.material.empty()) reject("material", fmt::format("has no meaning with {}", kind));
    require_absent(kind, {{"wavelengths", s.wavelengths}});
}

inline void require_range(const NamedList& list, double low, double high, bool low_included,
                          const char* words) {
    if (list.values.size() > static_cast<std::size_t>(kMaxChannels))
        reject(list.name, fmt::format("{} values given, at most {} channels are carried",
                                      list.values.size(), kMaxChannels));
    for (const double v : list.values)
        if (!(v <= high && (low_included ? v >= low : v > low)))
            reject(list.name, fmt::format("{} is not {}", v, words));
}

inline void require_f0(const OpticsSettings& s) {
    require_range({"f0", s.f0}, 0, 1, true, "within 0 .. 1");
}

/// Beyond this an index is a slip of the pen; metals in the far infrared stay below.
inline constexpr double kMaxIndex = 1000;

inline void require_ior(const OpticsSettings& s) {
    require_range({"ior", s.ior}, 0, kMaxIndex, false, "above 0 and at most 1000");
}

/// Value of channel `c`; a list of one serves all.
inline double value_of(const std::vector<double>& list, std::size_t c) {
    return list.size() == 1 ? list[0] : list[c];
}

}  // namespace asperity::detail

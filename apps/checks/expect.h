// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <string>

namespace asperity::checks {

/// "" when the value is the wanted one within `tolerance`; NaN never is.
inline std::string expect_near(const std::string& what, double value, double wanted,
                               double tolerance) {
    if (std::abs(value - wanted) <= tolerance) return {};
    return fmt::format("{} is {:.9g}, not {:.9g}", what, value, wanted);
}

/// The first that is not "", if any.
inline std::string first_of(std::initializer_list<std::string> failures) {
    for (const std::string& failure : failures) {
        if (!failure.empty()) return failure;
    }
    return {};
}

}  // namespace asperity::checks

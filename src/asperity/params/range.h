// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>

namespace asperity {

/// The numbers a setting accepts: between two ends, each of which belongs to them unless open.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false, high_open = false;

    /// False for NaN.
    bool contains(double x) const {
        return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
    }
    /// Completes "'7' ...": "must be above 0 and at most 1", "must be in 2 .. 4096".
    std::string rule() const;
    /// For a page of reference: "above 0, at most 1", "2 .. 4096"; empty when there are no ends.
    std::string text() const;
};

inline constexpr double kNoEnd = std::numeric_limits<double>::infinity();
inline constexpr Range kAnyNumber = {};
inline constexpr Range kAboveZero = {0, kNoEnd, true, false};
inline constexpr Range kNotNegative = {0, kNoEnd};
inline constexpr Range kZeroToOne = {0, 1};
/// Tilts and polar angles in degrees stop short of the horizon.
inline constexpr Range kBelowHorizon = {0, 90, false, true};

}  // namespace asperity

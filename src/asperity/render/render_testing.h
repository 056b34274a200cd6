// SPDX-License-Identifier: Apache-2.0
//
// For tests of the renderer.
#pragma once

#include <asperity/core/vec.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-12) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

}  // namespace asperity::test

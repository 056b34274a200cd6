// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace asperity {

/// A number that counts from 0, as arrays want it.
constexpr std::size_t index(int k) {
    return static_cast<std::size_t>(k);
}

}  // namespace asperity

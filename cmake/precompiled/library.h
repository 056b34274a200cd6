// SPDX-License-Identifier: Apache-2.0
// What nearly every source of the library includes, read once (ASPERITY_PRECOMPILE). Every source
// still includes what it uses: the other builds read no such file, nor does GCC for the library in
// the tests, where its warnings are errors.
#pragma once
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

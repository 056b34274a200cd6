// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace asperity::cli {

/// Takes the outcome of a check: its name, and what is wrong (empty: passed).
using CheckReport = std::function<void(const std::string& name, const std::string& failure)>;

/// The thesis' texture checks: 15 layers at 5 texture resolutions, 75 in all. Each layer of a small
/// rough surface is drawn as the thesis' R x R sky-map and its texels are counted.
void check_textures(int threads, const CheckReport& report);

/// Figures of exact shapes known by hand.
void check_surfaces(int threads, const CheckReport& report);

/// Light on exact shapes, the balance of energy, and equal results for any number of threads.
void check_light(int threads, const CheckReport& report);

}  // namespace asperity::cli

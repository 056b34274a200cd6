// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <functional>
#include <string>

namespace asperity::checks {

/// Takes the outcome of a check: its name, and what is wrong (empty: passed). Called in the order
/// of the checks, from the caller's thread.
using CheckReport = std::function<void(const std::string& name, const std::string& failure)>;

/// Checks of check_thesis().
inline constexpr int kThesisChecks = 79;

// All of them work on the threads of `run`, which shows the stages of the library, and throw
// Error(Stopped) within 100 ms once it is to be stopped: a check cut short is not reported.

/// The thesis' Run Test: check_textures() and check_models().
void check_thesis(Run& run, const CheckReport& report);

/// The thesis' texture checks: 15 layers at 5 texture resolutions, 75 in all. Each layer of a small
/// rough surface is drawn as the thesis' R x R sky-map and its texels are counted.
void check_textures(Run& run, const CheckReport& report);

/// The thesis' checks of loading models, 4 in all: the triangles and vertices of a small and of a
/// large model, written to files and read back.
void check_models(Run& run, const CheckReport& report);

/// Figures of exact shapes known by hand.
void check_surfaces(Run& run, const CheckReport& report);

/// Light on exact shapes, the balance of energy, and equal results for any number of threads.
void check_light(Run& run, const CheckReport& report);

/// Directions, shares and metals on shapes whose reflection is known by hand, on all engines and
/// launch patterns; published reflectances.
void check_reflection(Run& run, const CheckReport& report);

/// Error bars, lobes of rough surfaces, analytic models, and tables between their layers.
void check_statistics(Run& run, const CheckReport& report);

}  // namespace asperity::checks

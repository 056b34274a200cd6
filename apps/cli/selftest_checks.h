// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/error.h>

#include <functional>
#include <string>

namespace asperity::cli {

/// Takes the outcome of a check: its name, and what is wrong (empty: passed).
using CheckReport = std::function<void(const std::string& name, const std::string& failure)>;

/// Runs one check that returns what is wrong; an Error of the library is wrong, too.
template <typename Body>
void run_check(const CheckReport& report, const std::string& name, Body body) {
    std::string failure;
    try {
        failure = body();
    } catch (const Error& error) {
        failure = error.what();
    }
    report(name, failure);
}

/// The thesis' texture checks: 15 layers at 5 texture resolutions, 75 in all. Each layer of a small
/// rough surface is drawn as the thesis' R x R sky-map and its texels are counted.
void check_textures(int threads, const CheckReport& report);

/// The thesis' checks of loading models, 4 in all: the triangles and vertices of a small and of a
/// large model, written to files and read back.
void check_models(const CheckReport& report);

/// Figures of exact shapes known by hand.
void check_surfaces(int threads, const CheckReport& report);

/// Light on exact shapes, the balance of energy, and equal results for any number of threads.
void check_light(int threads, const CheckReport& report);

}  // namespace asperity::cli

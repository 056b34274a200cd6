// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "checks.h"

#include <asperity/core/error.h>

namespace asperity::checks {

/// Throws Error(Stopped) once the run is to be stopped; waits while it is paused.
inline void stop_here(const Run& run) {
    if (!run.keep_going()) throw Error(ErrorCode::Stopped, "the checks were stopped");
}

/// Runs one check that returns what is wrong; an Error of the library is wrong, too.
template <typename Body>
void run_check(const Run& run, const CheckReport& report, const std::string& name, Body body) {
    stop_here(run);
    std::string failure;
    try {
        failure = body();
    } catch (const Error& error) {
        failure = error.what();
    }
    // What a stopped check says means nothing
    stop_here(run);
    report(name, failure);
}

}  // namespace asperity::checks

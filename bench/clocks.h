// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace asperity::bench {

inline double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds this thread has spent computing.
inline double cpu_seconds() {
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

/// Seconds on the wall, from some fixed time on.
inline double wall_seconds() {
    return seconds_of(CLOCK_MONOTONIC);
}

}  // namespace asperity::bench

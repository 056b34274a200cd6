// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace asperity {

/// Calls body(k) for every k in [0, count) on up to `threads` threads and returns when all are
/// done. Where the system does not give so many, there are fewer, or the caller's alone.
///
/// Costs the making and ending of the threads, some 20 microseconds each; none outlives the call,
/// so that it may be used in forked processes and beside other users of threads. The order of the
/// calls is not defined, so a body may only write what belongs to its k. The first exception thrown
/// by a body is thrown again here; the remaining calls may be left out.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace asperity

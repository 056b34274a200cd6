// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

namespace asperity::cli {

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP asks the run to stop; a second one
/// of that kind ends the program at once. What was ignored when the program started, as under
/// nohup, stays ignored. One at a time.
class StopOnSignal {
  public:
    explicit StopOnSignal(Run& run);
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;
};

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

namespace asperity::cli {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM asks the run to stop; a second one ends the
/// program at once. One at a time.
class StopOnSignal {
  public:
    explicit StopOnSignal(Run& run);
    ~StopOnSignal();
    StopOnSignal(const StopOnSignal&) = delete;
    StopOnSignal& operator=(const StopOnSignal&) = delete;
};

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/layer_in_work.h>
#include <asperity/gonio/layer_report.h>
#include <asperity/gonio/measurement.h>

#include <algorithm>
#include <chrono>
#include <mutex>

namespace asperity {

/// All that is done so far, while other threads go on: a result as of a run stopped now, from which
/// measure() can go on. Its time is the head's.
Measurement checkpoint_of(const Measurement& head, LayersInWork& layers, LayerReport& report);

/// Tells when it is time for the next checkpoint: each period, but at most a tenth of the time goes
/// into them. From any thread; only one takes a checkpoint.
class CheckpointClock {
  public:
    explicit CheckpointClock(std::chrono::milliseconds period) : period_(period) {}

    template <class Take>
    void when_due(Take take) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        const auto begin = Clock::now();
        if (!lock || begin < next_) return;
        take();
        const auto end = Clock::now();
        next_ = end + std::max<Clock::duration>(period_, 9 * (end - begin));
    }

  private:
    using Clock = std::chrono::steady_clock;
    const Clock::duration period_;
    std::mutex mutex_;
    Clock::time_point next_ = Clock::now() + period_;
};

}  // namespace asperity

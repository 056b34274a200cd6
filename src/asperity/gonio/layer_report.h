// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace asperity {

/// The layers of a measurement that are complete, and what its listener is told of them: one layer
/// after the other, however many are under way. All functions may be called from any thread.
class LayerReport {
  public:
    LayerReport(const MeasureListener& listener, std::size_t layers)
        : listener_(listener), layers_(layers) {}

    /// Layer k has grown. If it is the one the listener sees, and it is time, asks for it as it
    /// stands; `write` returns whether there is something to show.
    void grown(std::size_t k, const std::function<bool(Layer&)>& write);
    /// Takes layer k, and tells the listener as soon as all before it are complete.
    void complete(std::size_t k, Layer layer);
    /// Copies layer k, if it is complete.
    bool copy(std::size_t k, Layer& layer);
    /// Nothing more will come: tells what is left, and hands the complete layers over in order.
    std::vector<Layer> finish();

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kShortestPause{100};
    void tell();

    const MeasureListener& listener_;
    std::mutex mutex_;
    std::vector<std::optional<Layer>> layers_;
    std::size_t told_ = 0;  ///< the listener knows all before this one
    Clock::time_point next_ = Clock::now();
};

}  // namespace asperity

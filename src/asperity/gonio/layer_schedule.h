// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace asperity {

/// Which piece of a measurement a thread does next, so that none waits for another.
///
/// Layers are traced in order, batch by batch. Each is prepared while the one before it is traced,
/// and the next one begins while the last batches of one are under way; it may be extended by more
/// batches before it is closed. All functions may be called from any thread.
class LayerSchedule {
  public:
    /// Layers begin with so many batches, each with at least one.
    explicit LayerSchedule(const std::vector<std::uint64_t>& batches);

    struct Piece {
        enum class Kind { Prepare, Trace } kind;
        std::size_t layer;
        std::uint64_t batch;  ///< to be traced, counted from 0 in the order they are begun
    };
    /// What to do now; waits while nothing can be begun, but something may become possible.
    /// Nothing: all layers are closed, or somebody has given up. The caller does the piece, and
    /// says so.
    std::optional<Piece> next();
    void prepared(std::size_t layer);
    /// True if no batch of the layer is left or under way: the caller extends or closes it.
    bool traced(std::size_t layer);
    void extend(std::size_t layer, std::uint64_t batches);
    void close();
    /// From now on there is nothing to do.
    void give_up();
    /// Gives up at its end, so that nobody waits for a thread that has left, by whichever way.
    struct Leave {
        LayerSchedule& schedule;
        ~Leave() { schedule.give_up(); }
    };

  private:
    struct Layer {
        std::uint64_t planned = 0, begun = 0, traced = 0;  ///< batches
        bool prepared = false;
    };
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Layer> layers_;
    std::size_t current_ = 0;  ///< no layer before it has a batch to begin
    std::size_t begun_ = 0;    ///< layers whose preparation has begun
    std::size_t open_;         ///< layers that are not closed
    bool given_up_ = false;
};

}  // namespace asperity

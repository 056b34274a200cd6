// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/layer_schedule.h>

#include <algorithm>

namespace asperity {

LayerSchedule::LayerSchedule(const std::vector<std::uint64_t>& batches) : open_(batches.size()) {
    for (const std::uint64_t planned : batches) layers_.push_back({planned, 0, 0, false});
}

std::optional<LayerSchedule::Piece> LayerSchedule::next() {
    std::unique_lock lock(mutex_);
    for (; !given_up_ && open_ > 0; changed_.wait(lock)) {
        while (current_ < layers_.size() && layers_[current_].begun == layers_[current_].planned)
            ++current_;
        // The layer to be traced, and the one after it
        if (begun_ < std::min(current_ + 2, layers_.size()))
            return Piece{Piece::Kind::Prepare, begun_++, 0};
        if (current_ < layers_.size() && layers_[current_].prepared)
            return Piece{Piece::Kind::Trace, current_, layers_[current_].begun++};
    }
    return {};
}

void LayerSchedule::prepared(std::size_t layer) {
    const std::scoped_lock lock(mutex_);
    layers_[layer].prepared = true;
    changed_.notify_all();
}

bool LayerSchedule::traced(std::size_t layer) {
    const std::scoped_lock lock(mutex_);
    return ++layers_[layer].traced == layers_[layer].planned;
}

void LayerSchedule::extend(std::size_t layer, std::uint64_t batches) {
    const std::scoped_lock lock(mutex_);
    layers_[layer].planned += batches;
    current_ = std::min(current_, layer);
    changed_.notify_all();
}

void LayerSchedule::close() {
    const std::scoped_lock lock(mutex_);
    --open_;
    if (open_ == 0) changed_.notify_all();
}

void LayerSchedule::give_up() {
    const std::scoped_lock lock(mutex_);
    given_up_ = true;
    changed_.notify_all();
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/layer_report.h>

#include <algorithm>
#include <utility>

namespace asperity {

void LayerReport::grown(std::size_t k, const std::function<bool(Layer&)>& write) {
    if (!listener_.layer) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const auto begin = Clock::now();
    if (!lock || k != told_ || layers_[k] || begin < next_) return;
    Layer layer;
    if (!write(layer)) return;
    listener_.layer(layer, false);
    const auto end = Clock::now();
    next_ = std::max(begin + kShortestPause, end + 9 * (end - begin));
}

void LayerReport::complete(std::size_t k, Layer layer) {
    const std::scoped_lock lock(mutex_);
    layers_[k] = std::move(layer);
    while (told_ < layers_.size() && layers_[told_]) tell();
}

bool LayerReport::copy(std::size_t k, Layer& layer) {
    const std::scoped_lock lock(mutex_);
    if (!layers_[k]) return false;
    layer = *layers_[k];
    return true;
}

std::vector<Layer> LayerReport::finish() {
    const std::scoped_lock lock(mutex_);
    while (told_ < layers_.size()) tell();
    std::vector<Layer> complete;
    for (std::optional<Layer>& layer : layers_)
        if (layer) complete.push_back(std::move(*layer));
    return complete;
}

void LayerReport::tell() {
    if (listener_.layer && layers_[told_]) listener_.layer(*layers_[told_], true);
    ++told_;
}

}  // namespace asperity

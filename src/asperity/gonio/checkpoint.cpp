// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/checkpoint.h>

#include <utility>

namespace asperity {

Measurement checkpoint_of(const Measurement& head, LayersInWork& layers, LayerReport& report) {
    Measurement so_far = head;
    so_far.stopped = true;
    so_far.notes.emplace_back("a checkpoint: the run was not complete");
    for (std::size_t k = 0; k < layers.size(); ++k)
        // A layer that is closed between both is seen by the second
        if (Layer layer; layers[k].write(layer, 1) || report.copy(k, layer))
            so_far.layers.push_back(std::move(layer));
    return so_far;
}

}  // namespace asperity

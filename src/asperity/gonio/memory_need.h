// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>

#include <cstdint>

namespace asperity {

/// Bytes that measure() needs at least beside the surface itself: the engine's copy of it or, of
/// several surfaces, all that are kept (SurfaceClass) with theirs, every layer with what its errors
/// come from, and the sums of one layer in work. The peak is some tens of MB and a few MB a thread
/// more.
std::uint64_t memory_needed(const Heightfield& surface, const Experiment& experiment);

/// Throws Error(OutOfMemory, "the measurement") with both figures where that is not to be had.
void require_memory_for(const Heightfield& surface, const Experiment& experiment);

}  // namespace asperity

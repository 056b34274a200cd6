// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

#include <functional>

namespace asperity {

/// Hears of a measurement while it is made. Called from threads of the task, never from two at
/// once; what it is given lives as long as the call. The task waits for it.
struct MeasureListener {
    /// Everything but the layers, before the first ray.
    std::function<void(const Measurement& head)> begun;
    /// A layer as it stands. While it grows, from two batches on and at most ten times a second,
    /// rarer if showing it would cost more than a tenth of a thread; and once, `complete`, as the
    /// result will hold it. A layer that ends before its time, stopped, is complete, too.
    std::function<void(const Layer& layer, bool complete)> layer;
};

/// THE algorithm: shoots parallel light at `surface` for every incident direction of the
/// experiment, follows it from facet to facet, and sorts what leaves by direction.
///
/// Same surface and experiment give the same bits for any number of threads. experiment.surface is
/// only recorded. Layers are filled from normal incidence down (thesis: from 15 to 1).
///
/// With run.until > 0 batches are added to a layer until the relative standard error of its albedo
/// is below it, and that of every cell among those which, strongest first, carry 90 % of its energy
/// is below run.until_cells; or until run.max_rays is reached, which `notes` says.
///
/// Stages: "preparing" the tracer, in cells, and "tracing", in rays. When run.stop_requested(),
/// returns within 100 ms with `stopped` set and the whole batches done so far; pauses when asked
/// to. Throws Error(Usage, "name of the setting"). Errors are estimated from independent batches.
/// Source: docs/theory.md, "Measurement".
Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run,
                    const MeasureListener& listener = {});

}  // namespace asperity

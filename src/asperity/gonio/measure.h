// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

#include <chrono>
#include <functional>
#include <optional>

namespace asperity {

/// Hears of a measurement while it is made. Called from threads of the task, never from two at
/// once; what it is given lives as long as the call. The task waits for it.
struct MeasureListener {
    /// Everything but the layers, before the first ray.
    std::function<void(const Measurement& head)> begun = {};
    /// A layer as it stands. While it grows, from two batches on and at most ten times a second,
    /// rarer if showing it would cost more than a tenth of a thread; and once, `complete`, as the
    /// result will hold it. A layer that ends before its time, stopped, is complete, too.
    std::function<void(const Layer& layer, bool complete)> layer = {};
    /// All batches done so far, from which `measure` can go on: each `checkpoint_period`, rarer if
    /// taking it would cost more than a tenth of the time. The layers of it may hold one batch.
    std::function<void(const Measurement& so_far)> checkpoint = {};
    std::chrono::milliseconds checkpoint_period = std::chrono::seconds(30);
};

/// Which batches of an experiment are to be done: all of them, unless it says otherwise.
struct MeasureScope {
    /// A result of the same experiment, whole or in part: the batches it holds are not done again.
    /// The asked accuracy (run.until, run.max_rays) may differ, if it is not looser.
    std::optional<Measurement> so_far = {};
    /// Share number `part` of `parts`, from 1 on, of the batches of the first round that is not
    /// complete: `merge` (gonio/merge.h) adds them up. A share may be nothing.
    int part = 1, parts = 1;
    /// The result is to hold the new batches alone, so that those of many parts can be added to one
    /// `so_far` that all of them have; a share is one of those that are missing.
    bool leave_out_so_far = false;
};

/// THE algorithm: shoots parallel light at `surface` for every incident direction of the
/// experiment, follows it from facet to facet, and sorts what leaves by direction.
///
/// Same surface and experiment give the same bits for any number of threads. experiment.surface is
/// only recorded, and the digest of `surface` with it. Layers are filled from normal incidence down
/// (thesis: from 15 to 1).
///
/// With run.until > 0 batches are added to a layer until the relative standard error of its albedo
/// is below it, and that of every cell among those which, strongest first, carry 90 % of its energy
/// is below run.until_cells; or until run.max_rays is reached, which `notes` says.
///
/// With run.surfaces other than 1 the layers are means over surfaces_of(run, cells) surfaces, of
/// which `surface` is the first and experiment.surface makes the others, as surfaces_of() says:
/// each batch has a surface of its own, so `Layer::batches` says how many there are, and
/// shares_of_rays() (gonio/noise_shares.h) what of the errors is the rays'. Surfaces are made while
/// others are traced, a few milliseconds each of 512 x 512 samples. Throws Error(Usage, "surfaces")
/// for a `surface` that is not what experiment.surface makes.
///
/// Stages: "preparing" the tracer, in cells, and "tracing", in rays. When run.stop_requested(),
/// returns within 100 ms with `stopped` set and the whole batches done so far; pauses when asked
/// to. However it is divided, by stops or by `scope`, what comes out in the end is the same, to the
/// bit. Throws Error(Usage, "name of the setting"), and Error(InvalidInput, "result") for one that
/// it cannot go on from. Errors are estimated from independent batches.
/// Source: docs/theory.md, "Measurement".
Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run,
                    const MeasureListener& listener = {}, MeasureScope scope = {});

}  // namespace asperity

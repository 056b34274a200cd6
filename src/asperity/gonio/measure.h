// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

namespace asperity {

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
/// When run.stop_requested(), returns within 100 ms with `stopped` set and the whole batches done
/// so far. Throws Error(Usage, "name of the setting"). Errors are estimated from independent
/// batches. Source: docs/theory.md, "Measurement".
Measurement measure(const Heightfield& surface, const Experiment& experiment, Run& run);

}  // namespace asperity

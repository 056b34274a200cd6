// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

#include <string>
#include <vector>

namespace asperity {

/// All of a Measurement but its layers and the surface's statistics.
Measurement head_of(const Heightfield& surface, const Experiment& experiment, const Run& run);

/// A sentence where the surface's lobes, of which `head.surface` knows the slopes, are told by too
/// few cells: fewer than eight in light from above, and some layer's is narrower than a cell across
/// the plane of incidence; else empty. `theta_i` [rad] of the layers. Quiet for level surfaces,
/// whose light stays in one cell anyway.
std::string narrow_lobes(const Measurement& head, const std::vector<double>& theta_i);
/// Of a measurement's own layers, whichever version made it.
std::string narrow_lobes(const Measurement& measurement);

/// Throws Error(Usage, "part") for a part that is none of 1/N to N/N.
void check(const MeasureScope& scope);

/// Which part it is of, and what of an earlier result goes into it. Throws as
/// require_same_experiment for a result of another experiment.
void note_scope(Measurement& head, const MeasureScope& scope);

/// Refuses to go on from `so_far` with this experiment, or to add the layers of both. `until` and
/// `max_rays` may differ: they decide how many batches there are, not what is in one. Throws
/// Error(InvalidInput, `where`) that names what differs.
void require_same_experiment(const Measurement& so_far, const Measurement& head,
                             const std::string& where);

}  // namespace asperity

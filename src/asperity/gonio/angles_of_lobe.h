// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity {

/// Incident polar angles [degrees], rising from 0, for a table to be read between them: at most 10
/// degrees apart, closer on steep surfaces and where the reflectance of the facets changes fast,
/// and ever closer towards the horizon, until the surface's shadows no longer change. 17 for
/// mirrors of alpha 0.1 to 0.6. docs/theory.md, "Layers set by the lobe", has the rule.
///
/// `rms_gradient` is that of the facets (Sdq, Beckmann's alpha), >= 0. Throws Error(Usage) as
/// Fresnel does.
std::vector<double> angles_of_lobe(double rms_gradient, const OpticsSettings& optics);

/// The experiment as it will be measured: where its layers are left to the lobe
/// (IlluminationSettings::layers 0, no theta_deg) with the angles for this surface in theta_deg;
/// else as it is. Throws Error(Usage) as Fresnel does, Error(Stopped) when the run is to be
/// stopped.
Experiment with_angles(const Heightfield& surface, const Experiment& experiment, const Run& run);

}  // namespace asperity

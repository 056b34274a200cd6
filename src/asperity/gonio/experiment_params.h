// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/experiment.h>
#include <asperity/params/param.h>

namespace asperity {

ParamTable<IlluminationSettings> illumination_params();
ParamTable<DetectorSettings> detector_params();
ParamTable<RunSettings> run_params();

/// Every setting of an experiment, in the order of files.
ParamTable<Experiment> experiment_params();

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_options.h"

#include <asperity/core/run.h>
#include <asperity/render/scene.h>

namespace asperity::cli {

/// The materials assigned to the model, and where they come from.
struct Materials {
    Material left;
    std::optional<SplitView> split;
    Material stage;
    /// Per BRDF from a file: the experiment it was measured in, for provenance.
    io::Provenance origin;
};

/// Refuses, before anything is read, what cannot be assigned.
void check_materials(const RenderOptions& options);

/// Reads results, makes them ready to be shaded with, and parses models. Throws Error(Usage,
/// option), Error(Stopped), and what load_measurement throws.
Materials load_materials(const RenderOptions& options, Run& run);

}  // namespace asperity::cli

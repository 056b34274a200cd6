// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_options.h"

#include <asperity/render/light.h>

#include <memory>
#include <vector>

namespace asperity::cli {

/// The lights the options ask for; an option of lights that are not there is refused. Throws
/// Error(Usage, option), and what reading an environment map throws.
std::vector<std::shared_ptr<const Light>> load_lights(const RenderOptions& options);

/// Refuses, before anything is read, lights that there are not and options that fit none of them.
void check_lights(const RenderOptions& options);

}  // namespace asperity::cli

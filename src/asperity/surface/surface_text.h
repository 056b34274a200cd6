// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/surface_settings.h>

#include <string>

namespace asperity {

/// Reads a surface into the settings: a kind ("gaussian"), a kind with settings
/// ("gaussian:alpha=0.3/0.1,size=256", lists within joined by '/'), or a file: a name with a '.' or
/// a '/', a name that exists, or "file:" and any name. Settings it does not name stay.
///
/// Throws Error(Usage) for a text that is none of these, and for a setting that the kind does not
/// use; nothing is changed then.
void apply_surface_spec(SurfaceSettings& surface, const std::string& spec);

/// The kind, or the file's name so that apply_surface_spec takes it for a file.
std::string surface_text(const SurfaceSettings& surface);

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/setting_value.h>
#include <asperity/surface/surface_settings.h>

#include <string>

namespace asperity::io {

/// Reads the value of the setting "surface": a kind ("gaussian"), a kind with settings
/// ("gaussian:alpha=0.3/0.1,size=256", lists within joined by '/'), or a file: a name with a '.' or
/// a '/', a name that exists, or "file:" and any name. Throws Error(Usage).
void set_surface(SurfaceSettings& surface, const SettingValue& value);

/// The kind, or the file's name so that set_surface takes it for a file.
std::string surface_text(const SurfaceSettings& surface);

}  // namespace asperity::io

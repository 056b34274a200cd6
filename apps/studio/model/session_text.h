// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <string>
#include <string_view>

namespace asperity::studio {

/// A session as text: the experiment as `asperity simulate --config` reads it, then a section
/// [studio] with keys of its own, which other programs skip.
std::string session_text(const StudioSettings& settings);

/// Throws Error(InvalidInput, "name:line") for unknown keys and values that do not fit; a text
/// without the section, such as the CLI's config files, leaves the rest as by default.
StudioSettings session_from_text(std::string_view text, const std::string& name);

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What BSDF XML files of WINDOW and Radiance have in common; inside this folder only.

#include <asperity/formats/bsdfs/export_source.h>

#include <string>

namespace asperity::io {

/// The file up to its DataDefinition, the provenance in a comment.
std::string window_opening(const ExportSource& source);
/// What closes it.
std::string window_closing();

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

// What BSDF XML files of WINDOW and Radiance have in common; inside this folder only.

#include <asperity/formats/bsdfs/export_source.h>

#include <pugixml.hpp>

#include <string>

namespace asperity::io {

/// The file up to its DataDefinition, the provenance in a comment.
std::string window_opening(const ExportSource& source);
/// What closes it.
std::string window_closing();

/// The element Layer of such a file, which lives as long as `document`. Throws
/// Error(InvalidInput, path), Error(InputOutput, path).
pugi::xml_node read_window_layer(const std::string& path, pugi::xml_document& document);
/// The text of its Visible data of Reflection Back. Throws Error(InvalidInput, path) if there are
/// none.
const char* visible_reflection(pugi::xml_node layer, const std::string& path);

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/bsdfs/format_options.h>

#include <string>
#include <vector>

namespace asperity::io {

/// Writes scenes that show a sphere of an exported file, beside it and by its name: for "rgl" one
/// of Mitsuba (NAME_mitsuba.xml) and a Python script that renders it (NAME_mitsuba.py), or,
/// spectral, also one of pbrt (NAME_pbrt.pbrt); for "klems" and "tensortree" materials of Radiance
/// (NAME_radiance.rad). Returns their paths. Throws Error(Usage, "snippet") for other formats,
/// Error(InputOutput, path).
std::vector<std::string> write_snippets(const std::string& format, const FormatOptions& options,
                                        const std::string& path);

/// Throws Error(Usage, "snippet") for a format without any.
void require_snippets(const std::string& format);

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/film.h>
#include <asperity/render/tonemap.h>

#include <string>
#include <utility>
#include <vector>

namespace asperity::io {

/// Where a picture comes from: names as the long options of the command line, and their values, in
/// order; and what came out (samples, noise, version). Enough to make the picture again.
using Provenance = std::vector<std::pair<std::string, std::string>>;

// Files appear whole or not at all (AtomicFile). Throw Error(InputOutput, path).

/// Linear radiance as floats: R, G, B, and `stderr.Y`, the standard error of the luminance; ZIP.
/// Provenance as string attributes "asperity:NAME", the seed and samples among them.
void write_render_exr(const Film& film, const Provenance& provenance, const std::string& path);

/// 8-bit PNG through the tone mapping, with an sRGB chunk, or gAMA when the transfer is another.
/// Provenance as text chunks "asperity:NAME".
void write_render_png(const Film& film, const ToneMapping& mapping, const Provenance& provenance,
                      const std::string& path);

}  // namespace asperity::io

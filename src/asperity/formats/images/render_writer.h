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

/// The same under the names they have in files: "asperity:NAME"; a name that comes again, such as
/// that of an option given twice, is "asperity:NAME.2", "asperity:NAME.3", ...
Provenance labelled(const Provenance& provenance);

// Files appear whole or not at all (AtomicFile). Throw Error(InputOutput, path).

/// Linear radiance as floats: R, G, B, and `stderr.Y`, the standard error of the luminance; ZIP.
/// Provenance as string attributes, see labelled().
void write_render_exr(const Film& film, const Provenance& provenance, const std::string& path);

/// 8-bit PNG through the tone mapping, with an sRGB chunk, or gAMA when the transfer is another.
/// Provenance as text chunks, see labelled(); names of at most 79 bytes.
void write_render_png(const Film& film, const ToneMapping& mapping, const Provenance& provenance,
                      const std::string& path);

}  // namespace asperity::io

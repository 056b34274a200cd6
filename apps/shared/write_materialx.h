// SPDX-License-Identifier: Apache-2.0
// For the command line and the studio: formats know nothing of fits, nor fits of formats.
#pragma once

#include <asperity/bsdf/spec.h>
#include <asperity/fit/fit.h>
#include <asperity/formats/bsdfs/bsdf_format.h>

#include <string>

namespace asperity {

/// A MaterialX file of a fit of ggx. Throws Error(Usage, "format") for other fits, and what
/// writing throws.
inline void write_materialx(const Fit& fit, const std::string& path) {
    const io::ExportSource source(parse_brdf_spec(fit.spec), Experiment{}, 1);
    const io::BsdfFormats formats;
    formats.find("materialx")->write(source, io::FormatOptions({}, ""), path);
}

}  // namespace asperity

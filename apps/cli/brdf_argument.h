// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/formats/bsdfs/bsdf_format.h>

#include <memory>
#include <string>

namespace asperity::cli {

/// A BRDF given on the command line as a model, as "file:NAME" or as the name of a file in one of
/// `formats`; null for anything else, a result of ours included. Throws what reading throws.
std::unique_ptr<Bsdf> open_brdf(const std::string& text, const io::BsdfFormats& formats);

/// Refuses a name of which open_brdf would give null and under which there is no file either.
/// Throws Error(InputOutput, text).
void check_brdf_exists(const std::string& text);

}  // namespace asperity::cli

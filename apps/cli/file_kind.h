// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measurement.h>

#include <string>

namespace asperity::cli {

/// What a file can be taken for by its first bytes.
enum class FileKind { Unknown, Result, Heights, Bsdf, Picture, Screen, Model };

/// Refuses a file that is there but of another kind than the one a verb or option takes, and says
/// where it belongs; and one that is not there, naming its like. A file of unknown kind passes:
/// its reader says more. Throws Error(InvalidInput, path), Error(InputOutput, path).
void require_kind(const std::string& path, FileKind wanted);

/// Refuses a file of any of those kinds where `wanted`, another one, is to be read.
void refuse_known_kind(const std::string& path, const std::string& wanted, const std::string& cure);

/// "; did you mean FILE?" for one in the same folder whose name is nearly this, or nothing.
std::string did_you_mean_file(const std::string& path);

/// A result of asperity simulate. Throws what require_kind and io::load_measurement throw.
Measurement load_result(const std::string& path);
/// The same without its cells: io::load_head.
io::ResultHead load_result_head(const std::string& path);
/// The same to make a table of: io::load_lobes.
io::ResultHead load_result_lobes(const std::string& path);

}  // namespace asperity::cli

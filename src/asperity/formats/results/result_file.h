// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <string>

namespace asperity::io {

/// Version of the result format (docs/formats.md). Readers refuse a higher one.
inline constexpr int kResultFormat = 2;

/// Writes a result file (tensor container, docs/formats.md): to a temporary name beside `path`,
/// synced, renamed over it; on any failure `path` is as it was and no temporary file is left.
/// Returns checksum(measurement). Throws Error(InputOutput).
std::string save_measurement(const Measurement& measurement, const std::string& path);

/// Reads a result file whole. A damaged, cut or foreign file is refused with file, offset and
/// reason: Error(InvalidInput), Error(InputOutput).
Measurement load_measurement(const std::string& path);

/// True when the file starts like a tensor container; false for anything else, unreadable included.
bool looks_like_result(const std::string& path);

/// 32 hexadecimal digits over everything that must not depend on threads or time: experiment,
/// surface, layers. Equal experiments give equal checksums on any number of threads, and the same
/// in every format: what later formats add to the file follows from these, or is how they came
/// about.
std::string checksum(const Measurement& measurement);

}  // namespace asperity::io

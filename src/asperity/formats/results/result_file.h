// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <string>

namespace asperity::io {

/// Version of the result format (docs/formats.md). Readers refuse a higher one.
inline constexpr int kResultFormat = 4;

/// Writes a result file (tensor container, docs/formats.md): to a temporary name beside `path`,
/// synced, renamed over it; on any failure `path` is as it was and no temporary file is left.
/// Returns checksum(measurement). Throws Error(InputOutput).
std::string save_measurement(const Measurement& measurement, const std::string& path);

/// Reads a result file whole. A damaged, cut or foreign file is refused with file, offset and
/// reason: Error(InvalidInput), Error(InputOutput).
Measurement load_measurement(const std::string& path);

/// A result without its cells: experiment, surface, and all that layers hold as a whole.
struct ResultHead {
    Measurement measurement;  ///< arrays over cells, and LayerSpread, may be empty
    std::string checksum;     ///< of the whole result, see checksum()
};
/// Reads no more than that where it can. Every byte of the file is compared with its checksum all
/// the same, so a damaged file is refused as by load_measurement(); whether what is packed in it
/// makes the whole result is not looked at. Of several surfaces LayerSpread::cell_noise tells the
/// shares of their noise. Read whole are files of several surfaces of format 3, which did not have
/// that, and those of formats before, whose table of checksums does not cover the file.
ResultHead load_head(const std::string& path);

/// All that a table of the lobes is made of, errors of cells included: reads what
/// load_measurement() does, and refuses what it refuses, but leaves out what errors of several
/// cells come from (CellErrors) where it can.
ResultHead load_lobes(const std::string& path);

/// True when the file starts like a tensor container; false for anything else, unreadable included.
bool looks_like_result(const std::string& path);

/// 32 hexadecimal digits over everything that must not depend on threads or time: experiment,
/// surface, layers. Equal experiments give equal checksums on any number of threads, and the same
/// in every format: what later formats add to the file follows from these, or is how they came
/// about.
std::string checksum(const Measurement& measurement);

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <string>

namespace asperity::io {

/// Writes all layers as a multi-part EXR, one part per incidence, docs/formats.md: channels of f in
/// 1/sr, `stderr.*`, `energy.*` (fractions of the launched energy; a part sums to its albedo) and
/// `bounceK.*` (f of order K; the last holds all higher orders); row 0 = theta_o 0, column 0 =
/// phi_o 0. Throws Error(InputOutput, path); Error(Usage, path) when there is no layer.
void write_layers_exr(const Measurement& measurement, const std::string& path,
                      const Run* until = nullptr);

}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asperity {

/// Version of the library and programs; the format of result files has its own (docs/formats.md).
inline constexpr const char* kVersion = "0.1.0";

}  // namespace asperity

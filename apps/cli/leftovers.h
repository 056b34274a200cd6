// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace asperity::cli {

/// After parsing: refuses a missing verb, and the words that neither the program nor the verb took,
/// each with what was probably meant. Throws Error(Usage).
void refuse_leftovers(const CLI::App& program);

}  // namespace asperity::cli

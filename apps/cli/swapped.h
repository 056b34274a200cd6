// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/error.h>

#include <CLI/CLI.hpp>

#include <string>

namespace asperity::cli {

/// The symbol of a material by that or by its name, in letters of any size; empty for none.
std::string material_called(const std::string& word);

/// The error with its cure where a verb was given a name that belongs elsewhere: a material for a
/// law of reflection, a surface for a file, a number for a name. Otherwise as it is.
Error with_cure_of_swap(const CLI::App& verb, const Error& error);

}  // namespace asperity::cli

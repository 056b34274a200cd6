// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engine.h>

#include <memory>

namespace asperity {

/// Heightfields, thousands of paths side by side in single precision: sweeps along lines of light,
/// horizons, and facets whose single scattering is known exactly. docs/performance.md explains it.
std::unique_ptr<Engine> make_wide_engine(const EngineSetup& setup, Run& run);

}  // namespace asperity

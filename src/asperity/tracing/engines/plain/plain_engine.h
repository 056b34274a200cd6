// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engine.h>

#include <memory>

namespace asperity {

/// The algorithm of docs/theory.md as it is written there: one ray after the other, in double
/// precision, followed by the plain Tracer from facet to facet until it leaves. Knows no shortcut,
/// so it judges engines that do; some ten times slower than the wide one.
std::unique_ptr<Engine> make_plain_engine(const EngineSetup& setup, Run& run);

}  // namespace asperity

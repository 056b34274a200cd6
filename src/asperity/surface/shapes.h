// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

namespace asperity {

/// The exact shapes: flat, tilted, vgroove, sawtooth, pyramids, sinusoid, eggcrate. Every one is a
/// profile along x plus a profile along y.
///
/// tan(t) is the slope of a facet of tilt_deg, P the period in samples, d(i) = min(i mod P, P - i
/// mod P) the distance to the nearest valley; heights are in units of dx.
/// - vgroove: tan(t) d(i): valleys at i = 0, P, ..., ridges half way.
/// - sawtooth: tan(t) (i mod P): P - 1 cells rise, the last one falls back; tilted: P = size, so
/// that
///   a finite patch of it is one plane.
/// - pyramids: tan(t) / sqrt2 (d(i) + d(j)): slopes (+-s, +-s), gradient s sqrt2 = tan(t).
/// - sinusoid, eggcrate: as SurfaceKind says.
/// Writes heights of nx x ny samples; advances `run` by ny; throws Error(Stopped).
void fill_shape(Heightfield& surface, const SurfaceSettings& settings, Run& run);

}  // namespace asperity

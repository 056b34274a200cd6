// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

namespace asperity::io {

/// The patch and its mirror images in x, in y and in both, as one periodic surface of
/// (2 nx - 2) x (2 ny - 2) samples.
///
/// Samples 0, 1 .. n-1 are followed by n-2 .. 1, and then by 0 again: the first and the last row
/// and column are the mirrors and stand once. Repeating them (2 n samples) would add a strip of
/// flat cells along each mirror. So every cell of the patch appears four times and no other does;
/// its diagonal is not mirrored, as a surface has one diagonal throughout. Throws
/// Error(InvalidInput) when a side grows beyond kMaxSurfaceSide.
Heightfield mirrored(const Heightfield& patch);

/// Whether the surface may repeat as it is: the step from the last column to the first is no larger
/// (RMS over the rows, with a tenth to spare) than the largest step between neighbouring columns,
/// and likewise for the rows. A surface that repeats, or is rough from sample to sample, fits; a
/// measured patch of smooth hills or on a slant does not.
bool edges_fit(const Heightfield& surface);

}  // namespace asperity::io

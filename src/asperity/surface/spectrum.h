// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <complex>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace asperity {

/// A real periodic grid of at least 2 x 2 values whose Fourier transform is computed in place:
/// values[j * nx + i].
struct PeriodicGrid {
    int nx = 0, ny = 0;
    std::vector<float>& values;  ///< nx * ny
};

/// Makes or changes one column of a half spectrum: column[ky] for 0 <= ky < ny is the coefficient
/// of exp(2 pi i (kx x / nx + ky y / ny)); ky > ny / 2 stands for the negative ky - ny.
///
/// Called for kx = 0 .. nx / 2, from several threads, in no order. The columns kx = 0 and, for even
/// nx, kx = nx / 2 belong to a real field: column[ny - ky] = conj(column[ky]) must hold there.
using SpectrumColumn = std::function<void(int kx, std::span<std::complex<float>> column)>;

/// values = sum over (kx, ky) of coefficient * exp(2 pi i (kx x / nx + ky y / ny)), the
/// coefficients of the half spectrum kx <= nx / 2 given by `make` and the others by symmetry.
///
/// In place: besides the grid, each thread needs a buffer of 9 columns. Any size works, sizes with
/// small prime factors are fast (a prime n costs n operations per value). Same bits for any number
/// of threads. Advances `run` by transform_steps(); throws Error(Stopped).
void synthesize(PeriodicGrid grid, const SpectrumColumn& make, Run& run);

/// Multiplies the spectrum of `grid` by a filter: transforms, calls `change` for each column of the
/// unscaled coefficients (nx * ny times those of synthesize), and transforms back.
///
/// Memory, threads and errors as for synthesize(); advances `run` by ny more.
void filter_spectrum(PeriodicGrid grid, const SpectrumColumn& change, Run& run);

/// Steps synthesize() advances its run by: one a column, one a row.
inline std::uint64_t transform_steps(int nx, int ny) {
    return static_cast<std::uint64_t>(nx / 2 + 1) + static_cast<std::uint64_t>(ny);
}

}  // namespace asperity

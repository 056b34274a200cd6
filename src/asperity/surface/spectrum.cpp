// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/spectrum.h>

#include <asperity/surface/blocks.h>

#include <unsupported/Eigen/FFT>

namespace asperity {

namespace {

using Complex = std::complex<float>;
using Fft = Eigen::FFT<float>;

constexpr int kColumnsPerBlock = 8;  // of 8 bytes: one cache line of every row

/// A transform of its own for each block of work: plans hold scratch memory, so threads cannot
/// share.
Fft make_fft() {
    Fft fft;
    fft.SetFlag(Fft::Unscaled);
    fft.SetFlag(Fft::HalfSpectrum);
    return fft;
}

/// The half spectrum of one real row of n values, packed into the n floats of that row.
///
/// Coefficient 0 is real and so is, for even n, coefficient n / 2: without their imaginary parts
/// the n / 2 + 1 coefficients need exactly n floats. Even n: Re 0, Re n/2, Re 1, Im 1, ...; odd n:
/// Re 0, Re 1, Im 1, ...
class PackedRow {
  public:
    PackedRow(float* values, int n) : values_(values), n_(n) {}

    Complex get(int k) const {
        if (k == 0) return {values_[0], 0.0F};
        if (2 * k == n_) return {values_[1], 0.0F};
        return {values_[place(k)], values_[place(k) + 1]};
    }

    void set(int k, Complex c) {
        if (k == 0) {
            values_[0] = c.real();
        } else if (2 * k == n_) {
            values_[1] = c.real();
        } else {
            values_[place(k)] = c.real();
            values_[place(k) + 1] = c.imag();
        }
    }

  private:
    int place(int k) const { return n_ % 2 == 0 ? 2 * k : 2 * k - 1; }

    float* values_;
    int n_;
};

float* row_of(PeriodicGrid grid, int j) {
    return grid.values.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.nx);
}

void transform_rows(PeriodicGrid grid, bool forward, Run& run) {
    const auto nx = static_cast<std::size_t>(grid.nx);
    for_blocks(grid.ny, kRowsPerBlock, run, [&](int first, int last) {
        Fft fft = make_fft();
        std::vector<Complex> half(nx / 2 + 1);
        std::vector<float> real(nx);
        for (int j = first; j < last; ++j) {
            float* row = row_of(grid, j);
            PackedRow packed(row, grid.nx);
            if (forward) {
                std::copy(row, row + nx, real.begin());
                fft.fwd(half.data(), real.data(), grid.nx);
                for (int k = 0; k <= grid.nx / 2; ++k)
                    packed.set(k, half[static_cast<std::size_t>(k)]);
            } else {
                for (int k = 0; k <= grid.nx / 2; ++k)
                    half[static_cast<std::size_t>(k)] = packed.get(k);
                fft.inv(real.data(), half.data(), grid.nx);
                std::copy(real.begin(), real.end(), row);
            }
        }
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

/// Visits the columns of the half spectrum: forward transform when `transform_first`, then
/// `change`, then back. A block of columns is gathered, so that memory is read a cache line at a
/// time.
void change_columns(PeriodicGrid grid, bool transform_first, const SpectrumColumn& change,
                    Run& run) {
    const auto ny = static_cast<std::size_t>(grid.ny);
    for_blocks(grid.nx / 2 + 1, kColumnsPerBlock, run, [&](int first, int last) {
        Fft fft = make_fft();
        std::vector<std::vector<Complex>> columns(static_cast<std::size_t>(last - first),
                                                  std::vector<Complex>(ny));
        std::vector<Complex> scratch(ny);
        // Gather
        for (int j = 0; transform_first && j < grid.ny; ++j) {
            const PackedRow row(row_of(grid, j), grid.nx);
            for (std::size_t c = 0; c < columns.size(); ++c)
                columns[c][static_cast<std::size_t>(j)] = row.get(first + static_cast<int>(c));
        }
        // Transform, change, transform back
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (transform_first) {
                fft.fwd(scratch.data(), columns[c].data(), grid.ny);
                columns[c].swap(scratch);
            }
            change(first + static_cast<int>(c), columns[c]);
            fft.inv(scratch.data(), columns[c].data(), grid.ny);
            columns[c].swap(scratch);
        }
        // Scatter
        for (int j = 0; j < grid.ny; ++j) {
            PackedRow row(row_of(grid, j), grid.nx);
            for (std::size_t c = 0; c < columns.size(); ++c)
                row.set(first + static_cast<int>(c), columns[c][static_cast<std::size_t>(j)]);
        }
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

}  // namespace

void synthesize(PeriodicGrid grid, const SpectrumColumn& make, Run& run) {
    change_columns(grid, false, make, run);
    transform_rows(grid, false, run);
}

void filter_spectrum(PeriodicGrid grid, const SpectrumColumn& change, Run& run) {
    transform_rows(grid, true, run);
    change_columns(grid, true, change, run);
    transform_rows(grid, false, run);
}

}  // namespace asperity

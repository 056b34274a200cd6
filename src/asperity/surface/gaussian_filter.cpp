// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/gaussian_filter.h>

#include <asperity/surface/blocks.h>

#include <unsupported/Eigen/FFT>

#include <cmath>
#include <complex>
#include <numbers>

namespace asperity {

namespace {

using Complex = std::complex<double>;
using Fft = Eigen::FFT<double>;

Fft make_fft() {
    Fft fft;
    fft.SetFlag(Fft::HalfSpectrum);
    return fft;
}

/// The next number of factors 2, 3 and 5 alone.
int quick_length(int n) {
    for (;; ++n) {
        int rest = n;
        for (const int factor : {2, 3, 5})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

/// The filter along lines of n values.
class LineFilter {
  public:
    LineFilter(int n, double step, double cutoff, Boundary boundary) : n_(n) {
        const int reach = static_cast<int>(std::floor(cutoff / step));
        periodic_ = boundary == Boundary::Periodic;
        length_ = periodic_ ? n : quick_length(n + std::min(reach, n - 1));
        // Weights around 0, with all their repetitions where the line repeats
        std::vector<double> weights(static_cast<std::size_t>(length_));
        double sum = 0;
        const int most = periodic_ ? reach : std::min(reach, n - 1);
        for (int k = -most; k <= most; ++k) {
            const double r = k * step / cutoff;
            const double weight =
                std::exp(-std::numbers::pi * r * r / (std::numbers::ln2 / std::numbers::pi));
            weights[static_cast<std::size_t>(((k % length_) + length_) % length_)] += weight;
            sum += weight;
        }
        for (double& w : weights) w /= sum;
        Fft fft = make_fft();
        transfer_.resize(static_cast<std::size_t>(length_ / 2 + 1));
        fft.fwd(transfer_.data(), weights.data(), length_);
        if (!periodic_) {
            share_.assign(static_cast<std::size_t>(n), 1.0);
            std::vector<double> ones = share_;
            Scratch scratch(*this);
            convolve(ones.data(), scratch);
            share_ = std::move(ones);
        }
    }

    struct Scratch {
        explicit Scratch(const LineFilter& filter)
            : fft(make_fft()),
              line(static_cast<std::size_t>(filter.length_)),
              half(filter.transfer_.size()) {}
        Fft fft;
        std::vector<double> line;
        std::vector<Complex> half;
    };

    void apply(double* values, Scratch& scratch) const {
        // Counted from their first, so that a far offset costs no digits
        const double origin = values[0];
        for (int k = 0; k < n_; ++k) values[k] -= origin;
        convolve(values, scratch);
        for (int k = 0; k < n_; ++k) {
            const double share = periodic_ ? 1.0 : share_[static_cast<std::size_t>(k)];
            values[k] = values[k] / share + origin;
        }
    }

  private:
    void convolve(double* values, Scratch& s) const {
        std::fill(s.line.begin(), s.line.end(), 0.0);
        std::copy(values, values + n_, s.line.begin());
        s.fft.fwd(s.half.data(), s.line.data(), length_);
        for (std::size_t k = 0; k < s.half.size(); ++k) s.half[k] *= transfer_[k].real();
        s.fft.inv(s.line.data(), s.half.data(), length_);
        std::copy(s.line.begin(), s.line.begin() + n_, values);
    }

    int n_, length_ = 0;
    bool periodic_ = false;
    std::vector<Complex> transfer_;  ///< real: the weights are even
    std::vector<double> share_;      ///< of the weights that lies on the line, for each place
};

void filter_rows(std::vector<double>& heights, int rows, const LineFilter& filter, int columns,
                 const Run& run) {
    for_blocks(rows, kRowsPerBlock, run, [&](int first, int last) {
        LineFilter::Scratch scratch(filter);
        for (int j = first; j < last; ++j)
            filter.apply(
                heights.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(columns),
                scratch);
    });
}

std::vector<double> transposed(const std::vector<double>& heights, int nx, int ny) {
    std::vector<double> turned(heights.size());
    const auto columns = static_cast<std::size_t>(nx), rows = static_cast<std::size_t>(ny);
    constexpr std::size_t kTile = 32;
    for (std::size_t j0 = 0; j0 < rows; j0 += kTile)
        for (std::size_t i0 = 0; i0 < columns; i0 += kTile)
            for (std::size_t j = j0; j < std::min(rows, j0 + kTile); ++j)
                for (std::size_t i = i0; i < std::min(columns, i0 + kTile); ++i)
                    turned[i * rows + j] = heights[j * columns + i];
    return turned;
}

}  // namespace

void gaussian_low_pass(std::vector<double>& heights, int nx, int ny, double dx, double dy,
                       double cutoff, Boundary boundary, const Run& run) {
    filter_rows(heights, ny, LineFilter(nx, dx, cutoff, boundary), nx, run);
    heights = transposed(heights, nx, ny);
    filter_rows(heights, nx, LineFilter(ny, dy, cutoff, boundary), ny, run);
    heights = transposed(heights, ny, nx);
}

}  // namespace asperity

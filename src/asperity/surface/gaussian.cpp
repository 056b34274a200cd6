// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/gaussian.h>

#include <asperity/core/random.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>
#include <asperity/surface/spectrum.h>

namespace asperity {

namespace {

constexpr std::uint32_t kGaussianStream = 0x47415553;  // of the random numbers, "GAUS"

/// Amplitudes this far below that of a field of one unit of gradient do not change a float height.
constexpr double kNegligible = 1e-14;

/// The random half spectrum of a real field of unit power per coefficient.
class NormalSpectrum {
  public:
    NormalSpectrum(int nx, int ny, std::uint64_t seed)
        : nx_(nx), ny_(ny), random_(seed, kGaussianStream) {}

    std::complex<double> operator()(int kx, int ky) const {
        // The opposite wave vector lies in the same column: it is the conjugate, or the same
        const bool own_conjugate = kx == 0 || 2 * kx == nx_;
        if (own_conjugate && ky > ny_ - ky) return std::conj(draw(kx, ny_ - ky));
        if (own_conjugate && (ky == 0 || 2 * ky == ny_))
            return std::sqrt(2.0) * draw(kx, ky).real();
        return draw(kx, ky);
    }

  private:
    std::complex<double> draw(int kx, int ky) const {
        const auto index = (static_cast<std::uint64_t>(kx) << 32) | static_cast<std::uint64_t>(ky);
        const auto n = random_.normal2(index);
        return std::sqrt(0.5) * std::complex<double>(n[0], n[1]);
    }

    int nx_, ny_;
    CounterRandom random_;
};

}  // namespace

void fill_gaussian(Heightfield& surface, const PowerSpectrumSettings& settings, double rms_gradient,
                   std::uint64_t seed, Run& run) {
    const PowerSpectrum density(settings);
    const auto expected = density.variances(run);
    const double scale = rms_gradient / std::sqrt(expected.slope_x + expected.slope_y);
    const NormalSpectrum normal(surface.nx, surface.ny, seed);
    const auto make_column = [&](int kx, std::span<std::complex<float>> column) {
        for (std::size_t k = 0; k < column.size(); ++k) {
            const int ky = static_cast<int>(k);
            const double amplitude = scale * std::sqrt(density(kx, ky));
            const bool zero = (kx == 0 && ky == 0) || amplitude < kNegligible * rms_gradient;
            column[k] =
                zero ? std::complex<float>() : std::complex<float>(amplitude * normal(kx, ky));
        }
    };
    synthesize({surface.nx, surface.ny, surface.heights}, make_column, run);
}

void rescale_to_gradient(Heightfield& surface, double rms_gradient, const Run& run) {
    const auto add_row = [&](double& sum, int j) {
        throw_if_stopped(run);
        visit_facets(surface, j, [&](int, Triangle, Slope s) { sum += s.x * s.x + s.y * s.y; });
    };
    const double sum = sum_rows<double>(surface.cells_y(), run.threads(), add_row);
    if (sum == 0) return;
    const double measured = std::sqrt(sum / (2.0 * static_cast<double>(surface.cell_count())));
    const double factor = rms_gradient / measured;
    const auto nx = static_cast<std::size_t>(surface.nx);
    for_blocks(surface.ny, kRowsPerSum, run, [&](int first, int last) {
        for (std::size_t k = static_cast<std::size_t>(first) * nx;
             k < static_cast<std::size_t>(last) * nx; ++k)
            surface.heights[k] =
                static_cast<float>(factor * static_cast<double>(surface.heights[k]));
    });
}

}  // namespace asperity

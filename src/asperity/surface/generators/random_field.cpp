// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/random_field.h>

#include <asperity/core/error.h>
#include <asperity/surface/check_settings.h>
#include <asperity/surface/gaussian.h>
#include <asperity/surface/spectrum.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::generators {

namespace {

/// The power spectrum that meets the ratio of the alphas: surface_settings.h states the rule.
PowerSpectrumSettings spectrum_of(const SurfaceSettings& s, double aspect, const Run& run) {
    PowerSpectrumSettings spectrum;
    spectrum.autocorrelation = s.autocorrelation;
    spectrum.hurst = s.hurst;
    spectrum.correlation_x = s.correlation_x;
    spectrum.correlation_y = s.correlation_y;
    spectrum.nx = spectrum.ny = s.size;
    spectrum.aspect = aspect;
    if (s.alpha_x != s.alpha_y && s.correlation_x == s.correlation_y)
        spectrum.correlation_y = matching_correlation_y(spectrum, s.alpha_x, s.alpha_y, run);
    return spectrum;
}

/// A figure, or two when they differ.
std::string one_or_two(double x, double y) {
    return x == y ? fmt::format("{}", x) : fmt::format("{}, {}", x, y);
}

}  // namespace

double asked_rms_gradient(const SurfaceSettings& s) {
    return std::sqrt((s.alpha_x * s.alpha_x + s.alpha_y * s.alpha_y) / 2);
}

void fill_random_field(Heightfield& surface, const SurfaceSettings& s, Run& run) {
    fill_gaussian(surface, spectrum_of(s, surface.dy, run), asked_rms_gradient(s), s.seed, run);
}

std::uint64_t random_field_steps(const SurfaceSettings& s) {
    return transform_steps(s.size, s.size);
}

void check_correlation(const SurfaceSettings& s) {
    const CellSize cell = cell_size(s);
    const double side_x = s.size, side_y = s.size * cell.y / cell.x;
    const auto refuse = [](std::string why) {
        throw Error(ErrorCode::Usage, std::move(why), "correlation-length");
    };
    if (s.correlation_x > side_x)
        refuse(fmt::format("{} cells are longer than the tile, {} cells", s.correlation_x, side_x));
    if (s.correlation_y > side_y)
        refuse(fmt::format("{} cells along y are longer than the tile, {} cells", s.correlation_y,
                           side_y));
}

bool random_field_is_isotropic(const SurfaceSettings& s) {
    return s.alpha_x == s.alpha_y && s.correlation_x == s.correlation_y;
}

std::string random_field_name(const SurfaceSettings& s) {
    std::string shape;
    if (s.autocorrelation == Autocorrelation::Exponential) shape = ", exponential";
    if (s.autocorrelation == Autocorrelation::SelfAffine)
        shape = fmt::format(", self-affine, Hurst {}", s.hurst);
    return fmt::format("{}, alpha {}, correlation length {} cells{}, seed {}", s.kind,
                       one_or_two(s.alpha_x, s.alpha_y),
                       one_or_two(s.correlation_x, s.correlation_y), shape, s.seed);
}

}  // namespace asperity::generators

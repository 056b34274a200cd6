// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/make_surface.h>

#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/check_settings.h>
#include <asperity/surface/gaussian.h>
#include <asperity/surface/ggx.h>
#include <asperity/surface/shapes.h>
#include <asperity/surface/spectrum.h>
#include <asperity/surface/thesis_noise.h>

#include <fmt/format.h>

#include <cmath>
#include <new>

namespace asperity {

namespace {

constexpr int kRowsPerBlock = 64;

/// Steps the maker of this kind advances the run by.
std::uint64_t steps(const SurfaceSettings& s) {
    switch (s.kind) {
        case SurfaceKind::Gaussian:
            return transform_steps(s.size, s.size);
        case SurfaceKind::Ggx:
            return transform_steps(s.size, s.size) + kGgxRounds * impose_steps(s.size, s.size);
        default:
            return static_cast<std::uint64_t>(s.size);
    }
}

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

/// Makes the heights in units of dx: the surface has cells of 1 x dy / dx.
void fill(Heightfield& surface, const SurfaceSettings& s, Run& run) {
    const double rms_gradient = std::sqrt((s.alpha_x * s.alpha_x + s.alpha_y * s.alpha_y) / 2);
    switch (s.kind) {
        case SurfaceKind::Thesis:
            fill_thesis_noise(surface, s.roughness, s.seed, run);
            break;
        case SurfaceKind::Gaussian:
            fill_gaussian(surface, spectrum_of(s, surface.dy, run), rms_gradient, s.seed, run);
            rescale_to_gradient(surface, rms_gradient, run);
            break;
        case SurfaceKind::Ggx:
            fill_gaussian(surface, spectrum_of(s, surface.dy, run), rms_gradient, s.seed, run);
            impose_slope_law(surface, {SlopeFamily::Ggx, s.alpha_x, s.alpha_y, s.max_slope},
                             kGgxRounds, run);
            break;
        default:
            fill_shape(surface, s, run);
            break;
    }
}

void scale_heights(Heightfield& surface, double factor, const Run& run) {
    if (factor == 1) return;
    const auto nx = static_cast<std::size_t>(surface.nx);
    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        for (std::size_t k = static_cast<std::size_t>(first) * nx;
             k < static_cast<std::size_t>(last) * nx; ++k) {
            const double height = factor * static_cast<double>(surface.heights[k]);
            if (std::abs(height) > 1e37)
                throw Error(ErrorCode::Usage, "heights grow beyond 1e37", "height-scale");
            surface.heights[k] = static_cast<float>(height);
        }
    });
}

bool is_isotropic(const SurfaceSettings& s) {
    if (s.kind == SurfaceKind::Flat) return true;
    const bool random = s.kind == SurfaceKind::Gaussian || s.kind == SurfaceKind::Ggx;
    return random && s.alpha_x == s.alpha_y && s.correlation_x == s.correlation_y;
}

/// A figure, or two when they differ.
std::string pair(double x, double y) {
    return x == y ? fmt::format("{}", x) : fmt::format("{}, {}", x, y);
}

std::string random_name(const char* kind, const SurfaceSettings& s) {
    std::string shape;
    if (s.autocorrelation == Autocorrelation::Exponential) shape = ", exponential";
    if (s.autocorrelation == Autocorrelation::SelfAffine)
        shape = fmt::format(", self-affine, Hurst {}", s.hurst);
    return fmt::format("{}, alpha {}, correlation length {} cells{}, seed {}", kind,
                       pair(s.alpha_x, s.alpha_y), pair(s.correlation_x, s.correlation_y), shape,
                       s.seed);
}

std::string name_of(const SurfaceSettings& s) {
    const char* along = s.along_y ? ", along y" : "";
    switch (s.kind) {
        case SurfaceKind::Thesis:
            return fmt::format("thesis noise, roughness {}, seed {}", s.roughness, s.seed);
        case SurfaceKind::Gaussian:
            return random_name("gaussian", s);
        case SurfaceKind::Ggx:
            return random_name("ggx", s);
        case SurfaceKind::Flat:
            return "flat";
        case SurfaceKind::Tilted:
            return fmt::format("tilted, {} degrees{}", s.tilt_deg, along);
        case SurfaceKind::VGroove:
            return fmt::format("vgroove, {} degrees, period {}{}", s.tilt_deg, s.period, along);
        case SurfaceKind::Sawtooth:
            return fmt::format("sawtooth, {} degrees, period {}{}", s.tilt_deg, s.period, along);
        case SurfaceKind::Pyramids:
            return fmt::format("pyramids, {} degrees, period {}", s.tilt_deg, s.period);
        case SurfaceKind::Sinusoid:
            return fmt::format("sinusoid, amplitude {}, period {}{}", s.amplitude, s.period, along);
        case SurfaceKind::Eggcrate:
            return fmt::format("eggcrate, amplitude {}, period {}", s.amplitude, s.period);
        case SurfaceKind::File:
            break;
    }
    return {};
}

Heightfield make_checked(const SurfaceSettings& settings, Run& run) {
    const CellSize cell = cell_size(settings);
    Heightfield surface;
    surface.nx = surface.ny = settings.size;
    surface.dx = 1;
    surface.dy = cell.y / cell.x;
    surface.diagonal = settings.diagonal;
    surface.boundary = settings.boundary;
    surface.isotropic = is_isotropic(settings);
    surface.name = name_of(settings);
    const auto size = static_cast<std::size_t>(settings.size);
    run.begin("surface", steps(settings));
    allocate(surface.heights, size * size, run);
    fill(surface, settings, run);
    surface.dx = cell.x;
    surface.dy = cell.y;
    scale_heights(surface, cell.x * settings.height_scale, run);
    run.end();
    return surface;
}

}  // namespace

Heightfield make_surface(const SurfaceSettings& settings, Run& run) {
    check_settings(settings);
    try {
        return make_checked(settings, run);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory,
                    fmt::format("no memory for {0} x {0} samples", settings.size), "size");
    }
}

}  // namespace asperity

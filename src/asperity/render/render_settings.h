// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/rgb.h>

#include <cstdint>

namespace asperity {

/// How the rendering equation (thesis eq. 3.2) is solved.
enum class Integrator {
    Path,  ///< path tracing, direct light by DirectLight
    /// Thesis 3.2, for teaching: direct light alone, as eq. 3.3 in two dimensions over theta and
    /// phi of the hemisphere, cut into strata x strata cells with one random place in each; sample
    /// n falls into one cell, all are visited in strata^2 samples, in random order. Point and
    /// directional light are added as they are.
    Stratified,
};

/// How a light and a BRDF share the search for direct light. All have the same mean.
enum class DirectLight {
    Mis,        ///< both, weighted by the balance heuristic (Veach and Guibas 1995)
    LightOnly,  ///< directions drawn from the lights
    BrdfOnly,   ///< directions drawn from the BRDF; point and directional light as they are
};

/// Where in a pixel its samples lie.
enum class PixelFilter {
    Centre,  ///< all in the middle: exact values to compare with, jagged edges
    Box,     ///< anywhere in the pixel
    Tent,    ///< up to one pixel from the middle, less and less often
};

struct RenderSettings {
    int width = 512, height = 512;  ///< 1 .. 16384 each, at most 2^26 pixels
    std::uint32_t spp = 64;         ///< samples per pixel, 1 .. 2^24
    /// > 0: stop as soon as noise() falls to it, `spp` at the latest. 0.02 is 2 %.
    double until = 0;
    int depth = 4;  ///< reflections, 1 .. 1000; 1 is direct light only, the thesis' look
    Integrator integrator = Integrator::Path;
    DirectLight direct = DirectLight::Mis;
    PixelFilter filter = PixelFilter::Tent;
    int strata = 8;  ///< of Integrator::Stratified, on a side, 1 .. 1024
    std::uint64_t seed = 1;
    /// Behind the model: the lights themselves, or one colour [radiance].
    bool show_lights = true;
    Rgb background{0, 0, 0};
};

/// Throws Error(Usage, "width" | "height" | "spp" | "until" | "depth" | "strata" | "background").
void check(const RenderSettings& settings);

}  // namespace asperity

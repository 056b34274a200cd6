// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/render/camera.h>
#include <asperity/render/film.h>
#include <asperity/render/light_choice.h>
#include <asperity/render/render_settings.h>
#include <asperity/render/scene.h>

#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

/// What was done so far.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, bounce = 0;
    /// Samples whose radiance was not finite: counted as black. Anything but 0 is a bug.
    std::uint64_t invalid = 0;
};

/// Renders one view of a scene, pass by pass: usable after the first, better with each.
///
/// The one renderer of the project: command line and studio show its pixels. Making one is cheap
/// (a film), so a camera that moves, a smaller preview or a changed material is a new Renderer on
/// the same TracedModel.
///
/// The same scene, camera, settings and number of samples give the same bits for any number of
/// threads, and whether or not passes were stopped in between.
class Renderer {
  public:
    /// Throws check(settings)'s errors, Error(Usage, "light" | "model") for null pointers.
    Renderer(ModelScene scene, const Camera& camera, const RenderSettings& settings);

    /// Takes one more sample of every pixel, by tiles of 16 x 16 on run.threads() threads, and
    /// calls run.advance() with the pixels of each tile that is done. begin() and end() are the
    /// caller's.
    ///
    /// Wishes to stop and to pause are heard before each tile, which takes a few milliseconds: some
    /// tiles are then a sample ahead of others, and the next pass starts with those that are
    /// behind. Returns true when all pixels have samples() samples, false when it was stopped
    /// before.
    bool render_pass(Run& run);

    /// Begins the next pass: takes its sample of those pixels alone whose entry in `chosen`, row by
    /// row, is not 0, and calls run.advance() with their number. Those who have it already are
    /// passed over, and so they are by the render_pass() that ends the pass: all samples are those
    /// that it would have taken alone. For a picture that is wanted before a whole pass is done.
    ///
    /// Wishes to stop are heard as by render_pass(); returns false when one came. Throws
    /// Error(Usage, "chosen") when there is not one entry for each pixel.
    bool begin_pass(Run& run, std::span<const std::uint8_t> chosen);

    /// Of the pixels that have fewest.
    std::uint32_t samples() const;
    /// Between passes only.
    const Film& film() const { return film_; }
    const RayCounts& rays() const { return rays_; }
    const RenderSettings& settings() const { return settings_; }

  private:
    /// One sample of the pixels (of all when `chosen` is empty) of the tiles that are behind.
    void sample_tiles(Run& run, std::span<const std::uint8_t> chosen);

    ModelScene scene_;
    Camera camera_;
    RenderSettings settings_;
    Film film_;
    RayCounts rays_;
    std::vector<std::uint32_t> tile_samples_;  ///< row by row
    LightChoice lights_;
};

/// How a render() ended.
struct RenderOutcome {
    std::uint32_t samples = 0;
    double noise = 0;  ///< see film.h
    bool stopped = false;
    double seconds = 0;
};

/// Renders until settings().spp or settings().until is reached, or the run is stopped: the film is
/// usable however it ends. Noise is looked at after 16 samples and then whenever their number grew
/// by an eighth. The stage is "rendering", in samples of pixels.
RenderOutcome render(Renderer& renderer, Run& run);

}  // namespace asperity

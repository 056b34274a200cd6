// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "painting.h"
#include "tone_table.h"

#include <asperity/formats/images/render_writer.h>
#include <asperity/render/camera.h>
#include <asperity/render/renderer.h>
#include <asperity/render/scene.h>
#include <asperity/render/tonemap.h>

#include <QSize>

#include <atomic>
#include <memory>
#include <mutex>

namespace asperity::studio {

/// What is seen of a model, wherever it is looked at from.
struct ModelSight {
    asperity::ModelScene scene;
    bool backdrop = true;  ///< grey behind the model instead of its lights
    int depth = 1;         ///< reflections
    ToneMapping tone = kThesisLook;
    /// Tells sights apart: the picture of one may be waited for.
    std::uint64_t number = 0;
};

/// The film of the picture that was begun last, kept so that it can be saved. A painting exposes it
/// in its thread while the main thread may ask for it.
class Negative {
  public:
    /// Whether this is a picture of that sight, camera and size, with a first pass done.
    bool shows(std::uint64_t sight, const Camera& camera, QSize size);

    /// With what came out added to the provenance: size, seed, samples, noise. The PNG is what the
    /// painting shows, but nothing is taken out of its noise. Throw Error(InputOutput, path);
    /// Error(Usage) when nothing is exposed.
    void save_png(const std::string& path, io::Provenance provenance);
    void save_exr(const std::string& path, io::Provenance provenance);

    /// Copy of the film; for tests and measurements. Throws as above.
    Film film();

  private:
    friend class ModelPainting;
    struct Shot {
        Renderer renderer;
        Camera camera;
        std::uint64_t sight = 0;
        std::shared_ptr<const ToneTable> table;
        double noise = 1;
    };
    /// Of the mapping; made anew only when it is another than before.
    std::shared_ptr<const ToneTable> table(const ToneMapping& tone);
    /// Waits for the end of the pass under way; the next one waits for us.
    std::unique_lock<std::mutex> ask();
    const Shot& shot() const;
    io::Provenance complete(io::Provenance provenance) const;

    std::mutex mutex_;
    std::atomic<int> asking_{0};
    std::shared_ptr<Shot> shot_;
    std::shared_ptr<const ToneTable> table_;
};

/// Paints a sight through a camera: one sample a pixel, then better and better, up to 1024 samples
/// or a noise of 0.5 %. What is seen of fewer than 256 samples has its noise taken out, see
/// denoise.h; the film has not. Equal sights, cameras and sizes give equal pictures.
BeginPainting paint_model(const ModelSight& sight, const Camera& camera,
                          std::shared_ptr<Negative> negative);

}  // namespace asperity::studio

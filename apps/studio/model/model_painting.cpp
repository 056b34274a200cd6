// SPDX-License-Identifier: Apache-2.0
#include "model_painting.h"

#include "backdrop.h"
#include "denoise.h"
#include "sketch.h"

#include <asperity/core/error.h>
#include <asperity/core/version.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace asperity::studio {

namespace {

constexpr std::uint32_t kMostSamples = 1024;
constexpr double kCleanEnough = 0.005;
/// The noise is looked at from so many samples on, and then whenever they grew by an eighth.
constexpr std::uint32_t kFirstLook = 16;
/// From so many samples on the film is shown as it is.
constexpr std::uint32_t kMostFiltered = 256;
/// Pictures of more pixels begin with a sketch of a sixteenth of them, others with one of a fourth.
constexpr double kLarge = 0.5e6;

Renderer begin(ModelSight sight, const Camera& camera, QSize size) {
    RenderSettings settings;
    settings.width = size.width();
    settings.height = size.height();
    settings.spp = kMostSamples;
    settings.depth = sight.depth;
    if (sight.backdrop) sight.scene.lights.push_back(make_backdrop(camera, sight.tone));
    return Renderer(std::move(sight.scene), camera, settings);
}

}  // namespace

class ModelPainting final : public Painting {
  public:
    ModelPainting(const ModelSight& sight, const Camera& camera, QSize size,
                  std::shared_ptr<Negative> negative)
        : negative_(std::move(negative)),
          model_(sight.scene.model),
          split_(sight.scene.split ? sight.scene.split->position : 1),
          noisy_(is_noisy(sight)),
          stride_(!noisy_                                         ? 1
                  : double(size.width()) * size.height() > kLarge ? 4
                                                                  : 2) {
        const std::lock_guard lock(negative_->mutex_);
        shot_ = std::make_shared<Negative::Shot>(Negative::Shot{
            begin(sight, camera, size), camera, sight.number, negative_->table(sight.tone)});
        negative_->shot_ = shot_;
    }

    bool pass(Run& run) override {
        using namespace std::chrono_literals;
        // Whoever asks for the film goes first
        while (negative_->asking_ > 0 && !run.stop_requested()) std::this_thread::sleep_for(1ms);
        const std::lock_guard lock(negative_->mutex_);
        if (stride_ > 1) return sketch(run);
        if (is_clean() || !shot_->renderer.render_pass(run)) return false;
        look_at_noise();
        develop(run);
        return !run.stop_requested();
    }

    QImage image() const override { return image_; }
    int samples(int) const override { return static_cast<int>(shot_->renderer.samples()); }

  private:
    bool is_clean() const {
        return shot_->renderer.samples() >= kMostSamples || shot_->noise <= kCleanEnough;
    }

    /// Those of the first picture are guessed, for it is wanted soon.
    const PixelGuides& guides(Run& run) {
        const bool first = guides_.width == 0;
        if (!first && !guessed_) return guides_;
        const Film& film = shot_->renderer.film();
        guides_ = (first ? guess_guides : look_for_guides)(*model_, shot_->camera, film.width(),
                                                           film.height(), split_, run);
        guessed_ = first;
        return guides_;
    }

    /// A picture from a part of the first samples, so that one is there soon.
    bool sketch(Run& run) {
        const Sketch sketch(guides(run), stride_, run);
        stride_ /= 2;
        if (!shot_->renderer.begin_pass(run, sketch.chosen())) return false;
        const Film& film = shot_->renderer.film();
        const std::vector<float> rgb = sketch.filled(film, run);
        image_ = shot_->table->develop(rgb, film.width(), film.height(), run.threads());
        return !run.stop_requested();
    }

    void look_at_noise() {
        const std::uint32_t samples = shot_->renderer.samples();
        if (samples < next_look_) return;
        shot_->noise = noise(shot_->renderer.film());
        next_look_ = samples + (samples + 7) / 8;
    }

    /// Light that is drawn by lot has noise; a point light that meets a facet once has none.
    static bool is_noisy(const ModelSight& sight) {
        const auto& lights = sight.scene.lights;
        const bool by_lot = std::any_of(lights.begin(), lights.end(),
                                        [](const auto& light) { return !light->is_delta(); });
        return by_lot || sight.depth > 1;
    }

    /// The film as it is shown. To take the noise out costs as much as a pass or two, so of many
    /// passes only some are shown, and none of those that are clean by themselves are touched.
    void develop(Run& run) {
        const Film& film = shot_->renderer.film();
        const std::uint32_t samples = shot_->renderer.samples();
        if (!noisy_ || samples > kMostFiltered) {
            image_ = shot_->table->develop(film, run.threads());
            return;
        }
        if (samples < next_shown_) return;
        next_shown_ = samples + std::max(1U, samples / 3);
        const std::vector<float> clean = denoised(film, guides(run), run);
        if (run.stop_requested()) return;
        image_ = shot_->table->develop(clean, film.width(), film.height(), run.threads());
    }

    std::shared_ptr<Negative> negative_;
    std::shared_ptr<Negative::Shot> shot_;
    std::shared_ptr<const TracedModel> model_;
    double split_;
    bool noisy_;
    int stride_;  ///< of the next sketch; 1: there is none
    PixelGuides guides_;
    bool guessed_ = false;
    QImage image_;
    std::uint32_t next_shown_ = 1;
    std::uint32_t next_look_ = kFirstLook;
};

std::shared_ptr<const ToneTable> Negative::table(const ToneMapping& tone) {
    const auto same = [&](const ToneMapping& other) {
        return other.exposure == tone.exposure && other.curve == tone.curve &&
               other.transfer == tone.transfer;
    };
    if (table_ == nullptr || !same(table_->mapping()))
        table_ = std::make_shared<const ToneTable>(tone);
    return table_;
}

std::unique_lock<std::mutex> Negative::ask() {
    ++asking_;
    std::unique_lock lock(mutex_);
    --asking_;
    return lock;
}

const Negative::Shot& Negative::shot() const {
    if (shot_ == nullptr || shot_->renderer.samples() == 0)
        throw Error(ErrorCode::Usage, "there is no picture to be saved: load a model first");
    return *shot_;
}

bool Negative::shows(std::uint64_t sight, const Camera& camera, QSize size) {
    const auto lock = ask();
    if (shot_ == nullptr || shot_->sight != sight || shot_->renderer.samples() == 0) return false;
    const Film& film = shot_->renderer.film();
    const Camera& seen = shot_->camera;
    return size == QSize(film.width(), film.height()) && seen.position == camera.position &&
           seen.forward == camera.forward && seen.up == camera.up && seen.fov_deg == camera.fov_deg;
}

io::Provenance Negative::complete(io::Provenance provenance) const {
    const Renderer& renderer = shot().renderer;
    const auto tell = [&](const char* name, const std::string& value) {
        provenance.emplace_back(name, value);
    };
    tell("width", std::to_string(renderer.film().width()));
    tell("height", std::to_string(renderer.film().height()));
    tell("seed", std::to_string(renderer.settings().seed));
    tell("version", kVersion);
    tell("samples", std::to_string(renderer.samples()));
    if (renderer.samples() > 1) tell("noise", fmt::format("{}", noise(renderer.film())));
    return provenance;
}

void Negative::save_png(const std::string& path, io::Provenance provenance) {
    const auto lock = ask();
    io::write_render_png(shot().renderer.film(), shot().table->mapping(),
                         complete(std::move(provenance)), path);
}

void Negative::save_exr(const std::string& path, io::Provenance provenance) {
    const auto lock = ask();
    io::write_render_exr(shot().renderer.film(), complete(std::move(provenance)), path);
}

Film Negative::film() {
    const auto lock = ask();
    return shot().renderer.film();
}

BeginPainting paint_model(const ModelSight& sight, const Camera& camera,
                          std::shared_ptr<Negative> negative) {
    return [sight, camera, negative = std::move(negative)](QSize size) {
        return std::make_unique<ModelPainting>(sight, camera, size, negative);
    };
}

}  // namespace asperity::studio

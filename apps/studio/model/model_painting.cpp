// SPDX-License-Identifier: Apache-2.0
#include "model_painting.h"

#include "backdrop.h"

#include <asperity/core/error.h>
#include <asperity/core/version.h>

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

namespace asperity::studio {

namespace {

constexpr std::uint32_t kMostSamples = 1024;
constexpr double kCleanEnough = 0.005;
/// The noise is looked at from so many samples on, and then whenever they grew by an eighth.
constexpr std::uint32_t kFirstLook = 16;

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
        : negative_(std::move(negative)) {
        const std::lock_guard lock(negative_->mutex_);
        shot_ = std::make_shared<Negative::Shot>(Negative::Shot{
            begin(sight, camera, size), camera, sight.number, negative_->table(sight.tone)});
        negative_->shot_ = shot_;
    }

    bool pass(Run& run) override {
        using namespace std::chrono_literals;
        threads_ = run.threads();
        // Whoever asks for the film goes first
        while (negative_->asking_ > 0 && !run.stop_requested()) std::this_thread::sleep_for(1ms);
        const std::lock_guard lock(negative_->mutex_);
        if (is_clean() || !shot_->renderer.render_pass(run)) return false;
        look_at_noise();
        return true;
    }

    QImage image() const override {
        return shot_->table->develop(shot_->renderer.film(), threads_);
    }

  private:
    bool is_clean() const {
        return shot_->renderer.samples() >= kMostSamples || shot_->noise <= kCleanEnough;
    }

    void look_at_noise() {
        const std::uint32_t samples = shot_->renderer.samples();
        if (samples < next_look_) return;
        shot_->noise = noise(shot_->renderer.film());
        next_look_ = samples + (samples + 7) / 8;
    }

    std::shared_ptr<Negative> negative_;
    std::shared_ptr<Negative::Shot> shot_;
    int threads_ = 1;
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

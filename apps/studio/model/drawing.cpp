// SPDX-License-Identifier: Apache-2.0
#include "drawing.h"

#include "background.h"

#include <asperity/core/error.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measure.h>
#include <asperity/optics/fresnel.h>

#include <QFile>

#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace asperity::studio {
namespace {

bool same_light(const Layer& a, const Layer& b) {
    return a.number == b.number && a.phi_i == b.phi_i;
}

/// Layers on their way to the main thread. One that grew again before the main thread came to look
/// takes the place of its elder, so a busy window is never flooded.
class Mailbox {
  public:
    /// True when the main thread must be told that there is something to fetch.
    bool put(std::shared_ptr<const Layer> layer) {
        const std::scoped_lock lock(mutex_);
        const bool first = layers_.empty();
        if (!first && same_light(*layers_.back(), *layer))
            layers_.back() = std::move(layer);
        else
            layers_.push_back(std::move(layer));
        return first;
    }
    std::vector<std::shared_ptr<const Layer>> fetch() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(layers_, {});
    }

  private:
    std::mutex mutex_;
    std::vector<std::shared_ptr<const Layer>> layers_;
};

/// A measurement that is complete, in the forms the windows ask for.
struct Finished {
    std::shared_ptr<const Measurement> result;
    Layers layers;  ///< of `result`, sharing its memory
    QString checksum;
};

Finished finish(Measurement measurement) {
    Finished finished;
    auto layers = std::exchange(measurement.layers, {});
    finished.layers.head = std::make_shared<Measurement>(measurement);
    measurement.layers = std::move(layers);

    const auto result = std::make_shared<const Measurement>(std::move(measurement));
    finished.result = result;
    for (const Layer& layer : result->layers)
        finished.layers.by_number.emplace(layer.number,
                                          std::shared_ptr<const Layer>(result, &layer));
    finished.layers.complete = true;
    finished.checksum = QString::fromStdString(io::checksum(*result));
    return finished;
}

}  // namespace

class Drawing::Work {
  public:
    explicit Work(Drawing& drawing)
        : drawing_(drawing), background_(&drawing, [this](const QString& why) { fail(why); }) {}

    void start(std::shared_ptr<const Heightfield> surface, const Experiment& experiment) {
        if (!surface) throw Error(ErrorCode::Usage, "there is no surface yet", "surface");
        validate(experiment);
        const Fresnel checked(experiment.optics);

        run_ = std::make_shared<Run>();
        background_.start(
            [this, surface = std::move(surface), experiment](
                Run& run, const Background::Post& post) -> Background::Delivery {
                tell_progress(run, post);
                Measurement m = measure(*surface, experiment, run, listener(post));
                if (m.stopped) return {};
                return [this, finished = finish(std::move(m))] { complete(finished); };
            },
            run_);
        show({});
        set_state(State::Drawing);
    }

    void pause() {
        if (state_ != State::Drawing) return;
        run_->request_pause();
        set_state(State::Paused);
    }

    void resume() {
        if (state_ != State::Paused) return;
        run_->resume();
        set_state(State::Drawing);
    }

    void clear() {
        background_.cancel();
        run_.reset();
        show({});
        set_state(State::Idle);
    }

    void open(const QString& path) {
        Finished finished = finish(io::load_measurement(QFile::encodeName(path).toStdString()));
        background_.cancel();
        run_.reset();
        show(std::move(finished));
        set_state(State::Idle);
        emit drawing_.completed();
    }

    State state() const { return state_; }
    const Finished& shown() const { return shown_; }
    Progress progress() const { return run_ ? run_->progress() : Progress{}; }

  private:
    // What follows up to `complete` runs in the background

    void tell_progress(Run& run, const Background::Post& post) {
        run.on_progress(
            [this, post, told = std::make_shared<std::atomic<bool>>(false)](const Progress&) {
                if (told->exchange(true)) return;
                post([this, told] {
                    *told = false;
                    emit drawing_.progressed();
                });
            });
    }

    MeasureListener listener(const Background::Post& post) {
        MeasureListener listener;
        listener.begun = [this, post](const Measurement& head) {
            post([this, copy = std::make_shared<const Measurement>(head)] {
                shown_.layers.head = copy;
            });
        };
        listener.layer = [this, post, mail = std::make_shared<Mailbox>()](const Layer& layer,
                                                                          bool /*complete*/) {
            if (mail->put(std::make_shared<const Layer>(layer)))
                post([this, mail] { take(mail->fetch()); });
        };
        return listener;
    }

    // From here on the main thread

    /// Of light from several azimuths the first stands for its layer, as in `finish`.
    void take(const std::vector<std::shared_ptr<const Layer>>& layers) {
        for (const auto& layer : layers) {
            auto& known = shown_.layers.by_number[layer->number];
            if (known && !same_light(*known, *layer)) continue;
            known = layer;
            emit drawing_.layers_changed(layer->number);
        }
    }

    void complete(const Finished& finished) {
        shown_ = finished;
        set_state(State::Idle);
        emit drawing_.completed();
    }

    void fail(const QString& sentence) {
        clear();
        emit drawing_.failed(sentence);
    }

    void show(Finished finished) {
        shown_ = std::move(finished);
        emit drawing_.layers_changed(0);
    }

    void set_state(State state) {
        if (state == state_) return;
        state_ = state;
        emit drawing_.state_changed();
    }

    Drawing& drawing_;
    State state_ = State::Idle;
    Finished shown_;
    std::shared_ptr<Run> run_;  ///< of the latest drawing
    Background background_;
};

Drawing::Drawing(QObject* parent) : QObject(parent), work_(std::make_unique<Work>(*this)) {}

Drawing::~Drawing() = default;

void Drawing::start(std::shared_ptr<const Heightfield> surface, const Experiment& experiment) {
    work_->start(std::move(surface), experiment);
}

void Drawing::pause() {
    work_->pause();
}

void Drawing::resume() {
    work_->resume();
}

void Drawing::stop() {
    if (state() != State::Idle) work_->clear();
}

void Drawing::clear() {
    work_->clear();
}

void Drawing::open(const QString& path) {
    work_->open(path);
}

Drawing::State Drawing::state() const {
    return work_->state();
}

const Layers& Drawing::layers() const {
    return work_->shown().layers;
}

std::shared_ptr<const Measurement> Drawing::result() const {
    return work_->shown().result;
}

Progress Drawing::progress() const {
    return work_->progress();
}

QString Drawing::checksum() const {
    return work_->shown().checksum;
}

}  // namespace asperity::studio

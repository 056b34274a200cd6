// SPDX-License-Identifier: Apache-2.0
#include "light_seen.h"

#include "background.h"

#include <asperity/tracing/engines/plain/tracer.h>

#include <span>

namespace asperity::studio {
namespace {

/// Paths looked at in search of those into one cell: a second or a few.
constexpr std::uint64_t kMostTried = 4'000'000;
/// And so many before something of them is shown: a few hundredths of a second; then so many times
/// more.
constexpr std::uint64_t kFirstTried = 1U << 15;
constexpr std::uint64_t kTimesMore = 4;

/// The tracer of the latest surface: most wishes are about the same one. For one thread at a time.
class TracerAtHand {
  public:
    const Tracer& of(const std::shared_ptr<const Heightfield>& surface, int threads) {
        if (surface != surface_) {
            tracer_.emplace(*surface, threads);
            surface_ = surface;
        }
        return *tracer_;
    }

  private:
    std::shared_ptr<const Heightfield> surface_;
    std::optional<Tracer> tracer_;
};

/// Those among the first `tried`, if the wish is about a cell.
std::vector<LightPath> find_paths(const LightSeen::Wish& wish, const Tracer& tracer,
                                  std::uint64_t tried, Run& run) {
    if (!wish.cell) return sample_light_paths(tracer, wish.experiment, wish.layer, wish.count, run);
    return paths_into_cells(tracer, wish.experiment, wish.layer, std::span(&*wish.cell, 1),
                            wish.count, tried, run)
        .paths;
}

}  // namespace

class LightSeen::Work {
  public:
    // A layer that does not exist, settings that are refused: nothing to see. Draw To Textures says
    // why.
    explicit Work(LightSeen& seen)
        : seen_(seen), background_(&seen, [this](const QString&) { forget(); }) {}

    void look(const Wish& wish) {
        background_.start([this, wish, tracer = tracer_](Run& run, const Background::Post& post) {
            const Tracer& at_hand = tracer->of(wish.surface, run.threads());
            // The first answer comes at once, and fills in
            for (std::uint64_t tried = kFirstTried; wish.cell && tried < kMostTried;
                 tried *= kTimesMore) {
                const auto some = find_paths(wish, at_hand, tried, run);
                if (some.size() >= wish.count || run.stop_requested()) break;
                if (!some.empty()) post([this, wish, some] { show(wish, some); });
            }
            auto found = find_paths(wish, at_hand, kMostTried, run);
            return [this, wish, found = std::move(found)] { show(wish, found); };
        });
    }

    void forget() {
        background_.cancel();
        if (wish_ || !paths_.empty()) show(std::nullopt, {});
    }

    bool busy() const { return background_.busy(); }
    const std::optional<Wish>& wish() const { return wish_; }
    const std::vector<LightPath>& paths() const { return paths_; }

  private:
    void show(const std::optional<Wish>& wish, const std::vector<LightPath>& paths) {
        wish_ = wish;
        paths_ = paths;
        emit seen_.changed();
    }

    LightSeen& seen_;
    std::shared_ptr<TracerAtHand> tracer_ = std::make_shared<TracerAtHand>();  ///< of the thread
    std::optional<Wish> wish_;
    std::vector<LightPath> paths_;
    Background background_;
};

LightSeen::LightSeen(QObject* parent) : QObject(parent), work_(std::make_unique<Work>(*this)) {}

LightSeen::~LightSeen() = default;

void LightSeen::look(const Wish& wish) {
    work_->look(wish);
}

void LightSeen::forget() {
    work_->forget();
}

bool LightSeen::busy() const {
    return work_->busy();
}

const std::optional<LightSeen::Wish>& LightSeen::wish() const {
    return work_->wish();
}

const std::vector<LightPath>& LightSeen::paths() const {
    return work_->paths();
}

}  // namespace asperity::studio

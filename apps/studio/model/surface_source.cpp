// SPDX-License-Identifier: Apache-2.0
#include "surface_source.h"

#include "background.h"

#include <asperity/formats/heights/surface_files.h>

namespace asperity::studio {

/// A surface and what is known of it.
struct MadeSurface {
    std::shared_ptr<const Heightfield> surface;
    SurfaceStatistics statistics;
    SurfaceSettings settings;
};

class SurfaceSource::Work {
  public:
    explicit Work(SurfaceSource& source)
        : source_(source),
          background_(&source, [&](const QString& why) { emit source_.failed(why); }) {}

    void make(const SurfaceSettings& settings) {
        background_.start([this, settings](Run& run, const Background::Post&) {
            MadeSurface made;
            made.surface = std::make_shared<Heightfield>(io::load_surface(settings, run));
            made.statistics = asperity::statistics(*made.surface, run);
            made.settings = settings;
            return [this, made] {
                made_ = made;
                emit source_.ready();
            };
        });
    }

    bool busy() const { return background_.busy(); }
    const MadeSurface& made() const { return made_; }

  private:
    SurfaceSource& source_;
    MadeSurface made_;
    Background background_;
};

SurfaceSource::SurfaceSource(QObject* parent)
    : QObject(parent), work_(std::make_unique<Work>(*this)) {}

SurfaceSource::~SurfaceSource() = default;

void SurfaceSource::make(const SurfaceSettings& settings) {
    work_->make(settings);
    emit started();
}

bool SurfaceSource::busy() const {
    return work_->busy();
}

std::shared_ptr<const Heightfield> SurfaceSource::surface() const {
    return work_->made().surface;
}

std::uint64_t SurfaceSource::cells() const {
    const auto made = surface();
    return made != nullptr ? made->cell_count() : 1;
}

const SurfaceStatistics& SurfaceSource::statistics() const {
    return work_->made().statistics;
}

const SurfaceSettings& SurfaceSource::settings() const {
    return work_->made().settings;
}

}  // namespace asperity::studio

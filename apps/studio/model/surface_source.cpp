// SPDX-License-Identifier: Apache-2.0
#include "surface_source.h"

#include "background.h"

#include <asperity/formats/heights/surface_files.h>

#include <utility>

namespace asperity::studio {

namespace {

constexpr int kMapSide = 620;  ///< of the pictures of a file [pixels]

/// A surface and what is known of it.
struct MadeSurface {
    std::shared_ptr<const Heightfield> surface;
    SurfaceStatistics statistics;
    SurfaceSettings settings;
};

/// What decides which channels a file has.
struct ListedFile {
    std::string file, format, decimal;
    bool operator==(const ListedFile&) const = default;
};

FileReading as_measured(const Topography& topography) {
    FileReading reading;
    reading.before = io::height_map(topography, kMapSide);
    reading.found = topography.found;
    reading.assumed = topography.assumed;
    reading.missing = topography.missing_count();
    return reading;
}

/// The surface, and `reading` to its end.
std::shared_ptr<const Heightfield> made_ready(FileReading& reading, Topography topography,
                                              const SurfaceSettings& settings, const Run& run) {
    auto patch =
        std::make_shared<const Heightfield>(io::patch_of(std::move(topography), settings, run));
    reading.after = io::height_map(*patch, kMapSide);
    reading.prepared = patch->prepared;
    Heightfield whole = io::tiled(*patch, settings);
    reading.tiling = whole.tiling;
    reading.patch = std::move(patch);
    return std::make_shared<const Heightfield>(std::move(whole));
}

}  // namespace

class SurfaceSource::Work {
  public:
    explicit Work(SurfaceSource& source)
        : source_(source),
          background_(&source, [&](const QString& why) { fail(why); }),
          listing_(&source, [](const QString&) {}) {}  // reading says the same

    void make(const SurfaceSettings& settings) {
        trouble_.clear();
        was_read_ = false;
        if (settings.kind != kSurfaceFile) reading_.reset();
        list(settings);
        run_ = std::make_shared<Run>();
        background_.start(
            [this, settings](Run& run, const Background::Post& post) {
                return settings.kind == kSurfaceFile ? read(settings, run, post)
                                                     : generate(settings, run);
            },
            run_);
    }

    void stop() {
        if (!background_.busy()) return;
        background_.cancel();
        fail(tr("stopped: the surface before is still there"));
    }

    bool busy() const { return background_.busy(); }
    Progress progress() const { return run_ && busy() ? run_->progress() : Progress{}; }
    const MadeSurface& made() const { return made_; }
    const QString& trouble() const { return trouble_; }
    const FileReading* reading() const { return reading_ ? &*reading_ : nullptr; }
    const std::vector<FileChannel>& channels() const { return channels_; }

  private:
    Background::Delivery generate(const SurfaceSettings& settings, Run& run) {
        return deliver(
            {std::make_shared<Heightfield>(io::load_surface(settings, run)), {}, settings},
            std::nullopt, run);
    }

    Background::Delivery read(const SurfaceSettings& settings, Run& run,
                              const Background::Post& post) {
        Topography topography = io::read_topography(settings, run);
        FileReading reading = as_measured(topography);
        post([this, reading] {
            reading_ = reading;
            was_read_ = true;
            emit source_.read();
        });
        auto surface = made_ready(reading, std::move(topography), settings, run);
        return deliver({std::move(surface), {}, settings}, std::move(reading), run);
    }

    Background::Delivery deliver(MadeSurface made, std::optional<FileReading> reading, Run& run) {
        made.statistics = asperity::statistics(*made.surface, run);
        return [this, made = std::move(made), reading = std::move(reading)] {
            made_ = made;
            reading_ = reading;
            emit source_.ready();
        };
    }

    void list(const SurfaceSettings& settings) {
        const bool is_file = settings.kind == kSurfaceFile;
        const ListedFile wanted =
            is_file ? ListedFile{settings.file, settings.file_format, settings.file_decimal}
                    : ListedFile{};
        if (wanted == listed_) return;
        listed_ = wanted;
        listing_.cancel();
        take({});
        if (!is_file) return;
        listing_.start([this, settings](Run& run, const Background::Post&) -> Background::Delivery {
            std::vector<FileChannel> channels;
            for (const io::HeightsChannel& c : io::list_channels(settings, run))
                channels.push_back({c.name, c.nx, c.ny, c.other});
            return [this, channels = std::move(channels)] { take(channels); };
        });
    }

    void take(std::vector<FileChannel> channels) {
        channels_ = std::move(channels);
        emit source_.channels_changed();
    }

    void fail(const QString& why) {
        trouble_ = why;
        if (!was_read_) reading_.reset();
        emit source_.failed(why);
    }

    SurfaceSource& source_;
    MadeSurface made_;
    std::optional<FileReading> reading_;
    bool was_read_ = false;  ///< for the latest wish
    QString trouble_;
    std::vector<FileChannel> channels_;
    ListedFile listed_;
    std::shared_ptr<Run> run_;
    Background background_, listing_;
};

SurfaceSource::SurfaceSource(QObject* parent)
    : QObject(parent), work_(std::make_unique<Work>(*this)) {}

SurfaceSource::~SurfaceSource() = default;

void SurfaceSource::make(const SurfaceSettings& settings) {
    work_->make(settings);
    emit started();
}

void SurfaceSource::stop() {
    work_->stop();
}

bool SurfaceSource::busy() const {
    return work_->busy();
}

Progress SurfaceSource::progress() const {
    return work_->progress();
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

const QString& SurfaceSource::trouble() const {
    return work_->trouble();
}

const FileReading* SurfaceSource::reading() const {
    return work_->reading();
}

const std::vector<FileChannel>& SurfaceSource::channels() const {
    return work_->channels();
}

}  // namespace asperity::studio

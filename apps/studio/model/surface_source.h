// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/pictures/height_map.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_settings.h>

#include <QObject>
#include <QString>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace asperity::studio {

/// A file of heights: as it was measured and, once that has succeeded, made ready.
struct FileReading {
    io::HeightMap before;
    std::string found, assumed;  ///< what the file said, and what it left open
    std::size_t missing = 0;     ///< points

    std::shared_ptr<const Heightfield> patch;  ///< made ready, not mirrored; null: not yet, or
                                               ///< refused
    io::HeightMap after;                       ///< of `patch`
    std::string prepared, tiling;              ///< what was done, and what fills the plane
};

/// A grid that a file holds.
struct FileChannel {
    std::string name;
    std::uint64_t nx = 0, ny = 0;
    std::string other;  ///< empty: heights; else what it holds, "image", "in V"
};

/// The surface of the settings, made or read by a thread of its own; the latest wish wins.
class SurfaceSource : public QObject {
    Q_OBJECT

  public:
    explicit SurfaceSource(QObject* parent = nullptr);
    ~SurfaceSource() override;  ///< stops what is under way

    /// Begins to make a surface; `ready` or `failed` follows in the main thread. The surface there
    /// was stays until then.
    void make(const SurfaceSettings& settings);
    /// Ends what is under way by `failed`; nothing where nothing is.
    void stop();

    bool busy() const;
    Progress progress() const;  ///< of what is under way
    /// Null before the first is ready. Never changes: a new one is another object.
    std::shared_ptr<const Heightfield> surface() const;
    std::uint64_t cells() const;                  ///< of surface(); 1 before the first is ready
    const SurfaceStatistics& statistics() const;  ///< of surface()
    const SurfaceSettings& settings() const;      ///< surface() was made from these

    /// Why the surface of the latest wish could not be made; empty: it was, or will be.
    const QString& trouble() const;
    /// Of the file of the latest wish, as far as it has come; null for other kinds and before.
    const FileReading* reading() const;
    /// What that file holds, in its order; empty before it was looked at and for other kinds.
    const std::vector<FileChannel>& channels() const;

  signals:
    void started();
    void read();  ///< reading() has its first half
    void ready();
    void failed(const QString& sentence);  ///< as the CLI prints it
    void channels_changed();

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace asperity::studio

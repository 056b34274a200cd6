// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_settings.h>

#include <QObject>
#include <QString>

#include <cstdint>
#include <memory>

namespace asperity::studio {

/// The surface of the settings, made or read by a thread of its own; the latest wish wins.
class SurfaceSource : public QObject {
    Q_OBJECT

  public:
    explicit SurfaceSource(QObject* parent = nullptr);
    ~SurfaceSource() override;  ///< stops what is under way

    /// Begins to make a surface; `ready` or `failed` follows in the main thread. The surface there
    /// was stays until then.
    void make(const SurfaceSettings& settings);

    bool busy() const;
    /// Null before the first is ready. Never changes: a new one is another object.
    std::shared_ptr<const Heightfield> surface() const;
    std::uint64_t cells() const;                  ///< of surface(); 1 before the first is ready
    const SurfaceStatistics& statistics() const;  ///< of surface()
    const SurfaceSettings& settings() const;      ///< surface() was made from these

  signals:
    void started();
    void ready();
    void failed(const QString& sentence);  ///< as the CLI prints it

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace asperity::studio

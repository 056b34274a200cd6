// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "background.h"

#include <asperity/surface/heightfield.h>
#include <asperity/surface/texture_figures.h>

#include <QObject>

#include <memory>
#include <vector>

namespace asperity::studio {

/// The figures that a laboratory quotes of a surface, found by a thread of its own; the latest wish
/// wins.
class FiguresOfSurface : public QObject {
    Q_OBJECT

  public:
    explicit FiguresOfSurface(QObject* parent = nullptr);

    /// `wavelength` in metres. `changed` follows, at once where they are known.
    void want(std::shared_ptr<const Heightfield> patch, double wavelength);
    void forget();  ///< also stops
    void stop();
    bool busy() const { return background_.busy(); }
    Progress progress() const { return run_ && busy() ? run_->progress() : Progress{}; }
    /// Empty as long as they are not known.
    const std::vector<TextureRow>& rows() const { return rows_; }

  signals:
    void changed();

  private:
    std::shared_ptr<const Heightfield> patch_;
    double wavelength_ = 0;
    std::vector<TextureRow> rows_;
    std::shared_ptr<Run> run_;
    Background background_;
};

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "background.h"
#include "drawing.h"
#include "settings.h"

#include <asperity/formats/images/render_writer.h>
#include <asperity/render/material.h>

#include <QDateTime>
#include <QObject>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace asperity::studio {

/// From the BRDF Settings to what a model wears. Analytic models are there at once; a simulated
/// BRDF is made from the layers drawn, or from a file (a result, or a BRDF in a format of
/// formats/bsdfs), by a thread of its own, once for each: a change of Normalize Factor or Albedo
/// finds it ready.
class WornBrdfs : public QObject {
    Q_OBJECT

  public:
    explicit WornBrdfs(Drawing& drawing, QObject* parent = nullptr);

    /// Sees to it that all a view wears is there or on its way; `changed` or `failed` follows.
    void wear(const ModelView& view);

    /// None as long as the simulated BRDF is not ready or the model cannot be made, see trouble()
    /// and busy(). Settings of a simulated BRDF outside their ranges are taken at their ends.
    std::optional<Material> material(const BrdfSettings& settings) const;
    /// A line for the user: "Cook-Torrance, roughness 0.4".
    QString description(const BrdfSettings& settings) const;
    /// The simulated BRDF's experiment, for pictures that show it.
    io::Provenance origin() const;

    bool busy() const { return background_.busy(); }
    Progress progress() const { return run_ != nullptr ? run_->progress() : Progress{}; }
    /// Why there is no BRDF though one is wanted; empty when there is, or soon will be.
    QString trouble() const;

  signals:
    void changed();
    void told();  ///< trouble() may be another
    void failed(const QString& sentence);

  private:
    /// What a simulated BRDF is made from: a measurement in memory, or a file as it was then.
    struct Source {
        std::shared_ptr<const Measurement> drawn;
        std::string file;
        QDateTime written;
        bool operator==(const Source&) const = default;
    };
    struct Simulated {
        Source source;
        std::shared_ptr<const Bsdf> brdf;
        QString surface;
        io::Provenance origin;
    };
    /// An analytic BRDF, or why there is none.
    struct Analytic {
        std::string spec;
        std::optional<Material> material;
        QString why;
    };
    static Simulated simulate(const Source& source, Run& run);
    void want(const Source& source);
    void take(const Simulated& made);
    void give_up(const QString& sentence);
    QString nothing_drawn() const;
    const Simulated* worn() const;
    const Analytic& analytic(const BrdfSettings& settings) const;

    Drawing& drawing_;
    Background background_;
    std::shared_ptr<Run> run_;  ///< of the simulated BRDF made last
    ModelView view_;
    std::optional<Source> wanted_;
    std::vector<Simulated> made_;  ///< the latest first
    QString trouble_;
    mutable std::deque<Analytic> analytic_;  ///< the latest last
};

}  // namespace asperity::studio

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
#include <utility>
#include <vector>

namespace asperity::studio {

/// From the BRDF Settings to what a model wears. Analytic models are there at once; a simulated
/// BRDF is made from the layers drawn, or from a file (a result, or a BRDF in a format of
/// formats/bsdfs), by a thread of its own, once for each: a change of Normalize Factor or Albedo
/// finds it ready. Each side of a comparison has its own.
class WornBrdfs : public QObject {
    Q_OBJECT

  public:
    explicit WornBrdfs(Drawing& drawing, QObject* parent = nullptr);

    /// Sees to it that all a view wears is there or on its way; `changed` or `failed` follows.
    void wear(const ModelView& view);

    /// None as long as the simulated BRDF is not ready or the model cannot be made, see trouble()
    /// and busy(). Settings of a simulated BRDF outside their ranges are taken at their ends.
    std::optional<Material> material(const BrdfSettings& settings) const;
    /// A line for the user: "Cook-Torrance, roughness 0.4", "Simulated, gaussian ...", "gold.bsdf".
    QString description(const BrdfSettings& settings) const;
    /// The experiments of simulated BRDFs, for pictures that show them; keys of the right one begin
    /// with "second-" where both sides wear one.
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
        bool nothing() const { return drawn == nullptr && file.empty(); }
        bool operator==(const Source&) const = default;
    };
    struct Simulated {
        Source source;
        std::shared_ptr<const Bsdf> brdf;
        QString name;           ///< of the surface, or of the file
        bool measured = false;  ///< a BRDF of others
        io::Provenance origin;
    };
    /// An analytic BRDF, or why there is none.
    struct Analytic {
        std::string spec;
        std::optional<Material> material;
        QString why;
    };
    static Simulated simulate(const Source& source, Run& run);
    static Source source_of(const BrdfSettings& settings, const Drawing& drawing);
    void want(std::vector<Source> sources);
    /// Begins the first of `wanted_` that is neither there nor known to fail, if nothing is made.
    void make_next();
    void take(const Simulated& made);
    void give_up(const QString& sentence);
    QString nothing_drawn() const;
    QString trouble_of(const BrdfSettings& settings) const;
    /// The source of a side as it was when it was wanted; null: it wears no simulated BRDF.
    const Source* wanted(const BrdfSettings& settings) const;
    const Simulated* worn(const BrdfSettings& settings) const;
    const Simulated* find(const Source& source) const;
    const Analytic& analytic(const BrdfSettings& settings) const;

    Drawing& drawing_;
    Background background_;
    std::shared_ptr<Run> run_;  ///< of the simulated BRDF made last
    ModelView view_;
    std::vector<Source> wanted_;    ///< of the left and the right side, each once
    std::optional<Source> making_;  ///< by the thread
    std::vector<Simulated> made_;   ///< the latest first
    std::vector<std::pair<Source, QString>> troubles_;  ///< of `wanted_`
    mutable std::deque<Analytic> analytic_;             ///< the latest last
};

}  // namespace asperity::studio

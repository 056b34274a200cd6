// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/background.h"
#include "plot_overlays.h"

#include <asperity/gonio/measurement.h>
#include <asperity/measured/normal_profile.h>
#include <asperity/surface/heightfield.h>

#include <QObject>
#include <QString>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace asperity::studio {

/// What the analytic curves of a plot depend on.
struct ModelWish {
    PlotKind kind = PlotKind::LobePolar;  ///< a lobe, the albedo or the normals
    std::vector<OverlayModel> models;
    std::shared_ptr<const Measurement> head;     ///< but for the normals: detector and facets
    double theta_i = 0, phi_i = 0;               ///< of lobes [rad]
    int channel = -1;                            ///< -1: the mean of all
    std::shared_ptr<const Heightfield> surface;  ///< of the normals

    /// Equal but for the models.
    bool same_scene(const ModelWish& other) const;
};

/// Curves of the models, found by a thread of its own.
struct ModelValues {
    ModelWish wish;
    std::vector<double> x;               ///< degrees: theta_o, theta_i or theta_m
    std::vector<std::vector<double>> y;  ///< of each model f, albedo or D; empty: it has none
    std::shared_ptr<const NormalProfile> normals;  ///< of the surface
    QString trouble;                               ///< why a model could not be made
};

/// Finds curves of models in the background and keeps the latest of each plot. A wish that comes
/// while another is worked on waits for it, so that a slider being dragged shows on the way.
class ModelCurves : public QObject {
    Q_OBJECT

  public:
    explicit ModelCurves(QObject* parent = nullptr);

    void want(const ModelWish& wish);
    /// The latest of the wish's scene, whatever the models; null: none yet.
    const ModelValues* find(const ModelWish& wish) const;

  signals:
    void changed();
    void failed(const QString& sentence);

  private:
    void start(const ModelWish& wish);
    void serve_waiting();
    void take(std::shared_ptr<const ModelValues> values);

    Background background_;
    std::optional<ModelWish> waiting_;
    std::map<PlotKind, std::shared_ptr<const ModelValues>> found_;
};

}  // namespace asperity::studio

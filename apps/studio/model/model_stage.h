// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "loaded_model.h"
#include "model_painting.h"
#include "scene_lights.h"
#include "workbench.h"
#include "worn_brdfs.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <optional>

namespace asperity::studio {

/// The scene "Model" without its window: brings model, lights and BRDFs together as the settings
/// say, and tells what there is to be seen. Errors come as Workbench::complaint.
class ModelStage : public QObject {
    Q_OBJECT

  public:
    explicit ModelStage(Workbench& workbench, QObject* parent = nullptr);

    /// Load Model: a built-in model's name, or a file. When it is ready it becomes a setting, in
    /// one step with going over to this scene; otherwise all stays as it was.
    void load(const QString& name_or_file);
    const LoadedModel& model() const { return model_; }

    /// None as long as there is no model. Black as long as the BRDF does not run, or is not ready.
    std::optional<ModelSight> sight() const;
    std::uint64_t number() const { return number_; }  ///< of sight()

    /// The line between two BRDFs is to be seen.
    bool is_split() const;
    QString left_name() const;
    QString right_name() const;
    /// What the user should know of a picture that is not as wished for; empty when it is.
    QString message() const;

    /// How `asperity render` makes the picture, as far as its options go.
    io::Provenance provenance(const Camera& camera) const;

  signals:
    void changed(bool moving);  ///< another sight(); moving: more changes seem to follow at once
    void message_changed();
    void model_ready();

  private:
    const ModelView& view() const { return workbench_.settings().model_view; }
    void follow(const StudioSettings& before);
    void load_from_settings();
    void take_model();
    void see_anew();
    void tell();
    Material worn(const BrdfSettings& settings) const;

    Workbench& workbench_;
    LoadedModel model_;
    SceneLights lights_;
    WornBrdfs brdfs_;
    QElapsedTimer since_change_;
    QTimer telling_;
    bool asked_ = false;  ///< the model under way was asked for by load()
    std::uint64_t number_ = 0;
};

}  // namespace asperity::studio

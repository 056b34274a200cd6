// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "background.h"

#include <asperity/render/mesh.h>
#include <asperity/render/traced_model.h>

#include <QObject>

#include <memory>
#include <string>

namespace asperity::studio {

/// The model that is looked at: read, or made, and prepared for rays by a thread of its own. The
/// latest wish wins; the model there was stays until the next is ready.
class LoadedModel : public QObject {
    Q_OBJECT

  public:
    explicit LoadedModel(QObject* parent = nullptr);

    /// A built-in model's name, or a file; `ready` or `failed` follows. `floor`: on a floor.
    void load(const std::string& name, bool floor);
    void forget();  ///< no model; ends what is under way

    bool busy() const { return background_.busy(); }
    /// The model that is wished for: name() unless busy().
    const std::string& wanted() const { return wanted_; }
    bool wanted_floor() const { return wanted_floor_; }

    const std::string& name() const { return name_; }  ///< of traced(), as load() was given it
    /// Null before the first is ready. Never changes: a new one is another object.
    std::shared_ptr<const TracedModel> traced() const { return traced_; }
    /// Of the model without the floor; zeros without one.
    ModelStatistics statistics() const;

  signals:
    void started();
    void ready();
    void failed(const QString& sentence);  ///< as the CLI prints it
    void remarked(const QString& line);    ///< what was left out of the file

  private:
    struct Found;
    void take(const Found& found);
    void give_up(const QString& sentence);

    Background background_;
    std::string wanted_, name_;
    bool wanted_floor_ = false, floor_ = false;
    std::shared_ptr<const Model> model_;  ///< without the floor
    std::shared_ptr<const TracedModel> traced_;
};

}  // namespace asperity::studio

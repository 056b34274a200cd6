// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/experiment.h>
#include <asperity/gonio/light_paths.h>
#include <asperity/surface/heightfield.h>

#include <QObject>

#include <memory>
#include <optional>
#include <vector>

namespace asperity::studio {

/// "Seeing the light": paths of the current layer, found by a thread of its own.
class LightSeen : public QObject {
    Q_OBJECT

  public:
    struct Wish {
        std::shared_ptr<const Heightfield> surface;
        Experiment experiment;
        int layer = 15;
        std::size_t count = 200;
        std::optional<int> cell;  ///< of the detector: only paths that end in it
    };

    explicit LightSeen(QObject* parent = nullptr);
    ~LightSeen() override;

    void look(const Wish& wish);  ///< the latest wish wins; `changed` follows
    void forget();                ///< no paths

    bool busy() const;
    const std::optional<Wish>& wish() const;  ///< of paths()
    const std::vector<LightPath>& paths() const;

  signals:
    void changed();

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace asperity::studio

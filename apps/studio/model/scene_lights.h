// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "background.h"
#include "settings.h"

#include <asperity/render/image.h>
#include <asperity/render/light.h>

#include <QObject>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace asperity::studio {

/// The lights of the scene "Model". A point shines at once; a sky is worked out and a picture of
/// the surroundings read by a thread of its own, while the lights there were go on shining.
class SceneLights : public QObject {
    Q_OBJECT

  public:
    using Lights = std::vector<std::shared_ptr<const Light>>;

    explicit SceneLights(QObject* parent = nullptr);

    /// Lights as the settings say; `changed` follows when they are others, `failed` when they
    /// cannot be had.
    void shine(const ModelView& view);

    const Lights& lights() const { return lights_; }
    /// They are drawn behind the model: sky or surroundings.
    bool are_seen() const { return seen_; }
    bool busy() const { return background_.busy(); }
    /// Why the lights are not those of the settings; empty when they are, or on their way.
    const QString& trouble() const { return trouble_; }

  signals:
    void changed();
    void failed(const QString& sentence);

  private:
    /// The settings that decide the lights.
    struct Wish {
        LightKind kind = LightKind::Point;
        Vec3 position;
        double intensity = 0, sun_elevation_deg = 0, sun_azimuth_deg = 0;
        std::string environment;
        double rotation_deg = 0;
        bool operator==(const Wish&) const = default;
    };
    /// Surroundings as read: turned about, they need not be read again.
    struct Surroundings {
        std::string file;
        std::shared_ptr<const Image> map;
    };
    static Wish wish_of(const ModelView& view);
    void make(const Wish& wish);
    void take(Lights lights, bool seen);
    void give_up(const QString& sentence);

    Background background_;
    std::optional<Wish> wish_;
    Lights lights_;
    std::shared_ptr<const Light> soft_;
    bool seen_ = false;
    Surroundings surroundings_;
    QString trouble_;
};

}  // namespace asperity::studio

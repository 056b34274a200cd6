// SPDX-License-Identifier: Apache-2.0
#include "scene_lights.h"

#include "soft_sky.h"

#include <asperity/core/error.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/sky.h>

#include <utility>

namespace asperity::studio {

namespace {

SceneLights::Lights point_light(Vec3 position, double intensity) {
    return {make_light(PointLightSettings{position, intensity, {1, 1, 1}})};
}

SceneLights::Lights sky(double elevation_deg, double azimuth_deg) {
    SkySettings settings;
    settings.sun_elevation_deg = elevation_deg;
    settings.sun_azimuth_deg = azimuth_deg;
    SceneLights::Lights lights;
    for (auto& light : make_sky(settings)) lights.push_back(std::move(light));
    return lights;
}

}  // namespace

SceneLights::SceneLights(QObject* parent)
    : QObject(parent), background_(this, [this](const QString& sentence) { give_up(sentence); }) {}

SceneLights::Wish SceneLights::wish_of(const ModelView& view) {
    // What the kind of light does not use is left out: it changes nothing
    Wish wish;
    wish.kind = view.light;
    if (view.light == LightKind::Point) {
        wish.position = view.light_position;
        wish.intensity = view.light_intensity;
    } else if (view.light == LightKind::Sky) {
        wish.sun_elevation_deg = view.sun_elevation_deg;
        wish.sun_azimuth_deg = view.sun_azimuth_deg;
    } else if (view.light == LightKind::Environment) {
        wish.environment = view.environment;
        wish.rotation_deg = view.environment_rotation_deg;
    }
    return wish;
}

void SceneLights::shine(const ModelView& view) {
    const Wish wish = wish_of(view);
    if (wish_ == wish) return;
    wish_ = wish;
    trouble_.clear();
    make(wish);
}

void SceneLights::make(const Wish& wish) {
    if (wish.kind == LightKind::Point) {
        background_.cancel();
        try {
            take(point_light(wish.position, wish.intensity), false);
        } catch (const Error& error) {
            give_up(QString::fromUtf8(error.what()));
        }
    } else if (wish.kind == LightKind::Sky) {
        background_.start([this, wish](Run&, const auto&) -> Background::Delivery {
            const Lights lights = sky(wish.sun_elevation_deg, wish.sun_azimuth_deg);
            return [this, lights] { take(lights, true); };
        });
    } else if (wish.kind == LightKind::Soft) {
        background_.cancel();
        if (soft_ == nullptr) soft_ = make_soft_sky();
        take({soft_}, true);
    } else if (wish.environment.empty()) {
        background_.cancel();
        trouble_ = tr("choose an environment: a latitude-longitude picture, .exr or .hdr");
        emit changed();
    } else {
        const bool known = surroundings_.file == wish.environment;
        background_.start([this, wish, map = known ? surroundings_.map : nullptr](
                              Run&, const auto&) -> Background::Delivery {
            const Surroundings found{
                wish.environment,
                map ? map : std::make_shared<const Image>(io::read_image(wish.environment))};
            EnvironmentMapSettings settings;
            settings.rotation_deg = wish.rotation_deg;
            settings.name = wish.environment;
            const std::shared_ptr<const Light> light = make_environment_light(*found.map, settings);
            return [this, found, light] {
                surroundings_ = found;
                take({light}, true);
            };
        });
    }
}

void SceneLights::take(Lights lights, bool seen) {
    lights_ = std::move(lights);
    seen_ = seen;
    emit changed();
}

void SceneLights::give_up(const QString& sentence) {
    trouble_ = sentence;
    emit failed(sentence);
    emit changed();
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "model_stage.h"

#include "picture_provenance.h"

#include <asperity/bsdf/models/lambert.h>

#include <QFileInfo>

#include <algorithm>
#include <tuple>
#include <vector>

namespace asperity::studio {

namespace {

constexpr int kTellEveryMs = 100;
/// Changes closer together than this are a movement of the hand, and the picture one of a moving
/// view.
constexpr qint64 kMovementMs = 250;

auto fields(const BrdfSettings& s) {
    return std::tie(s.type, s.model, s.settings, s.result, s.normalize_factor, s.diffuse);
}

/// All that decides the picture but the camera.
auto fields(const ModelView& v) {
    return std::tuple_cat(fields(v.brdf), fields(v.second),
                          std::tie(v.model, v.floor, v.brdf_runs, v.compare, v.split, v.light,
                                   v.light_position, v.light_intensity, v.sun_elevation_deg,
                                   v.sun_azimuth_deg, v.environment, v.environment_rotation_deg,
                                   v.depth, v.tone.exposure, v.tone.curve, v.tone.transfer));
}

Material black() {
    return Material(std::make_shared<LambertBrdf>(std::vector<double>{0.0}));
}

/// A silhouette stands on nothing.
bool wants_floor(const ModelView& view) {
    return view.floor && view.brdf_runs;
}

}  // namespace

ModelStage::ModelStage(Workbench& workbench, QObject* parent)
    : QObject(parent), workbench_(workbench), brdfs_(workbench.drawing()) {
    telling_.setInterval(kTellEveryMs);
    connect(&telling_, &QTimer::timeout, this, &ModelStage::tell);
    connect(&workbench.document(), &Document::changed, this, &ModelStage::follow);

    connect(&model_, &LoadedModel::started, this, &ModelStage::tell);
    connect(&model_, &LoadedModel::ready, this, &ModelStage::take_model);
    connect(&model_, &LoadedModel::remarked, &workbench,
            [this](const QString& line) { workbench_.log(tr("model: %1").arg(line)); });
    connect(&model_, &LoadedModel::failed, this, [this] { asked_ = false; });
    connect(&model_, &LoadedModel::failed, this, &ModelStage::tell);
    connect(&lights_, &SceneLights::changed, this, &ModelStage::see_anew);
    connect(&brdfs_, &WornBrdfs::changed, this, &ModelStage::see_anew);
    connect(&brdfs_, &WornBrdfs::told, this, &ModelStage::tell);
    connect(&model_, &LoadedModel::failed, &workbench, &Workbench::complaint);
    connect(&lights_, &SceneLights::failed, &workbench, &Workbench::complaint);
    // What a BRDF lacks matters where it is worn; there message() goes on saying so
    connect(&brdfs_, &WornBrdfs::failed, this, [this](const QString& sentence) {
        if (workbench_.settings().scene == SceneKind::Model && model_.traced() != nullptr)
            emit workbench_.complaint(sentence);
    });

    load_from_settings();
    lights_.shine(view());
    brdfs_.wear(view());
}

void ModelStage::load(const QString& name_or_file) {
    asked_ = true;
    model_.load(name_or_file.toStdString(), wants_floor(view()));
}

void ModelStage::take_model() {
    see_anew();
    if (asked_) {
        asked_ = false;
        workbench_.document().change(tr("Load Model"), [this](StudioSettings& settings) {
            settings.model_view.model = model_.name();
            settings.scene = SceneKind::Model;
        });
    }
    emit model_ready();
}

void ModelStage::load_from_settings() {
    const std::string& wanted = view().model;
    if (wanted.empty()) {
        model_.forget();
    } else if (wanted != model_.wanted() || wants_floor(view()) != model_.wanted_floor()) {
        asked_ = false;
        model_.load(wanted, wants_floor(view()));
    }
}

void ModelStage::follow(const StudioSettings& before) {
    const ModelView& then = before.model_view;
    if (fields(then) == fields(view())) return;
    const bool moving = since_change_.isValid() && since_change_.elapsed() < kMovementMs;
    since_change_.start();
    if (then.model != view().model || wants_floor(then) != wants_floor(view()))
        load_from_settings();
    lights_.shine(view());
    brdfs_.wear(view());
    ++number_;
    emit changed(moving);
    tell();
}

/// Model, lights or BRDF came from the background.
void ModelStage::see_anew() {
    ++number_;
    emit changed(lights_.busy());
    tell();
}

void ModelStage::tell() {
    const bool under_way = model_.busy() || (view().brdf_runs && brdfs_.busy());
    if (under_way != telling_.isActive()) under_way ? telling_.start() : telling_.stop();
    emit message_changed();
}

Material ModelStage::worn(const BrdfSettings& settings) const {
    return brdfs_.material(settings).value_or(black());
}

std::optional<ModelSight> ModelStage::sight() const {
    if (model_.traced() == nullptr) return std::nullopt;
    ModelSight sight{.scene = {.model = model_.traced(),
                               .material = black(),
                               .split = std::nullopt,
                               .lights = {}},
                     .depth = view().depth,
                     .tone = view().tone,
                     .number = number_};
    if (!view().brdf_runs) return sight;
    sight.scene.material = worn(view().brdf);
    if (view().compare)
        sight.scene.split = SplitView{worn(view().second), std::clamp(view().split, 0.0, 1.0)};
    sight.scene.lights = lights_.lights();
    sight.backdrop = !lights_.are_seen();
    return sight;
}

bool ModelStage::is_split() const {
    return view().compare && view().brdf_runs && model_.traced() != nullptr;
}

QString ModelStage::left_name() const {
    return brdfs_.description(view().brdf);
}

QString ModelStage::right_name() const {
    return brdfs_.description(view().second);
}

QString ModelStage::message() const {
    if (model_.busy()) {
        const QFileInfo file(QString::fromStdString(model_.wanted()));
        return tr("loading %1 …").arg(file.fileName());
    }
    if (model_.traced() == nullptr)
        return tr("Load Model, or drop one here: .obj .ply .stl .gltf .glb .3ds");
    if (!view().brdf_runs) return {};
    if (brdfs_.busy()) {
        const Progress p = brdfs_.progress();
        const double done =
            p.total > 0 ? static_cast<double>(p.done) / static_cast<double>(p.total) : 0;
        return tr("preparing the simulated BRDF: %1 %").arg(static_cast<int>(100 * done));
    }
    return brdfs_.trouble().isEmpty() ? lights_.trouble() : brdfs_.trouble();
}

io::Provenance ModelStage::provenance(const Camera& camera) const {
    return picture_provenance(view(), model_.name(), camera, brdfs_);
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "loaded_model.h"

#include <asperity/core/error.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/render/builtin_models.h>

#include <QFileInfo>
#include <QStringList>

#include <utility>

namespace asperity::studio {

/// What the thread brings.
struct LoadedModel::Found {
    std::string name;
    bool floor = false;
    std::shared_ptr<const Model> model;
    std::shared_ptr<const TracedModel> traced;
    QStringList remarks;
};

namespace {

/// Reads or makes a model as the command line does.
std::shared_ptr<const Model> fetch(const std::string& name, QStringList& remarks) {
    if (is_builtin_model(name)) return std::make_shared<Model>(make_builtin_model(name));
    if (!io::is_model_file(name)) {
        const QFileInfo file(QString::fromStdString(name));
        if (!file.exists() && file.suffix().isEmpty() && name.find('/') == std::string::npos)
            make_builtin_model(name);  // says which names there are
        throw Error(ErrorCode::InvalidInput,
                    file.exists() ? "is no model: .obj, .ply, .stl, .gltf, .glb and .3ds are read"
                                  : "there is no such file",
                    name);
    }
    io::ModelFile file = io::read_model(name);
    if (file.dropped_triangles > 0) {
        remarks << QStringLiteral(
                       "%1 triangles without area or with vertices that are not finite "
                       "left out")
                       .arg(file.dropped_triangles);
    }
    for (const std::string& remark : file.remarks) remarks << QString::fromStdString(remark);
    return std::make_shared<Model>(std::move(file.model));
}

std::shared_ptr<const TracedModel> trace(const Model& model, bool floor, Run& run) {
    if (!floor) return std::make_shared<TracedModel>(model, run);
    Model standing = model;
    add_floor(standing);
    return std::make_shared<TracedModel>(standing, run);
}

}  // namespace

LoadedModel::LoadedModel(QObject* parent)
    : QObject(parent), background_(this, [this](const QString& sentence) { give_up(sentence); }) {}

void LoadedModel::load(const std::string& name, bool floor) {
    // The floor alone changes: the file need not be read again
    const bool same = model_ != nullptr && name == name_ && name == wanted_ && floor != floor_;
    wanted_ = name;
    wanted_floor_ = floor;
    background_.start([this, name, floor, known = same ? model_ : nullptr](
                          Run& run, const auto&) -> Background::Delivery {
        Found found{name, floor, known, nullptr, {}};
        if (found.model == nullptr) found.model = fetch(name, found.remarks);
        found.traced = trace(*found.model, floor, run);
        return [this, found] { take(found); };
    });
    emit started();
}

void LoadedModel::forget() {
    background_.cancel();
    wanted_.clear();
    name_.clear();
    model_ = nullptr;
    traced_ = nullptr;
}

ModelStatistics LoadedModel::statistics() const {
    return model_ != nullptr ? asperity::statistics(*model_) : ModelStatistics{};
}

void LoadedModel::take(const Found& found) {
    name_ = found.name;
    floor_ = found.floor;
    model_ = found.model;
    traced_ = found.traced;
    for (const QString& remark : found.remarks) emit remarked(remark);
    emit ready();
}

void LoadedModel::give_up(const QString& sentence) {
    wanted_ = name_;
    wanted_floor_ = floor_;
    emit failed(sentence);
}

}  // namespace asperity::studio

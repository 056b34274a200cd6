// SPDX-License-Identifier: Apache-2.0
#include "model_scene.h"

#include "file_kinds.h"
#include "file_questions.h"
#include "picture_labels.h"
#include "split_handle.h"

#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/results/result_file.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QMimeData>
#include <QPainter>
#include <QThread>
#include <QVBoxLayout>

#include <array>

namespace asperity::studio {

namespace {

/// The thesis' grey, where there is no model yet.
const QColor kEmpty(170, 170, 170);

/// Models fill most of the view, seen a little from above.
Orbiter home() {
    Orbiter orbiter;
    orbiter.elevation_deg = 8;
    return orbiter;
}

bool is_environment_file(const QString& path) {
    const QString ending = QFileInfo(path).suffix().toLower();
    return ending == "exr" || ending == "hdr";
}

}  // namespace

ModelScene::ModelScene(Workbench& workbench, QWidget* parent)
    : QWidget(parent),
      workbench_(workbench),
      stage_(new ModelStage(workbench, this)),
      viewport_(new Viewport(this)),
      handle_(new SplitHandle(viewport_)),
      negative_(std::make_shared<Negative>()) {
    setAcceptDrops(true);
    viewport_->setObjectName("model-viewport");
    viewport_->setAccessibleName(tr("The model"));
    viewport_->set_home(home());
    viewport_->set_camera_type(workbench.settings().model_view.camera_type);
    viewport_->add_overlay([this](QPainter& painter, const Viewport&) { paint_over(painter); });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(viewport_);

    connect(stage_, &ModelStage::changed, this, &ModelScene::see);
    connect(stage_, &ModelStage::message_changed, viewport_, &Viewport::refresh_overlay);
    connect(stage_, &ModelStage::model_ready, this, &ModelScene::model_ready);
    connect(&viewport_->painter(), &Painter::failed, &workbench, &Workbench::complaint);
    connect(&workbench.document(), &Document::changed, this, [this](const StudioSettings& before) {
        const CameraType type = workbench_.settings().model_view.camera_type;
        if (type != before.model_view.camera_type) viewport_->set_camera_type(type);
        const KeptCamera& camera = workbench_.settings().model_view.camera;
        if (camera != before.model_view.camera) viewport_->set_camera(camera);
    });
    connect(handle_, &SplitHandle::moved, this, [this](double position) {
        workbench_.document().change(tr("Split"), [position](StudioSettings& settings) {
            settings.model_view.split = position;
        });
    });
    workbench.document().before_saving([this](StudioSettings& settings) {
        settings.model_view.camera = kept(viewport_->camera());
    });
    show_split();
}

bool ModelScene::has_model() const {
    return stage_->model().traced() != nullptr;
}

ModelStatistics ModelScene::statistics() const {
    return stage_->model().statistics();
}

// The picture

void ModelScene::see(bool moving) {
    show_split();
    if (has_model() != seen_) {
        seen_ = has_model();
        viewport_->set_picture(seen_ ? picture() : Viewport::Picture());
    }
    if (!isVisible()) {
        viewport_->painter().stop();  // what nobody sees need not be painted
    } else if (seen_) {
        viewport_->refresh(moving);
    }
}

Viewport::Picture ModelScene::picture() const {
    return
        [this](const Camera& camera) { return paint_model(*stage_->sight(), camera, negative_); };
}

void ModelScene::show_split() {
    handle_->set_position(workbench_.settings().model_view.split);
    handle_->setVisible(stage_->is_split());
}

void ModelScene::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    see(false);
}

void ModelScene::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    viewport_->painter().stop();
}

void ModelScene::paint_over(QPainter& painter) const {
    const QRectF all = viewport_->rect();
    if (!seen_) painter.fillRect(all, kEmpty);
    if (stage_->is_split()) {
        const double line = handle_->position() * all.width();
        paint_label(painter, QRectF(0, 0, line, all.height()), Qt::AlignTop | Qt::AlignLeft,
                    stage_->left_name());
        paint_label(painter, QRectF(line, 0, all.width() - line, all.height()),
                    Qt::AlignTop | Qt::AlignRight, stage_->right_name());
    }
    const QString message = stage_->message();
    if (!message.isEmpty()) paint_label(painter, all, Qt::AlignBottom | Qt::AlignHCenter, message);
}

// Files

void ModelScene::load_with_dialog() {
    ask_file_to_open(window(), tr("Load Model"), model_filter(),
                     [this](const QString& path) { load(path); });
}

void ModelScene::load(const QString& name_or_file) {
    stage_->load(name_or_file);
}

void ModelScene::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void ModelScene::dropEvent(QDropEvent* event) {
    for (const QUrl& url : event->mimeData()->urls()) take_file(url.toLocalFile());
    event->acceptProposedAction();
}

void ModelScene::take_file(const QString& path) {
    const std::string file = path.toStdString();
    Document& document = workbench_.document();
    if (io::is_model_file(file)) {
        load(path);
    } else if (io::looks_like_result(file)) {
        wear_file(path);
    } else if (is_environment_file(path)) {
        document.change(tr("Environment"), [&](StudioSettings& settings) {
            settings.model_view.light = LightKind::Environment;
            settings.model_view.environment = file;
        });
    } else if (io::BsdfFormats().can_read(file)) {
        wear_file(path);
    } else {
        emit workbench_.complaint(
            tr("%1: neither a model (.obj .ply .stl .gltf .glb .3ds), nor a result of asperity "
               "simulate or another BRDF, nor an environment (.exr .hdr)")
                .arg(path));
    }
}

/// The side that wears a simulated BRDF takes it, the left one where both or neither do.
void ModelScene::wear_file(const QString& path) {
    workbench_.document().change(tr("Open Result"), [&](StudioSettings& settings) {
        ModelView& view = settings.model_view;
        const bool right = view.compare && view.second.type == BrdfType::Simulated &&
                           view.brdf.type != BrdfType::Simulated;
        BrdfSettings& side = right ? view.second : view.brdf;
        side.type = BrdfType::Simulated;
        side.result = path.toStdString();
    });
}

void ModelScene::save_picture(const QString& path) {
    const std::string file = path.toStdString();
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending != "png" && ending != "exr")
        throw Error(ErrorCode::Usage, "the name must end in .png or .exr", file);
    wait_for_picture();
    const io::Provenance provenance = stage_->provenance(viewport_->camera());
    if (ending == "png") {
        negative_->save_png(file, provenance);
    } else {
        negative_->save_exr(file, provenance);
    }
}

QSize ModelScene::full_size() const {
    return (QSizeF(viewport_->size()) * viewport_->devicePixelRatioF()).toSize();
}

bool ModelScene::is_settled() const {
    return negative_->shows(stage_->number(), viewport_->camera(), full_size());
}

/// Sees to it that the negative is of what the settings say, at full resolution: the view may have
/// been moving a moment ago. A first pass takes a fraction of a second.
void ModelScene::wait_for_picture() {
    constexpr qint64 kLongestMs = 30000;
    if (!has_model())
        throw Error(ErrorCode::Usage, "there is no picture to be saved: load a model first");
    if (is_settled()) return;
    viewport_->painter().paint(picture()(viewport_->camera()), full_size(), false);
    QElapsedTimer waited;
    waited.start();
    while (!is_settled()) {
        if (waited.elapsed() > kLongestMs)
            throw Error(ErrorCode::Stopped, "the picture took too long to be made");
        QThread::msleep(5);
    }
}

}  // namespace asperity::studio

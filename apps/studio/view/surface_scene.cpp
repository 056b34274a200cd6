// SPDX-License-Identifier: Apache-2.0
#include "surface_scene.h"

#include "beam_overlay.h"
#include "dome_overlay.h"
#include "paths_overlay.h"
#include "picture_labels.h"
#include "surface_labels.h"

#include "../model/words.h"

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/tracing/launch.h>

#include <QEvent>
#include <QKeyEvent>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

namespace {

constexpr int kGrowMs = 100;

/// Behind the light of small azimuths, the lobe ahead over the surface, the dome all around.
Orbiter home_within() {
    Orbiter home;
    home.target = {0, 0.55, 0};
    home.distance = 4.6;
    home.azimuth_deg = 62;
    home.elevation_deg = 13;
    home.fov_deg = 50;
    return home;
}

/// Outside the dome, all of it in view: the light comes from the right, the lobe lies to the left.
Orbiter home_outside() {
    Orbiter home;
    home.target = {0, 0.8, 0};
    home.distance = 10.2;
    home.azimuth_deg = 32;
    home.elevation_deg = 22;
    home.fov_deg = 36;
    return home;
}

void set_home(Viewport& viewport, const SurfaceView& view) {
    constexpr double kDomeAspect = 1.16;  // of a window that the whole dome just fits into
    if (view.whole_dome)
        viewport.set_home(home_outside(), kDomeAspect);
    else
        viewport.set_home(home_within());
}

/// Reflectance along the normal, as linear sRGB; none unless facets are of a metal or coloured.
std::optional<Vec3> metal_of(const OpticsSettings& optics) {
    if (optics.fresnel != FresnelKind::Conductor) return std::nullopt;
    try {
        const Fresnel fresnel(optics);
        std::vector<double> f(static_cast<std::size_t>(fresnel.channels()));
        fresnel.eval(1, f);
        if (f.size() == 3) return Vec3{f[0], f[1], f[2]};
        return Vec3{f[0], f[0], f[0]};
    } catch (const Error&) {  // being typed
        return std::nullopt;
    }
}

bool same_look(const io::SkyMapSettings& a, const io::SkyMapSettings& b) {
    return a.colour_map == b.colour_map && a.scale == b.scale && a.decades == b.decades &&
           a.channel == b.channel;
}

/// Whether the plots show the same models, made alike.
bool same_models(const PlotView& a, const PlotView& b) {
    return a.follow_surface == b.follow_surface && a.overlays == b.overlays &&
           a.overlay_settings == b.overlay_settings;
}

/// The incidence of a layer; none if the experiment has no such layer.
std::optional<Incidence> incidence_of(const IlluminationSettings& light, int number) {
    const std::vector<Incidence> all = incidences(light);
    const auto found = std::find_if(all.begin(), all.end(),
                                    [number](const Incidence& i) { return i.number == number; });
    return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

SurfaceScene::SurfaceScene(Workbench& workbench, QWidget* parent)
    : QWidget(parent), workbench_(workbench), viewport_(new Viewport(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(viewport_);
    viewport_->setObjectName("surface-viewport");
    viewport_->setAccessibleName(tr("Microfacets Surface"));
    setFocusProxy(viewport_);
    growing_.setSingleShot(true);
    growing_.setInterval(kGrowMs);
    set_home(*viewport_, workbench_.settings().surface_view);
    viewport_->set_camera_type(workbench_.settings().surface_view.camera_type);
    viewport_->add_overlay(
        [this](QPainter& painter, const Viewport&) { paint_kept_lines(painter); });
    viewport_->add_overlay([this](QPainter& painter, const Viewport&) { paint_labels(painter); });
    workbench.document().before_saving([this](StudioSettings& settings) {
        settings.surface_view.camera = kept(viewport_->camera());
    });
    connect_workbench();
    connect_viewport();
    take_layer();
    take_paths();
    take_surface();
}

void SurfaceScene::connect_workbench() {
    connect(&workbench_.document(), &Document::changed, this, &SurfaceScene::follow_settings);
    connect(&workbench_.surface(), &SurfaceSource::ready, this, &SurfaceScene::take_surface);
    for (const auto signal : {&SurfaceSource::started, &SurfaceSource::ready})
        connect(&workbench_.surface(), signal, viewport_, &Viewport::refresh_overlay);
    connect(&workbench_.surface(), &SurfaceSource::failed, viewport_, &Viewport::refresh_overlay);
    connect(&workbench_.light(), &LightSeen::changed, this, [this] {
        take_paths();
        show_picture();
    });
    connect(&workbench_, &Workbench::cell_selected, this, [this] {
        take_paths();
        show_picture();
    });
    connect(&workbench_.drawing(), &Drawing::layers_changed, this, [this](int number) {
        if (number != 0 && number != workbench_.settings().surface_view.current_layer) return;
        if (!growing_.isActive()) growing_.start();
    });
    connect(&workbench_.drawing(), &Drawing::completed, &growing_, qOverload<>(&QTimer::start));
    connect(&growing_, &QTimer::timeout, this, [this] {
        take_layer();
        show_picture();
    });
}

void SurfaceScene::connect_viewport() {
    connect(viewport_, &Viewport::clicked, this, &SurfaceScene::click);
    connect(viewport_, &Viewport::hovered, this, &SurfaceScene::hover);
    connect(&viewport_->painter(), &Painter::failed, &workbench_, &Workbench::complaint);
    viewport_->installEventFilter(this);
}

// What is shown

void SurfaceScene::follow_settings(const StudioSettings& before) {
    const SurfaceView &then = before.surface_view, &now = workbench_.settings().surface_view;
    if (then.camera_type != now.camera_type) viewport_->set_camera_type(now.camera_type);
    if (then.whole_dome != now.whole_dome) set_home(*viewport_, now);
    if (then.camera != now.camera) viewport_->set_camera(now.camera);
    const Detector wanted(workbench_.settings().experiment.detector);
    const PlotView& plots = workbench_.settings().plots;
    const bool other_models = then.model_lobes != now.model_lobes ||
                              (now.model_lobes && !same_models(before.plots, plots));
    const bool other_layer =
        other_models || then.current_layer != now.current_layer || then.dome != now.dome ||
        then.lobe != now.lobe || !same_look(then.sky_map, now.sky_map) ||
        wanted.cells() != detector_.cells() || wanted.kind() != detector_.kind();
    if (other_layer) take_layer();
    if (other_layer || then.shading != now.shading ||
        metal_of(before.experiment.optics) != metal_of(workbench_.settings().experiment.optics))
        show_picture();
    else
        forget_lines();
}

void SurfaceScene::take_surface() {
    const std::shared_ptr<const Heightfield> surface = workbench_.surface().surface();
    body_ =
        surface
            ? std::make_shared<const Lazy<SurfaceBody>>([surface] { return SurfaceBody(*surface); })
            : nullptr;
    // Models may follow its slopes
    if (workbench_.settings().surface_view.model_lobes) take_layer();
    show_picture();
}

/// The layer as it is now, and the detector whose cells the dome is made of.
void SurfaceScene::take_layer() {
    const StudioSettings& settings = workbench_.settings();
    const Layers& layers = workbench_.drawing().layers();
    detector_ = layers.head ? layers.head->detector : Detector(settings.experiment.detector);
    dome_ = nullptr;
    lobe_ = nullptr;
    model_lobes_.clear();
    const auto found = layers.by_number.find(settings.surface_view.current_layer);
    if (!layers.head || found == layers.by_number.end()) return;
    const auto made = [&, layer = found->second]<class Part>(std::type_identity<Part>) {
        return std::make_shared<const Lazy<Part>>(
            [head = layers.head, layer, look = settings.surface_view.sky_map] {
                return Part(*head, *layer, look);
            });
    };
    if (settings.surface_view.dome) dome_ = made(std::type_identity<DomePicture>());
    if (settings.surface_view.lobe) lobe_ = made(std::type_identity<Lobe>());
    if (!settings.surface_view.model_lobes) return;
    std::optional<double> alpha;
    if (workbench_.surface().surface()) alpha = workbench_.surface().statistics().rms_gradient;
    model_lobes_ = model_lobes(settings.plots, alpha, layers, found->second,
                               settings.surface_view.sky_map, palette());
}

/// The facets of the paths into a cell stand out; those of all paths would be all over.
void SurfaceScene::take_paths() {
    const auto& wish = workbench_.light().wish();
    const bool of_cell = workbench_.selected_cell() && wish && wish->cell;
    selected_facets_ =
        of_cell ? std::make_shared<const FacetSet>(workbench_.light().paths()) : nullptr;
}

void SurfaceScene::show_picture() {
    forget_lines();
    std::vector<std::shared_ptr<const Lazy<Lobe>>> lobes;
    if (lobe_) lobes.push_back(lobe_);
    for (const ModelLobe& model : model_lobes_) lobes.push_back(model.lobe);
    const SurfacePicture picture{body_,
                                 dome_,
                                 workbench_.settings().surface_view.shading,
                                 selected_facets_,
                                 metal_of(workbench_.settings().experiment.optics),
                                 std::move(lobes)};
    viewport_->set_picture(
        [picture](const Camera& camera) { return paint_surface(picture, camera); });
}

// Cells of the dome

std::optional<int> SurfaceScene::cell_at(QPointF place) const {
    const WorldRay ray = viewport_->ray_at(place);
    const SurfaceBody* surface = body();
    PatchHit on_surface;
    if (surface) on_surface = surface->view().look(surface->frame().to_surface(ray));
    const bool hidden = on_surface.part != PatchPart::None;
    if (const Lobe* lobe = lobe_ ? lobe_->if_made() : nullptr) {
        Hit hit;
        lobe->look({&ray, 1}, {&hit, 1});
        const bool in_front = !hidden || static_cast<double>(hit.distance) <
                                             surface->frame().scale * on_surface.distance;
        if (hit.found() && in_front) return detector_.cell_of(Lobe::direction(ray, hit));
    }
    if (hidden || !workbench_.settings().surface_view.dome) return std::nullopt;
    const std::optional<Vec3> direction = dome_direction(ray);
    if (!direction || direction->y < 0) return std::nullopt;
    return detector_.cell_of(SurfaceFrame::direction_to_surface(*direction));
}

QString SurfaceScene::reading_at(QPointF place) const {
    const std::optional<int> cell = cell_at(place);
    if (!cell) return {};
    const SurfaceView& view = workbench_.settings().surface_view;
    return cell_text(detector_, *cell, workbench_.drawing().layers(), view.current_layer,
                     view.sky_map.channel);
}

void SurfaceScene::click(QPointF place, Qt::MouseButton button) {
    if (button != Qt::LeftButton) return;
    const std::optional<int> cell = cell_at(place);
    workbench_.select_cell(cell == workbench_.selected_cell() ? std::nullopt : cell);
}

void SurfaceScene::hover(QPointF place) {
    hovered_ = place;
    viewport_->refresh_overlay();
}

bool SurfaceScene::eventFilter(QObject* watched, QEvent* event) {
    if (watched == viewport_ && event->type() == QEvent::Leave) {
        hovered_.reset();
        viewport_->refresh_overlay();
    }
    return QWidget::eventFilter(watched, event);
}

void SurfaceScene::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && workbench_.selected_cell())
        workbench_.select_cell(std::nullopt);
    else
        QWidget::keyPressEvent(event);
}

// Lines and labels

/// Smooth lines cost more than a moving view can spend, and are kept while it is still: a picture
/// that refines, or a mouse that moves over it, need not wait for them.
void SurfaceScene::paint_kept_lines(QPainter& painter) {
    if (viewport_->frame().moving) {
        painter.setRenderHint(QPainter::Antialiasing, false);
        paint_lines(painter);
        return;
    }
    const Camera& camera = viewport_->shown_camera();
    const double ratio = viewport_->devicePixelRatioF();
    const QSize size = (QSizeF(viewport_->size()) * ratio).toSize();
    const bool kept = !lines_.isNull() && lines_.size() == size && lines_body_ == body() &&
                      same_camera(lines_camera_, camera);
    if (!kept) {
        lines_ = QImage(size, QImage::Format_ARGB32_Premultiplied);
        lines_.setDevicePixelRatio(ratio);
        lines_.fill(Qt::transparent);
        lines_camera_ = camera;
        lines_body_ = body();
        QPainter onto_lines(&lines_);
        onto_lines.setRenderHint(QPainter::Antialiasing);
        paint_lines(onto_lines);
    }
    painter.drawImage(QPointF(0, 0), lines_);
}

void SurfaceScene::forget_lines() {
    lines_ = {};
    viewport_->refresh_overlay();
}

void SurfaceScene::paint_lines(QPainter& painter) const {
    const StudioSettings& settings = workbench_.settings();
    const SurfaceView& view = settings.surface_view;
    const SurfaceBody* surface = body();
    const SceneLines lines(painter, *viewport_, surface);
    if (view.dome) paint_dome_lines(lines, *viewport_);
    if (!surface) return;
    paint_paths(lines, workbench_.light().paths(), *surface);
    if (const auto incidence = incidence_of(workbench_.incident_light(), view.current_layer);
        view.beam && incidence)
        paint_beam(lines, Beam(from_spherical(incidence->theta, incidence->phi), *surface),
                   jitter_of(settings.experiment.run, workbench_.surface().cells()));
    if (const std::optional<int> cell = workbench_.selected_cell();
        view.dome && cell && *cell < detector_.cells())
        paint_cell(lines, detector_, *cell);
}

void SurfaceScene::paint_labels(QPainter& painter) const {
    const StudioSettings& settings = workbench_.settings();
    const SurfaceView& view = settings.surface_view;
    const QRectF area = viewport_->rect();
    const double em = painter.fontMetrics().height();
    QString text = layer_text(workbench_.incident_light(), view.current_layer,
                              workbench_.drawing().layers(), view.sky_map.channel);
    if (workbench_.drawing().layers().head && !workbench_.are_layers_current())
        text += tr(" · drawn with other settings");
    paint_label(painter, area, Qt::AlignTop | Qt::AlignLeft, text);
    if (const QString& trouble = workbench_.surface().trouble(); !trouble.isEmpty())
        paint_label(painter, area.adjusted(0, 2 * em, 0, 0), Qt::AlignTop | Qt::AlignHCenter,
                    tr("Not made: %1").arg(in_words_of_forms(trouble)));
    paint_lobe_legend(painter, area.topLeft() + QPointF(0.6, 2.4) * em, model_lobes_);
    paint_axis_cross(painter, area.bottomLeft() + QPointF(3, -3) * em, viewport_->shown_camera());
    if (!workbench_.light().paths().empty())
        paint_bounce_legend(painter, area.bottomLeft() + QPointF(6.5, -0.6) * em,
                            most_bounces(workbench_.light().paths()));
    const DomePicture* dome = dome_ ? dome_->if_made() : nullptr;
    if (dome) paint_colour_bar(painter, area, dome->scale(), view.sky_map.colour_map);
    if (!hovered_) return;
    if (const QString reading = reading_at(*hovered_); !reading.isEmpty())
        paint_bubble(painter, area, *hovered_, reading);
}

}  // namespace asperity::studio

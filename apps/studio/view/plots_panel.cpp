// SPDX-License-Identifier: Apache-2.0
#include "plots_panel.h"

#include "file_questions.h"
#include "plot_canvas.h"
#include "plot_controls.h"
#include "qt_canvas.h"

#include <asperity/core/error.h>
#include <asperity/plots/files/write_plot.h>

#include <QApplication>
#include <QClipboard>
#include <QElapsedTimer>
#include <QFontInfo>
#include <QMessageBox>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

namespace {

/// Plots of a growing layer follow each other no faster, and take a tenth of the time at most.
constexpr int kMillisecondsBetween = 100;
constexpr int kShareOfTime = 10;

}  // namespace

PlotsPanel::PlotsPanel(Workbench& workbench, QWidget* parent)
    : QWidget(parent),
      workbench_(workbench),
      controls_(new PlotControls(workbench)),
      canvas_(new PlotCanvas),
      read_out_(new QLabel),
      stale_(new QLabel(tr("Of layers drawn with other settings"), canvas_)) {
    setObjectName("plots-panel");
    read_out_->setObjectName("plot-read-out");
    read_out_->setWordWrap(true);
    read_out_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    // As high as its longest line gets: the plot above must not move under the mouse
    read_out_->setFixedHeight(3 * read_out_->fontMetrics().lineSpacing());
    read_out_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    read_out_->setToolTip(tr("Values under the mouse, ± 1 standard error"));
    stale_->setObjectName("stale-plot");
    stale_->setToolTip(tr("Draw To Textures fills the layers anew"));
    stale_->setStyleSheet("color: #1b1d21; background: #d9a441; padding: 2px 6px;");
    stale_->adjustSize();
    stale_->move(0, 0);
    stale_->hide();
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(controls_);
    layout->addWidget(canvas_, 1);
    layout->addWidget(read_out_);
    timer_.setSingleShot(true);
    timer_.setInterval(kMillisecondsBetween);
    follow();
    refresh();
}

void PlotsPanel::follow() {
    connect(&timer_, &QTimer::timeout, this, &PlotsPanel::refresh);
    const auto soon = [this] { refresh_soon(); };
    connect(&workbench_.document(), &Document::changed, this, soon);
    connect(&workbench_.drawing(), &Drawing::layers_changed, this, soon);
    connect(&workbench_.surface(), &SurfaceSource::ready, this, soon);
    connect(&workbench_, &Workbench::cell_selected, this, soon);
    connect(&models_, &ModelCurves::changed, this, soon);
    connect(&models_, &ModelCurves::failed, &workbench_, &Workbench::complaint);

    connect(canvas_, &PlotCanvas::read, read_out_, &QLabel::setText);
    connect(canvas_, &PlotCanvas::cell_chosen, this,
            [this](int cell) { workbench_.select_cell(cell); });
    connect(controls_, &PlotControls::copy_wanted, this, &PlotsPanel::copy_picture);
    connect(controls_, &PlotControls::save_wanted, this, &PlotsPanel::ask_and_save);
}

void PlotsPanel::refresh_soon() {
    if (!timer_.isActive()) timer_.start();
}

void PlotsPanel::showEvent(QShowEvent*) {
    refresh();
}

PlotSource PlotsPanel::source() const {
    PlotSource source;
    source.view = workbench_.settings().plots;
    source.sky_map = workbench_.settings().surface_view.sky_map;
    source.current_layer = workbench_.settings().surface_view.current_layer;
    source.layers = workbench_.drawing().layers();
    source.cell = workbench_.selected_cell();
    source.disc_painter = disc_painter_;
    source.surface = workbench_.surface().surface();
    // The layers may be of another surface than the one that is there now
    if (source.view.kind != PlotKind::Normals && source.layers.head)
        source.surface_alpha = source.layers.head->surface.rms_gradient;
    else if (source.surface)
        source.surface_alpha = workbench_.surface().statistics().rms_gradient;
    return source;
}

std::shared_ptr<const plots::Plot> PlotsPanel::plot() const {
    const PlotSource source = this->source();
    const auto wish = models_for(source);
    return make_plot(source, wish ? models_.find(*wish) : nullptr);
}

void PlotsPanel::refresh() {
    const PlotSource source = this->source();
    controls_->show_surface_alpha(source.surface_alpha);
    if (!isVisible()) return;  // made when it is shown
    QElapsedTimer clock;
    clock.start();
    if (const auto wish = models_for(source)) models_.want(*wish);
    canvas_->set_plot(plot());
    const bool of_layers = source.view.kind != PlotKind::Normals && source.layers.head;
    stale_->setVisible(of_layers && !workbench_.is_drawing() && !workbench_.are_layers_current());
    stale_->move(canvas_->width() - stale_->width(), canvas_->height() - stale_->height());
    timer_.setInterval(
        std::max(kMillisecondsBetween, kShareOfTime * static_cast<int>(clock.elapsed())));
}

QSize PlotsPanel::shown_size() const {
    return canvas_->size();
}

QImage PlotsPanel::picture(QSize size) const {
    return plot_image(*plot(), size, 1, style_of(canvas_->palette(), canvas_->font()),
                      canvas_->font());
}

void PlotsPanel::copy_picture() const {
    constexpr double kPixelsToOne = 2;
    QPalette print;
    print.setColor(QPalette::Base, Qt::white);
    print.setColor(QPalette::Text, QColor(0x11, 0x11, 0x11));
    QApplication::clipboard()->setImage(plot_image(
        *plot(), shown_size(), kPixelsToOne, style_of(print, canvas_->font()), canvas_->font()));
}

void PlotsPanel::save(const QString& path) const {
    plots::PlotFileSettings settings;
    settings.width = shown_size().width();
    settings.height = shown_size().height();
    settings.font_size = QFontInfo(canvas_->font()).pixelSize();
    plots::write_plot(*plot(), settings, path.toStdString());
}

void PlotsPanel::ask_and_save() {
    ask_file_to_save(this, tr("Save Plot"),
                     tr("Picture (*.png);;Drawing (*.svg);;Drawing for print (*.pdf);;"
                        "Numbers (*.csv)"),
                     "png", [this](const QString& path) {
                         try {
                             save(path);
                         } catch (const Error& error) {
                             QMessageBox::warning(this, tr("Save Plot"),
                                                  QString::fromUtf8(error.what()));
                         }
                     });
}

}  // namespace asperity::studio

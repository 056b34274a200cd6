// SPDX-License-Identifier: Apache-2.0
#include "main_window.h"

#include "../model/first_session.h"
#include "../model/recovery.h"
#include "log_view.h"
#include "menu_panel.h"
#include "menus.h"
#include "model_scene.h"
#include "plots_panel.h"
#include "preferences.h"
#include "run_test_dialog.h"
#include "surface_panel.h"
#include "surface_scene.h"
#include "tour.h"

#include <asperity/core/error.h>

#include <QCloseEvent>
#include <QDockWidget>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLocale>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabWidget>
#include <QVBoxLayout>

namespace asperity::studio {

namespace {

constexpr int kComplaintMs = 20000;

QDockWidget* make_dock(QMainWindow& window, const QString& title, const char* name,
                       QWidget* content) {
    auto* dock = new QDockWidget(title, &window);
    dock->setObjectName(name);
    dock->setWidget(content);
    return dock;
}

}  // namespace

struct MainWindow::Parts {
    Workbench workbench;
    Recovery recovery{workbench.document()};
    SurfaceScene* surface_scene = nullptr;
    ModelScene* model_scene = nullptr;
    PlotsPanel* plots = nullptr;
    MenuPanel* menu = nullptr;
    Tour* tour = nullptr;
    QStackedWidget* scenes = nullptr;
    QList<QDockWidget*> docks;    ///< Menu, Plots, Log
    QList<QDockWidget*> offered;  ///< of these, while presenting: what was shown before
};

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent), parts_(std::make_unique<Parts>()) {
    Workbench& bench = workbench();
    parts_->surface_scene = new SurfaceScene(bench);
    parts_->model_scene = new ModelScene(bench);
    parts_->plots = new PlotsPanel(bench);
    parts_->tour = new Tour(bench);
    parts_->scenes = new QStackedWidget;
    parts_->scenes->addWidget(parts_->surface_scene);
    parts_->scenes->addWidget(parts_->model_scene);

    auto* centre = new QWidget;
    auto* column = new QVBoxLayout(centre);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(parts_->tour);
    column->addWidget(parts_->scenes, 1);
    setCentralWidget(centre);

    make_docks();
    add_file_menu(*this);
    add_edit_menu(*this);
    add_view_menu(*this, parts_->docks);
    add_simulation_menu(*this);
    add_help_menu(*this);
    log_events(bench);
    statusBar();

    connect(&bench, &Workbench::complaint, this,
            [this](const QString& sentence) { statusBar()->showMessage(sentence, kComplaintMs); });
    connect(&parts_->recovery, &Recovery::failed, this, &MainWindow::complain);
    Document& document = bench.document();
    connect(&document, &Document::changed, this, &MainWindow::follow_settings);
    connect(&document, &Document::path_changed, this, &MainWindow::show_title);
    connect(&document.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::show_title);
    for (Viewport* viewport : {&surface_scene().viewport(), &model_scene().viewport()})
        viewport->installEventFilter(this);
    setAcceptDrops(true);
    follow_settings();
    show_title();

    resize(1600, 940);
    reset_layout();
    restoreGeometry(preferences::window_geometry());
    restoreState(preferences::window_layout());
}

MainWindow::~MainWindow() {
    // The scenes look at the workbench until their end
    delete takeCentralWidget();
    for (QDockWidget* dock : parts_->docks) delete dock;
}

void MainWindow::make_docks() {
    const SceneCommands commands{[this] { ask_for_model(); }, [this] { view(SceneKind::Model); },
                                 [this] { view(SceneKind::Surface); }, [this] { run_test(); }};
    parts_->menu = new MenuPanel(workbench(), surface_scene(), model_scene(), commands);
    setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
    parts_->docks = {make_dock(*this, tr("Menu"), "menu-dock", parts_->menu),
                     make_dock(*this, tr("Plots"), "plots-dock", parts_->plots),
                     make_dock(*this, tr("Log"), "log-dock", new LogView(workbench()))};
}

Workbench& MainWindow::workbench() {
    return parts_->workbench;
}

SurfaceScene& MainWindow::surface_scene() {
    return *parts_->surface_scene;
}

ModelScene& MainWindow::model_scene() {
    return *parts_->model_scene;
}

PlotsPanel& MainWindow::plots() {
    return *parts_->plots;
}

SurfacePanel& MainWindow::surface_panel() {
    return parts_->menu->surface_panel();
}

Tour& MainWindow::tour() {
    return *parts_->tour;
}

void MainWindow::follow_settings() {
    const bool surface = workbench().settings().scene == SceneKind::Surface;
    parts_->scenes->setCurrentIndex(surface ? 0 : 1);
}

void MainWindow::show_title() {
    const Document& document = workbench().document();
    const QString name =
        document.path().isEmpty() ? tr("new session") : QFileInfo(document.path()).fileName();
    setWindowTitle(tr("%1[*] - Asperity").arg(name));
    setWindowModified(document.modified());
}

void MainWindow::begin(bool measure) {
    measure_ = measure;
    new_session();
}

void MainWindow::new_session() {
    workbench().stop_drawing();
    workbench().drawing().clear();
    workbench().document().reset(first_session());
    surface_scene().viewport().reset_camera();
    model_scene().viewport().reset_camera();
    if (measure_) workbench().draw_to_textures();
}

void MainWindow::view(SceneKind scene) {
    const QString what = scene == SceneKind::Surface ? tr("View Surface") : tr("View Model");
    workbench().document().change(what, [scene](StudioSettings& s) { s.scene = scene; });
}

void MainWindow::load_model(const QString& name_or_file) {
    model_scene().load(name_or_file);  // goes over to its scene when it is ready
}

void MainWindow::run_test() {
    auto* dialog = findChild<RunTestDialog*>();
    if (dialog == nullptr) dialog = new RunTestDialog(this);
    dialog->show();
    dialog->raise();
    dialog->begin();
}

void MainWindow::offer_lost_session() {
    const auto lost = parts_->recovery.recoverable();
    if (lost.empty()) return;
    const Recovery::Lost latest = lost.front();
    const QString name = latest.path.isEmpty() ? tr("A session that was never saved")
                                               : tr("The session %1").arg(latest.path);
    auto* box =
        new QMessageBox(QMessageBox::Question, tr("Restore Session"),
                        tr("%1 was left behind on %2 with changes. Restore it?")
                            .arg(name, QLocale().toString(latest.when, QLocale::ShortFormat)),
                        QMessageBox::Yes | QMessageBox::Discard | QMessageBox::Cancel, this);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName("restore-session");
    box->button(QMessageBox::Cancel)->setText(tr("Later"));
    connect(box, &QMessageBox::finished, this, [this, latest](int answer) {
        if (answer == QMessageBox::Cancel) return;
        if (answer == QMessageBox::Yes)
            workbench().document().restore(latest.settings, latest.path);
        parts_->recovery.forget(latest);
    });
    box->open();
}

void MainWindow::set_presenting(bool presenting) {
    if (presenting == presenting_) return;
    presenting_ = presenting;
    constexpr double kLarge = 1.9;
    QFont letters = font();
    if (presenting) {
        parts_->offered.clear();
        for (QDockWidget* dock : parts_->docks) {
            // The last one seen comes last, and so in front of those that share its place
            if (dock->isHidden()) continue;
            if (dock->visibleRegion().isEmpty())
                parts_->offered.prepend(dock);
            else
                parts_->offered.append(dock);
        }
        for (QDockWidget* dock : parts_->docks) dock->hide();
        letters.setPointSizeF(kLarge * letters.pointSizeF());
    } else {
        for (QDockWidget* dock : parts_->offered) {
            dock->show();
            dock->raise();
        }
    }
    menuBar()->setVisible(!presenting);
    statusBar()->setVisible(!presenting);
    centralWidget()->setFont(letters);
    setWindowState(windowState().setFlag(Qt::WindowFullScreen, presenting));
    for (Viewport* viewport : {&surface_scene().viewport(), &model_scene().viewport()})
        viewport->refresh_overlay();
    emit presenting_changed(presenting);
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && presenting_)
        set_presenting(false);
    else
        QMainWindow::keyPressEvent(event);
}

// Place by place and not by restoreState(): in a window that is shown Qt 6.4 then walks over its
// own list of tab bars while showing them changes it
void MainWindow::reset_layout() {
    QDockWidget* const menu = parts_->docks.at(0);
    QDockWidget* const plots = parts_->docks.at(1);
    QDockWidget* const log = parts_->docks.at(2);
    for (QDockWidget* dock : parts_->docks) {
        dock->setFloating(false);
        addDockWidget(dock == menu ? Qt::LeftDockWidgetArea : Qt::RightDockWidgetArea, dock);
        dock->show();
    }
    tabifyDockWidget(plots, log);
    plots->raise();
    const int letter = fontMetrics().averageCharWidth();
    resizeDocks({menu, plots}, {40 * letter, 52 * letter}, Qt::Horizontal);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!closing_ && asking_ == Asking::Yes && workbench().document().modified()) {
        event->ignore();
        after_saving([this] {
            closing_ = true;
            close();
        });
        return;
    }
    set_presenting(false);
    workbench().stop_drawing();
    preferences::set_window(saveGeometry(), saveState());
    event->accept();
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
    // Ctrl walks slowly (thesis table 2.1): Ctrl+Q must not quit, nor Ctrl+W, A, S, D, E do
    // anything else while a picture is walked through
    if (event->type() == QEvent::ShortcutOverride) {
        const StudioSettings& settings = workbench().settings();
        const CameraType camera = watched == &surface_scene().viewport()
                                      ? settings.surface_view.camera_type
                                      : settings.model_view.camera_type;
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool walks = QString("WASDQE").contains(QChar(key->key()));
        if (camera != CameraType::Orbiter && walks && !(key->modifiers() & Qt::AltModifier)) {
            event->accept();
            return true;
        }
    }
    return QMainWindow::eventFilter(watched, event);
}

}  // namespace asperity::studio

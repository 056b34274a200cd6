// SPDX-License-Identifier: Apache-2.0
#include "bindings.h"
#include "main_window.h"
#include "menus.h"
#include "model_scene.h"
#include "preferences.h"
#include "surface_scene.h"
#include "theme.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QSignalBlocker>

namespace asperity::studio {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("ViewMenu", text);
}

void add_scenes(MainWindow& window, QMenu& menu) {
    auto* scenes = new QActionGroup(&window);
    Document& document = window.workbench().document();
    const auto add = [&](const QString& name, const char* shortcut, SceneKind scene) {
        QAction* entry = menu.addAction(name, &window, [&window, scene] { window.view(scene); });
        entry->setShortcut(QKeySequence(shortcut));
        entry->setCheckable(true);
        scenes->addAction(entry);
        const auto show = [entry, scene, &document] {
            entry->setChecked(document.settings().scene == scene);
        };
        QObject::connect(&document, &Document::changed, entry, show);
        show();
    };
    add(tr("Microfacets Surface"), "Ctrl+1", SceneKind::Surface);
    add(tr("Model"), "Ctrl+2", SceneKind::Model);
}

void add_display(MainWindow& window, QMenu& menu) {
    Document& document = window.workbench().document();
    const auto add = [&](const QString& name, const char* shortcut, bool SurfaceView::*field) {
        QAction* entry = menu.addAction(name);
        entry->setShortcut(QKeySequence(shortcut));
        entry->setCheckable(true);
        const auto show = [entry, field, &document] {
            entry->setChecked(document.settings().surface_view.*field);
        };
        QObject::connect(&document, &Document::changed, entry, show);
        QObject::connect(entry, &QAction::triggered, &window, [&document, name, field](bool on) {
            document.change(name, [field, on](StudioSettings& s) { s.surface_view.*field = on; });
        });
        show();
    };
    add(tr("Dome"), "F5", &SurfaceView::dome);
    add(tr("Beam"), "F6", &SurfaceView::beam);
    add(tr("Paths of light"), "F7", &SurfaceView::paths);
    add(tr("Lobe"), "F8", &SurfaceView::lobe);
    add(tr("Whole Dome"), "F10", &SurfaceView::whole_dome);
    menu.addAction(tr("Reset Camera"), &window,
                   [&window, &document] {
                       if (document.settings().scene == SceneKind::Surface)
                           window.surface_scene().viewport().reset_camera();
                       else
                           window.model_scene().viewport().reset_camera();
                   })
        ->setStatusTip(tr("R in the picture"));
}

void add_themes(MainWindow& window, QMenu& menu) {
    QMenu* themes = menu.addMenu(tr("Theme"));
    auto* group = new QActionGroup(&window);
    const auto add = [&](const QString& name, Theme theme) {
        QAction* entry = themes->addAction(name, &window, [theme] {
            preferences::set_theme(theme);
            apply_theme(theme);
        });
        entry->setCheckable(true);
        entry->setChecked(preferences::theme() == theme);
        group->addAction(entry);
    };
    add(tr("System"), Theme::System);
    add(tr("Light"), Theme::Light);
    add(tr("Dark"), Theme::Dark);
}

}  // namespace

void add_view_menu(MainWindow& window, const QList<QDockWidget*>& docks) {
    QMenu& menu = *window.menuBar()->addMenu(tr("&View"));
    add_scenes(window, menu);
    menu.addSeparator();
    add_display(window, menu);
    menu.addSeparator();

    int key = Qt::Key_F2;  // F2, F3, F4
    for (QDockWidget* dock : docks) {
        QAction* entry = dock->toggleViewAction();
        entry->setShortcut(QKeySequence(key++));
        menu.addAction(entry);
    }
    menu.addAction(tr("Reset Layout"), &window, &MainWindow::reset_layout);
    menu.addSeparator();
    add_themes(window, menu);
    QAction* full = menu.addAction(tr("Full Screen"), &window, [&window] {
        window.setWindowState(window.windowState() ^ Qt::WindowFullScreen);
    });
    full->setShortcut(QKeySequence("F11"));
    QAction* present = menu.addAction(tr("Presentation"));
    present->setObjectName("presentation");
    present->setShortcut(QKeySequence("F9"));
    present->setCheckable(true);
    present->setStatusTip(tr("The scene alone, in large type; Esc or F9 ends it"));
    // The menu is hidden meanwhile, and the key works on
    window.addAction(present);
    QObject::connect(present, &QAction::triggered, &window, &MainWindow::set_presenting);
    QObject::connect(&window, &MainWindow::presenting_changed, present, &QAction::setChecked);
}

}  // namespace asperity::studio

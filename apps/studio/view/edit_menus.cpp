// SPDX-License-Identifier: Apache-2.0
// The menus Edit and Simulation.
#include "bindings.h"
#include "control_buttons.h"
#include "fit_dialog.h"
#include "main_window.h"
#include "menus.h"
#include "preferences.h"
#include "show_dialog.h"

#include <QCoreApplication>
#include <QMenu>
#include <QMenuBar>

namespace asperity::studio {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("EditMenus", text);
}

void step_layer(Workbench& workbench, int step) {
    Document& document = workbench.document();
    const int layers = static_cast<int>(incidences(workbench.incident_light()).size());
    const int layer = document.settings().surface_view.current_layer + step;
    if (layer < 1 || layer > layers) return;
    document.change(tr("Current Layer"),
                    [layer](StudioSettings& s) { s.surface_view.current_layer = layer; });
}

void run_brdf(Document& document, const QString& what, bool runs) {
    document.change(what, [runs](StudioSettings& s) { s.model_view.brdf_runs = runs; });
}

void add_drawing_commands(MainWindow& window, QMenu& menu) {
    Workbench& workbench = window.workbench();
    QAction* draw =
        menu.addAction(tr("Draw To Textures"), &workbench, &Workbench::draw_to_textures);
    draw->setShortcut(QKeySequence("Ctrl+Return"));
    QAction* pause = menu.addAction(tr("Pause/Resume"), &window,
                                    [&workbench] { pause_or_resume(workbench.drawing()); });
    pause->setShortcut(QKeySequence("Ctrl+P"));
    QAction* stop = menu.addAction(tr("Stop Drawing"), &workbench, &Workbench::stop_drawing);
    stop->setShortcut(QKeySequence("Ctrl+."));
    QAction* clear = menu.addAction(tr("Clear Textures"), &window,
                                    [&workbench] { workbench.drawing().clear(); });
    clear->setShortcut(QKeySequence("Ctrl+Backspace"));

    const auto update = [&workbench, draw, pause, stop] {
        draw->setEnabled(!workbench.is_drawing());
        stop->setEnabled(workbench.is_drawing());
        pause->setEnabled(workbench.drawing().state() != Drawing::State::Idle);
    };
    QObject::connect(&workbench, &Workbench::drawing_changed, &window, update);
    update();
}

}  // namespace

void add_edit_menu(MainWindow& window) {
    QMenu& menu = *window.menuBar()->addMenu(tr("&Edit"));
    QUndoStack& steps = window.workbench().document().undo_stack();
    QAction* undo = steps.createUndoAction(&window, tr("Undo"));
    undo->setShortcut(QKeySequence::Undo);
    QAction* redo = steps.createRedoAction(&window, tr("Redo"));
    redo->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
    menu.addAction(undo);
    menu.addAction(redo);
}

void add_simulation_menu(MainWindow& window) {
    QMenu& menu = *window.menuBar()->addMenu(tr("&Simulation"));
    add_drawing_commands(window, menu);
    menu.addSeparator();

    Workbench& workbench = window.workbench();
    Document& document = workbench.document();
    menu.addAction(tr("Next Layer"), &window, [&workbench] { step_layer(workbench, 1); })
        ->setShortcut(QKeySequence("Ctrl+PgUp"));
    menu.addAction(tr("Previous Layer"), &window, [&workbench] { step_layer(workbench, -1); })
        ->setShortcut(QKeySequence("Ctrl+PgDown"));
    menu.addSeparator();
    menu.addAction(tr("Start BRDF"), &window,
                   [&document] { run_brdf(document, tr("Start BRDF"), true); });
    menu.addAction(tr("Stop BRDF"), &window,
                   [&document] { run_brdf(document, tr("Stop BRDF"), false); });
    menu.addSeparator();
    QAction* fit = menu.addAction(tr("Fit Models..."), &window, [&window] {
        show_dialog<FitDialog>(window.workbench(), window);
    });
    fit->setShortcut(QKeySequence("Ctrl+F"));
    fit->setStatusTip(tr("The parameters with which models come nearest to a BRDF"));
    menu.addSeparator();
    menu.addAction(tr("Run Test"), &window, &MainWindow::run_test)
        ->setShortcut(QKeySequence("Ctrl+T"));
    menu.addSeparator();
    QAction* measure = menu.addAction(tr("Measure at Start"));
    measure->setObjectName("measure-at-start");
    measure->setCheckable(true);
    measure->setChecked(preferences::measure_at_start());
    measure->setStatusTip(tr("A new session is drawn at once, without Draw To Textures"));
    QObject::connect(measure, &QAction::triggered, &window, [&window](bool on) {
        preferences::set_measure_at_start(on);
        window.set_measures_at_start(on);
    });
}

}  // namespace asperity::studio

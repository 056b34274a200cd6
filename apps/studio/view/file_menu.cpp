// SPDX-License-Identifier: Apache-2.0
#include "export_dialog.h"
#include "file_kinds.h"
#include "file_questions.h"
#include "main_window.h"
#include "menus.h"
#include "model_scene.h"
#include "plots_panel.h"
#include "preferences.h"
#include "save_bytes.h"
#include "show_dialog.h"
#include "surface_file_dialog.h"
#include "surface_panel.h"
#include "surface_scene.h"

#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/layers_exr.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/pictures/pictures.h>
#include <asperity/render/builtin_models.h>

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>

namespace asperity::studio {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("FileMenu", text);
}

std::string file_name(const QString& path) {
    return QFile::encodeName(path).toStdString();
}

/// Does something with a file that the user has named; its errors get a window of their own.
void attempt(MainWindow& window, const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        window.complain_aloud(QString::fromUtf8(error.what()));
    }
}

/// The whole result, or a complaint that there is none.
std::shared_ptr<const Measurement> result_of(MainWindow& window) {
    auto result = window.workbench().drawing().result();
    if (!result) window.complain(tr("nothing is drawn yet: Draw To Textures first"));
    return result;
}

void add_session_commands(MainWindow& window, QMenu& menu) {
    QAction* fresh = menu.addAction(tr("New Session"), &window, [&window] {
        window.after_saving([&window] { window.new_session(); });
    });
    fresh->setShortcut(QKeySequence::New);
    QAction* open = menu.addAction(tr("Open..."), &window, [&window] {
        ask_file_to_open(&window, tr("Open Session, Result, Surface or Model"), open_filter(),
                         [&window](const QString& path) { window.open(path); });
    });
    open->setShortcut(QKeySequence::Open);

    QMenu* recent = menu.addMenu(tr("Recent Files"));
    recent->setObjectName("recent-files");
    QObject::connect(recent, &QMenu::aboutToShow, &window, [&window, recent] {
        recent->clear();
        for (const QString& path : preferences::recent_files()) {
            QAction* entry = recent->addAction(QFileInfo(path).fileName(), &window,
                                               [&window, path] { window.open(path); });
            entry->setStatusTip(path);
        }
        recent->addSeparator();
        recent->addAction(tr("Forget These"), &window, [] { preferences::clear_recent_files(); });
    });
    menu.addSeparator();

    QAction* save =
        menu.addAction(tr("Save Session"), &window, [&window] { window.save_session(); });
    save->setShortcut(QKeySequence::Save);
    QAction* save_as =
        menu.addAction(tr("Save Session As..."), &window, [&window] { window.save_session_as(); });
    save_as->setShortcut(QKeySequence("Ctrl+Shift+S"));
    save_as->setStatusTip(tr("A text file that asperity simulate --config runs, too"));
    menu.addSeparator();
}

void add_import_commands(MainWindow& window, QMenu& menu) {
    menu.addAction(tr("Open Surface File..."), &window,
                   [&window] { window.surface_panel().open_surface_file(); });
    menu.addAction(tr("Make Surface File Ready..."), &window,
                   [&window] { show_dialog<SurfaceFileDialog>(window.workbench(), window); })
        ->setStatusTip(tr("Units, missing points, form, filters; before and after; figures"));
    QAction* load =
        menu.addAction(tr("Load Model..."), &window, [&window] { window.ask_for_model(); });
    load->setShortcut(QKeySequence("Ctrl+L"));
    QMenu* builtin = menu.addMenu(tr("Built-in Models"));
    builtin->setObjectName("built-in-models");
    for (const BuiltinModel& model : builtin_models()) {
        const QString name = QString::fromStdString(model.name);
        QAction* entry =
            builtin->addAction(name, &window, [&window, name] { window.load_model(name); });
        entry->setStatusTip(QString::fromStdString(model.description));
    }
    menu.addSeparator();
}

void save_result(MainWindow& window) {
    const auto result = result_of(window);
    if (!result) return;
    ask_file_to_save(&window, tr("Save Result"), tr("Results (*.asperity)"), "asperity",
                     [&window, result](const QString& path) {
                         attempt(window, [&] {
                             io::save_measurement(*result, file_name(path));
                             preferences::add_recent_file(path);
                         });
                     });
}

void export_layers(MainWindow& window) {
    const auto result = result_of(window);
    if (!result) return;
    ask_file_to_save(&window, tr("Export Layers"),
                     tr("OpenEXR with all layers (*.exr);;PNG sheet of all layers (*.png)"), "exr",
                     [&window, result](const QString& path) {
                         attempt(window, [&] {
                             if (path.endsWith(".png", Qt::CaseInsensitive))
                                 io::write_layer_sheet(
                                     *result, file_name(path),
                                     window.workbench().settings().surface_view.sky_map);
                             else
                                 io::write_layers_exr(*result, file_name(path));
                         });
                     });
}

void export_sky_maps(MainWindow& window) {
    const auto result = result_of(window);
    if (!result) return;
    ask_folder(&window, tr("Export Sky-Maps"), [&window, result](const QString& folder) {
        attempt(window, [&] {
            io::write_layer_pngs(*result, file_name(folder),
                                 window.workbench().settings().surface_view.sky_map);
        });
    });
}

void save_picture(MainWindow& window) {
    const bool surface = window.workbench().settings().scene == SceneKind::Surface;
    const QString filter = surface ? tr("PNG (*.png)") : tr("PNG (*.png);;OpenEXR (*.exr)");
    ask_file_to_save(
        &window, tr("Save Picture"), filter, "png", [&window, surface](const QString& path) {
            attempt(window, [&] {
                if (!surface)
                    window.model_scene().save_picture(path);
                else
                    save_bytes(png_bytes(window.surface_scene().viewport().grab_picture()), path);
            });
        });
}

void save_plot(MainWindow& window) {
    ask_file_to_save(
        &window, tr("Save Plot"), tr("PNG (*.png);;SVG (*.svg);;Numbers (*.csv)"), "png",
        [&window](const QString& path) { attempt(window, [&] { window.plots().save(path); }); });
}

}  // namespace

void add_file_menu(MainWindow& window) {
    QMenu& menu = *window.menuBar()->addMenu(tr("&File"));
    add_session_commands(window, menu);
    add_import_commands(window, menu);
    menu.addAction(tr("Save Result..."), &window, [&window] { save_result(window); });
    QAction* export_brdf = menu.addAction(tr("Export BRDF..."), &window, [&window] {
        show_dialog<ExportDialog>(window.workbench(), window);
    });
    export_brdf->setShortcut(QKeySequence("Ctrl+E"));
    export_brdf->setStatusTip(tr("For Mitsuba, Radiance, OpticStudio and others; read back"));
    menu.addAction(tr("Export Layers..."), &window, [&window] { export_layers(window); });
    menu.addAction(tr("Export Sky-Maps..."), &window, [&window] { export_sky_maps(window); })
        ->setStatusTip(tr("One PNG a layer, in a folder"));
    menu.addAction(tr("Save Picture..."), &window, [&window] { save_picture(window); });
    menu.addAction(tr("Save Plot..."), &window, [&window] { save_plot(window); });
    menu.addSeparator();
    QAction* quit = menu.addAction(tr("Quit"), &window, &QWidget::close);
    quit->setObjectName("quit");
    quit->setShortcut(QKeySequence("Ctrl+Q"));
    quit->setMenuRole(QAction::QuitRole);
}

}  // namespace asperity::studio

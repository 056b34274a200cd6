// SPDX-License-Identifier: Apache-2.0
// What the main window does with files: sessions, results, models, surfaces.
#include "../model/recovery.h"
#include "file_kinds.h"
#include "file_questions.h"
#include "file_surface_form.h"
#include "main_window.h"
#include "model_scene.h"
#include "preferences.h"

#include <asperity/core/error.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QMimeData>
#include <QStatusBar>

namespace asperity::studio {

namespace {

/// The layers of a result, with the settings that they belong to.
void open_result(Workbench& workbench, const QString& path) {
    workbench.drawing().open(path);
    const Experiment experiment = workbench.drawing().result()->experiment;
    workbench.document().change(QObject::tr("Open Result"), [&](StudioSettings& settings) {
        settings.experiment = experiment;
        settings.scene = SceneKind::Surface;
    });
}

}  // namespace

void MainWindow::open(const QString& path) {
    try {
        const FileKind kind = kind_of_file(path);
        if (kind == FileKind::Model) {
            load_model(path);
        } else if (kind == FileKind::Result) {
            open_result(workbench(), path);
        } else if (kind == FileKind::Surface) {
            take_surface_file(workbench().document(), path);
        } else {
            after_saving([this, path] {
                try {
                    workbench().document().open(path);
                    workbench().drawing().clear();
                    preferences::add_recent_file(path);
                } catch (const Error& error) {
                    complain_aloud(QString::fromUtf8(error.what()));
                }
            });
            return;
        }
        preferences::add_recent_file(path);
    } catch (const Error& error) {
        complain_aloud(QString::fromUtf8(error.what()));
    }
}

void MainWindow::ask_for_model() {
    ask_file_to_open(this, tr("Load Model"), model_filter(), [this](const QString& path) {
        load_model(path);
        preferences::add_recent_file(path);
    });
}

void MainWindow::after_saving(const std::function<void()>& then) {
    if (asking_ == Asking::No || !workbench().document().modified()) {
        then();
        return;
    }
    auto* box = new QMessageBox(
        QMessageBox::Question, tr("Save Session"), tr("The session was changed. Save it first?"),
        QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName("save-first");
    box->setDefaultButton(QMessageBox::Save);
    connect(box, &QMessageBox::finished, this, [this, then](int answer) {
        if (answer == QMessageBox::Save)
            save_session(then);
        else if (answer == QMessageBox::Discard)
            then();
    });
    box->open();
}

void MainWindow::save_session(const std::function<void()>& then) {
    const QString path = workbench().document().path();
    if (path.isEmpty())
        save_session_as(then);
    else if (save_to(path) && then)
        then();
}

void MainWindow::save_session_as(const std::function<void()>& then) {
    ask_file_to_save(this, tr("Save Session"), tr("Sessions (*.conf)"), "conf",
                     [this, then](const QString& path) {
                         if (save_to(path) && then) then();
                     });
}

bool MainWindow::save_to(const QString& path) {
    try {
        workbench().document().save(path);
        preferences::add_recent_file(path);
        statusBar()->showMessage(tr("Saved %1").arg(path), 5000);
        return true;
    } catch (const Error& error) {
        complain_aloud(QString::fromUtf8(error.what()));
        return false;
    }
}

void MainWindow::complain(const QString& sentence) {
    emit workbench().complaint(sentence);
}

void MainWindow::complain_aloud(const QString& sentence) {
    complain(sentence);
    auto* box =
        new QMessageBox(QMessageBox::Warning, tr("Asperity"), sentence, QMessageBox::Close, this);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setObjectName("complaint");
    box->open();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) {
            open(url.toLocalFile());
            event->acceptProposedAction();
            return;
        }
}

}  // namespace asperity::studio

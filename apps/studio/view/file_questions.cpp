// SPDX-License-Identifier: Apache-2.0
#include "file_questions.h"

#include "preferences.h"

#include <QFileDialog>
#include <QFileInfo>

namespace asperity::studio {

namespace {

void ask(QFileDialog* dialog, const FileChosen& chosen) {
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setDirectory(preferences::last_folder());
    QObject::connect(dialog, &QFileDialog::fileSelected, dialog->parent(),
                     [chosen](const QString& path) {
                         const QFileInfo file(path);
                         preferences::set_last_folder(file.isDir() ? path : file.absolutePath());
                         chosen(path);
                     });
    dialog->open();
}

}  // namespace

void ask_file_to_open(QWidget* parent, const QString& title, const QString& filter,
                      const FileChosen& chosen) {
    auto* dialog = new QFileDialog(parent, title, {}, filter);
    dialog->setFileMode(QFileDialog::ExistingFile);
    ask(dialog, chosen);
}

void ask_file_to_save(QWidget* parent, const QString& title, const QString& filter,
                      const QString& ending, const FileChosen& chosen) {
    auto* dialog = new QFileDialog(parent, title, {}, filter);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(ending);
    ask(dialog, chosen);
}

void ask_folder(QWidget* parent, const QString& title, const FileChosen& chosen) {
    auto* dialog = new QFileDialog(parent, title);
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    ask(dialog, chosen);
}

}  // namespace asperity::studio

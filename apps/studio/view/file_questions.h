// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>

#include <functional>

namespace asperity::studio {

/// What is done with the file that was chosen.
using FileChosen = std::function<void(const QString& path)>;

// Ask for a file without holding up the program: they return at once, `chosen` is called when and
// if the user has chosen. They begin in the folder used last, and remember that of the answer.
// `filter` as QFileDialog has it, "Sessions (*.conf);;All files (*)".

void ask_file_to_open(QWidget* parent, const QString& title, const QString& filter,
                      const FileChosen& chosen);
/// `ending` is put behind a name that has none, ".conf".
void ask_file_to_save(QWidget* parent, const QString& title, const QString& filter,
                      const QString& ending, const FileChosen& chosen);
void ask_folder(QWidget* parent, const QString& title, const FileChosen& chosen);

}  // namespace asperity::studio

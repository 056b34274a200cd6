// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "theme.h"

#include <QByteArray>
#include <QString>
#include <QStringList>

/// What the program remembers of its user from one start to the next; kept by QSettings under the
/// names of organisation and program. Sessions are no preferences.
namespace asperity::studio::preferences {

Theme theme();  ///< dark the first time
void set_theme(Theme theme);

/// Whether a new session is drawn without being asked to; true the first time.
bool measure_at_start();
void set_measure_at_start(bool measure);

/// The user's home the first time.
QString last_folder();
void set_last_folder(const QString& folder);

/// The latest first, eight at most; files that are gone are left out.
QStringList recent_files();
void add_recent_file(const QString& path);
void clear_recent_files();

// As QMainWindow::saveGeometry and saveState; empty the first time.
QByteArray window_geometry();
QByteArray window_layout();
void set_window(const QByteArray& geometry, const QByteArray& layout);

}  // namespace asperity::studio::preferences

// SPDX-License-Identifier: Apache-2.0
#include "preferences.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>

namespace asperity::studio::preferences {

namespace {

constexpr int kRecentFiles = 8;

}  // namespace

Theme theme() {
    const QString name = QSettings().value("theme").toString();
    return name == "light" ? Theme::Light : name == "system" ? Theme::System : Theme::Dark;
}

void set_theme(Theme theme) {
    QSettings().setValue("theme", theme == Theme::Light  ? "light"
                                  : theme == Theme::Dark ? "dark"
                                                         : "system");
}

bool measure_at_start() {
    return QSettings().value("measure-at-start", true).toBool();
}

void set_measure_at_start(bool measure) {
    QSettings().setValue("measure-at-start", measure);
}

QString last_folder() {
    const QString folder = QSettings().value("last-folder").toString();
    return QFileInfo(folder).isDir() ? folder : QDir::homePath();
}

void set_last_folder(const QString& folder) {
    QSettings().setValue("last-folder", folder);
}

QStringList recent_files() {
    QStringList there;
    for (const QString& path : QSettings().value("recent-files").toStringList())
        if (QFileInfo::exists(path)) there << path;
    return there;
}

void add_recent_file(const QString& path) {
    const QString full = QFileInfo(path).absoluteFilePath();
    QStringList files = recent_files();
    files.removeAll(full);
    files.prepend(full);
    QSettings().setValue("recent-files", QStringList(files.mid(0, kRecentFiles)));
}

void clear_recent_files() {
    QSettings().remove("recent-files");
}

QByteArray window_geometry() {
    return QSettings().value("window/geometry").toByteArray();
}

QByteArray window_layout() {
    return QSettings().value("window/layout").toByteArray();
}

void set_window(const QByteArray& geometry, const QByteArray& layout) {
    QSettings settings;
    settings.setValue("window/geometry", geometry);
    settings.setValue("window/layout", layout);
}

}  // namespace asperity::studio::preferences

// SPDX-License-Identifier: Apache-2.0
#include "file_kinds.h"

#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/formats/models/model_format.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/results/result_file.h>

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>

namespace asperity::studio {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("FileKinds", text);
}

QString pattern_of(const QStringList& endings) {
    QStringList patterns;
    for (const QString& ending : endings) patterns << "*." + ending;
    return patterns.join(' ');
}

QStringList surface_endings() {
    QStringList endings;
    for (const io::HeightsFormat& format : io::builtin_heights()) {
        if (format.open == nullptr) continue;
        for (const std::string& ending : format.endings) endings << QString::fromStdString(ending);
    }
    endings.removeDuplicates();
    return endings;
}

QStringList model_endings() {
    QStringList endings;
    for (const io::ModelFormat& format : io::model_formats())
        for (const auto& ending : format.endings) {
            QString text = QString::fromStdString(std::string(ending));
            endings << (text.startsWith('.') ? text.mid(1) : text);
        }
    endings.removeDuplicates();
    return endings;
}

QString line(const QString& name, const QStringList& endings) {
    return QString("%1 (%2)").arg(name, pattern_of(endings));
}

/// Sessions are lines of "key = value"; tables of heights are numbers.
bool reads_like_a_session(const QString& path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return false;
    constexpr qint64 kHead = 4096;
    static const QRegularExpression setting("^[a-z][a-z-]* *= ",
                                            QRegularExpression::MultilineOption);
    return QString::fromUtf8(file.read(kHead)).contains(setting);
}

}  // namespace

QString surface_filter() {
    return line(tr("Heights"), surface_endings()) + ";;" + tr("All files (*)");
}

QString model_filter() {
    return line(tr("Models"), model_endings()) + ";;" + tr("All files (*)");
}

QString brdf_filter() {
    QStringList endings = {"asperity"};
    const io::BsdfFormats formats;
    for (const io::BsdfFormat& format : formats.rows())
        if (format.read)
            for (const std::string& ending : format.endings)
                endings << QString::fromStdString(ending);
    endings.removeDuplicates();
    return line(tr("Results and BRDFs"), endings) + ";;" + tr("All files (*)");
}

QString open_filter() {
    const QStringList sessions = {"conf", "txt"}, results = {"asperity"};
    const QStringList surfaces = surface_endings(), models = model_endings();
    QStringList all = sessions + results + surfaces + models;
    all.removeDuplicates();
    return QStringList{line(tr("All that can be opened"), all),
                       line(tr("Sessions"), sessions),
                       line(tr("Results"), results),
                       line(tr("Surfaces"), surfaces),
                       line(tr("Models"), models),
                       tr("All files (*)")}
        .join(";;");
}

FileKind kind_of_file(const QString& path) {
    const std::string name = QFile::encodeName(path).toStdString();
    if (io::is_model_file(name)) return FileKind::Model;
    if (io::looks_like_result(name)) return FileKind::Result;
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending == "conf" || !surface_endings().contains(ending)) return FileKind::Session;
    return reads_like_a_session(path) ? FileKind::Session : FileKind::Surface;
}

}  // namespace asperity::studio

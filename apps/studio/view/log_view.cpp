// SPDX-License-Identifier: Apache-2.0
#include "log_view.h"

#include <QContextMenuEvent>
#include <QFontDatabase>
#include <QMenu>

namespace asperity::studio {

namespace {

constexpr int kMostLines = 10000;

QString drawn_line(const Drawing& drawing) {
    const Measurement& result = *drawing.result();
    double rays = 0;
    for (const Layer& layer : result.layers) rays += static_cast<double>(layer.rays);
    return QObject::tr("Drawn: %1, layers %2, %3 million rays in %4 s, checksum %5")
        .arg(QString::fromStdString(result.surface_name))
        .arg(result.layers.size())
        .arg(rays / 1e6, 0, 'g', 3)
        .arg(result.trace_seconds, 0, 'g', 3)
        .arg(drawing.checksum());
}

}  // namespace

LogView::LogView(Workbench& workbench, QWidget* parent) : QPlainTextEdit(parent) {
    setObjectName("log");
    setReadOnly(true);
    setMaximumBlockCount(kMostLines);
    setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    setPlaceholderText(tr("Statistics printed to the log, drawings, complaints"));
    setAccessibleName(tr("Log"));
    for (const QString& line : workbench.log_lines()) appendPlainText(line);
    connect(&workbench, &Workbench::logged, this, &QPlainTextEdit::appendPlainText);
}

void LogView::contextMenuEvent(QContextMenuEvent* event) {
    QMenu* menu = createStandardContextMenu();
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addSeparator();
    menu->addAction(tr("Clear Log"), this, &QPlainTextEdit::clear);
    menu->popup(event->globalPos());
}

void log_events(Workbench& workbench) {
    Drawing& drawing = workbench.drawing();
    QObject::connect(&drawing, &Drawing::completed, &workbench, [&workbench, &drawing] {
        workbench.log(drawn_line(drawing));
        for (const std::string& note : drawing.result()->notes)
            workbench.log(QString::fromStdString(note));
    });
    // Some complaints have been logged by who complains
    QObject::connect(&workbench, &Workbench::complaint, &workbench,
                     [&workbench](const QString& sentence) {
                         const QStringList& lines = workbench.log_lines();
                         if (lines.isEmpty() || lines.last() != sentence) workbench.log(sentence);
                     });
    SurfaceSource& source = workbench.surface();
    QObject::connect(&source, &SurfaceSource::ready, &workbench, [&workbench, &source] {
        const Heightfield& surface = *source.surface();
        workbench.log(QString("Surface %1: %2 x %3 samples, RMS slope %4")
                          .arg(QString::fromStdString(surface.name))
                          .arg(surface.nx)
                          .arg(surface.ny)
                          .arg(source.statistics().rms_gradient, 0, 'g', 3));
    });
}

}  // namespace asperity::studio

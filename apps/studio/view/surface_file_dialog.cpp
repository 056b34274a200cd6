// SPDX-License-Identifier: Apache-2.0
#include "surface_file_dialog.h"

#include "../model/words.h"
#include "rows.h"

#include <asperity/core/length.h>

#include <QEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QVBoxLayout>

namespace asperity::studio {

namespace {

/// "a; b; c" as lines.
QString lines_of(const std::string& sentences) {
    QString html;
    for (const QString& line : QString::fromStdString(sentences).split("; ", Qt::SkipEmptyParts))
        html += in_words_of_forms(line).toHtmlEscaped() + "<br>";
    return html;
}

QString table_of(const std::vector<TextureRow>& rows) {
    QString html, table;
    const auto close = [&] {
        if (!table.isEmpty())
            html += "<table cellspacing='0' cellpadding='1'>" + table + "</table>";
        table.clear();
    };
    for (const TextureRow& row : rows) {
        const QString value = QString::fromStdString(row.value).toHtmlEscaped();
        if (row.name.empty()) {
            close();
            html += "<p>" + value + "</p>";
        } else {
            table += QString("<tr><td style='padding-right:16px'>%1</td><td>%2</td></tr>")
                         .arg(QString::fromStdString(row.name).toHtmlEscaped(),
                              QString(value).replace("  ", " &nbsp;&nbsp; "));
        }
    }
    close();
    return html;
}

}  // namespace

SurfaceFileDialog::SurfaceFileDialog(Workbench& workbench, QWidget* parent)
    : QDialog(parent), workbench_(workbench) {
    setObjectName("surface-file-dialog");
    setWindowTitle(tr("Surface File"));
    auto* split = new QHBoxLayout;
    split->addWidget(make_left());
    split->addWidget(make_right(), 1);
    progress_ = new ProgressRow("surface-file", [this] {
        return figures_.busy() && !workbench_.surface().busy() ? figures_.progress()
                                                               : workbench_.surface().progress();
    });
    auto* again = new QPushButton(tr("Read Again"));
    again->setObjectName("read-again");
    again->setToolTip(tr("Reads the file anew, as it is by now"));
    auto* close = new QPushButton(tr("Close"));
    close->setObjectName("close-surface-file");
    for (QPushButton* button : {again, close}) button->setAutoDefault(false);
    auto* row = new QHBoxLayout;
    row->addWidget(progress_, 1);
    row->addWidget(again);
    row->addWidget(close);
    auto* column = new QVBoxLayout(this);
    column->addLayout(split, 1);
    column->addLayout(row);
    resize(960, 600);

    SurfaceSource& surface = workbench.surface();
    connect(close, &QPushButton::clicked, this, &QDialog::hide);
    connect(again, &QPushButton::clicked, this,
            [this] { workbench_.surface().make(workbench_.settings().experiment.surface); });
    connect(progress_, &ProgressRow::stop, this, [this] {
        workbench_.surface().stop();
        figures_.stop();
    });
    connect(form_, &FileSurfaceForm::refused, this, [this](const QString& sentence) {
        refused_ = sentence;
        show_state();
    });
    connect(&figures_, &FiguresOfSurface::changed, this, [this] {
        show_state();
        show_report();
    });
    for (const auto signal : {&SurfaceSource::started, &SurfaceSource::read, &SurfaceSource::ready})
        connect(&surface, signal, this, &SurfaceFileDialog::follow_surface);
    connect(&surface, &SurfaceSource::failed, this, &SurfaceFileDialog::follow_surface);
}

QWidget* SurfaceFileDialog::make_left() {
    form_ = new FileSurfaceForm(workbench_);
    auto* scroll = new QScrollArea;
    scroll->setWidget(form_);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setFocusPolicy(Qt::NoFocus);
    scroll->setFixedWidth(52 * fontMetrics().averageCharWidth() +
                          scroll->verticalScrollBar()->sizeHint().width());
    return scroll;
}

QWidget* SurfaceFileDialog::make_right() {
    pictures_ = new BeforeAfter;
    report_ = new QTextBrowser;
    report_->setObjectName("surface-file-report");
    report_->setAccessibleName(tr("Report"));
    report_->setFrameShape(QFrame::NoFrame);
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(pictures_);
    split->addWidget(report_);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    split->setChildrenCollapsible(false);
    return split;
}

void SurfaceFileDialog::showEvent(QShowEvent* event) {
    QDialog::showEvent(event);
    follow_surface();
}

void SurfaceFileDialog::hideEvent(QHideEvent* event) {
    figures_.forget();
    QDialog::hideEvent(event);
}

void SurfaceFileDialog::changeEvent(QEvent* event) {
    QDialog::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && isVisible()) show_state();
}

void SurfaceFileDialog::follow_surface() {
    if (!isVisible()) return;
    const SurfaceSource& surface = workbench_.surface();
    const FileReading* reading = surface.reading();
    if (!surface.busy()) refused_.clear();
    const QString path = QString::fromStdString(workbench_.settings().experiment.surface.file);
    setWindowTitle(path.isEmpty() ? tr("Surface File")
                                  : tr("Surface File - %1").arg(QFileInfo(path).fileName()));
    if (reading == nullptr)
        pictures_->set_maps({}, {});
    else
        pictures_->set_maps(reading->before, reading->after);
    if (surface.busy() || reading == nullptr || reading->patch == nullptr)
        figures_.forget();
    else
        figures_.want(reading->patch, in_unit(surface.settings().wavelength, "m").value_or(0));
    show_state();
    show_report();
}

void SurfaceFileDialog::show_state() {
    const SurfaceSource& surface = workbench_.surface();
    const QString trouble = in_words_of_forms(surface.trouble());
    form_->mark(setting_complained_of(surface.trouble()), trouble);
    pictures_->set_reason(surface.busy()      ? tr("being made ready")
                          : trouble.isEmpty() ? tr("Choose a file")
                                              : trouble);
    if (surface.busy())
        progress_->begin(tr("making the surface ready"));
    else if (!refused_.isEmpty())
        progress_->end(refused_, true);
    else if (!trouble.isEmpty())
        progress_->end(trouble, true);
    else if (figures_.busy())
        progress_->begin(tr("finding the figures"));
    else
        progress_->end({});
}

void SurfaceFileDialog::show_report() {
    const FileReading* reading = workbench_.surface().reading();
    QString html;
    if (reading != nullptr) {
        html += heading(tr("Read")) + lines_of(reading->found);
        if (reading->missing > 0)
            html += tr("%1 of %2 points missing")
                        .arg(reading->missing)
                        .arg(static_cast<qint64>(reading->before.nx) * reading->before.ny) +
                    "<br>";
        if (!reading->assumed.empty()) html += heading(tr("Assumed")) + lines_of(reading->assumed);
        if (reading->patch != nullptr) {
            html += heading(tr("Done"));
            html += lines_of(reading->prepared.empty() ? "nothing" : reading->prepared);
            html += lines_of(reading->tiling);
        }
    }
    if (!figures_.rows().empty())
        html += heading(tr("Figures of ISO 25178-2, of the surface before it is mirrored")) +
                table_of(figures_.rows());
    const int place = report_->verticalScrollBar()->value();
    report_->setHtml(html);
    report_->verticalScrollBar()->setValue(place);
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#include "export_dialog.h"

#include "../model/words.h"
#include "file_questions.h"
#include "rows.h"
#include "section.h"
#include "setting_line.h"

#include <asperity/core/error.h>
#include <asperity/params/param.h>

#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace asperity::studio {

namespace {

QString capital(const QString& sentence) {
    return sentence.left(1).toUpper() + sentence.mid(1);
}

QString endings_of(const io::BsdfFormat& format) {
    QStringList endings;
    for (const std::string& ending : format.endings)
        endings << "." + QString::fromStdString(ending);
    return endings.join(", ");
}

}  // namespace

ExportDialog::ExportDialog(Workbench& workbench, QWidget* parent)
    : QDialog(parent),
      workbench_(workbench),
      report_(new QTextBrowser),
      export_(new QPushButton(tr("Export..."))),
      background_(this, [this](const QString& why) { fail(why); }) {
    setObjectName("export-dialog");
    setWindowTitle(tr("Export"));
    for (const io::BsdfFormat& row : formats_.rows())
        if (row.write) writers_.push_back(&row);
    report_->setObjectName("export-report");
    report_->setAccessibleName(tr("What was written"));
    report_->setFrameShape(QFrame::NoFrame);
    progress_ = new ProgressRow("export", [this] { return run_ ? run_->progress() : Progress{}; });
    export_->setObjectName("export-write");
    auto* close = new QPushButton(tr("Close"));
    close->setObjectName("close-export");
    close->setAutoDefault(false);
    auto* columns = new QHBoxLayout;
    columns->addWidget(make_left());
    columns->addWidget(report_, 1);
    auto* row = new QHBoxLayout;
    row->addWidget(progress_, 1);
    row->addWidget(export_);
    row->addWidget(close);
    auto* column = new QVBoxLayout(this);
    column->addLayout(columns, 1);
    column->addLayout(row);
    resize(900, 520);

    connect(export_, &QPushButton::clicked, this, &ExportDialog::ask_for_file);
    connect(close, &QPushButton::clicked, this, &QDialog::hide);
    connect(progress_, &ProgressRow::stop, this, [this] {
        if (run_) run_->request_stop();
    });
    connect(source_, &SourcePicker::changed, this, &ExportDialog::show_state);
    show_format();
}

QWidget* ExportDialog::make_left() {
    auto* left = new QWidget;
    auto* column = new QVBoxLayout(left);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* from = new Section(tr("From"));
    source_ = new SourcePicker("export", workbench_, SourcePicker::Models::Yes);
    from->add_named_row(tr("BRDF"), source_, tr("What is written"));
    column->addWidget(from);

    auto* to = new Section(tr("To"));
    format_ = new QComboBox;
    format_->setObjectName("export-format");
    format_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    format_->setMinimumContentsLength(12);
    for (const io::BsdfFormat* row : writers_) {
        format_->addItem(
            QString("%1  (%2)").arg(QString::fromStdString(row->name), endings_of(*row)));
        format_->setItemData(format_->count() - 1, QString::fromStdString(row->doc),
                             Qt::ToolTipRole);
    }
    to->add_named_row(tr("Format"), format_, tr("Of the file, by the program that reads it"));
    doc_ = new QLabel;
    doc_->setObjectName("export-doc");
    doc_->setWordWrap(true);
    doc_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    doc_->setFixedHeight(4 * doc_->fontMetrics().lineSpacing());
    to->form().addRow(doc_);
    snippets_ = new QCheckBox(tr("Scenes beside the file"));
    snippets_->setObjectName("export-snippets");
    snippets_->setToolTip(tr("Of Mitsuba, pbrt or Radiance, that show a sphere of it"));
    to->form().addRow(QString(), snippets_);
    max_error_ = new QLineEdit;
    max_error_->setObjectName("export-max-error");
    max_error_->setPlaceholderText(tr("never"));
    to->add_named_row(tr("Fail Above"), max_error_,
                      tr("Of the mean L1 of f cos, when the file is read back: 2% or 0.02"));
    connect(max_error_, &QLineEdit::textEdited, this, [this] { mark_field(*max_error_, false); });
    column->addWidget(to);

    auto* options = new Section(tr("Options of the Format"));
    options_ = new QWidget;
    new QFormLayout(options_);
    auto* scroll = new QScrollArea;
    scroll->setWidget(options_);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setFocusPolicy(Qt::NoFocus);
    options->form().addRow(scroll);
    column->addWidget(options, 1);
    left->setFixedWidth(56 * fontMetrics().averageCharWidth());
    connect(format_, &QComboBox::currentIndexChanged, this, &ExportDialog::show_format);
    return left;
}

const io::BsdfFormat& ExportDialog::format() const {
    return *writers_[static_cast<std::size_t>(std::max(0, format_->currentIndex()))];
}

void ExportDialog::show_format() {
    const io::BsdfFormat& row = format();
    doc_->setText(capital(QString::fromStdString(row.doc)));
    doc_->setToolTip(doc_->text());
    auto* form = static_cast<QFormLayout*>(options_->layout());
    while (form->rowCount() > 0) form->removeRow(0);
    fields_.clear();
    form->setContentsMargins(0, 0, 6, 0);
    form->setVerticalSpacing(5);
    for (const io::FormatOption& option : row.options) {
        auto* line = new QLineEdit;
        line->setObjectName("export-option-" + QString::fromStdString(option.name));
        line->setPlaceholderText(QString::fromStdString(
            option.otherwise.empty() ? std::string("from the data") : option.otherwise));
        line->setToolTip(QString::fromStdString(option.doc));
        auto* name = new QLabel(QString::fromStdString(option.name));
        name->setToolTip(line->toolTip());
        name->setMinimumWidth(label_width(fontMetrics()));
        name->setBuddy(line);
        form->addRow(name, line);
        fields_[option.name] = line;
        connect(line, &QLineEdit::textEdited, line, [line] { mark_field(*line, false); });
    }
    if (row.options.empty()) form->addRow(new QLabel(tr("none")));
    max_error_->setEnabled(row.read != nullptr);
    if (!row.read) max_error_->clear();
    const bool scenes = has_snippets(row.name);
    snippets_->setEnabled(scenes);
    if (!scenes) snippets_->setChecked(false);
    show_state();
}

std::string ExportDialog::options_text() const {
    std::string text;
    for (const auto& [name, line] : fields_)
        if (const std::string value = line->text().trimmed().toStdString(); !value.empty())
            text += (text.empty() ? "" : ",") + name + "=" + value;
    return text;
}

/// Throws Error(Usage, "max-error").
double ExportDialog::max_error() const {
    ParamInfo info{.name = "max-error", .range = kAboveZero, .percent = true};
    info.type = ParamType::Real;
    const std::string text = max_error_->text().trimmed().toStdString();
    if (text.empty()) return kNoEnd;
    const ParamValue value = parse(info, text);
    check(info, value);
    return std::get<double>(value);
}

void ExportDialog::show_state() {
    const bool there = source_->source().kind != BrdfSource::Kind::Drawn ||
                       workbench_.drawing().result() != nullptr;
    export_->setEnabled(!busy() && there);
    export_->setToolTip(there ? tr("Asks for a name and writes the file")
                              : tr("Nothing is drawn yet: Draw To Textures first"));
}

void ExportDialog::ask_for_file() {
    const io::BsdfFormat& row = format();
    QStringList patterns;
    for (const std::string& ending : row.endings) patterns << "*." + QString::fromStdString(ending);
    ask_file_to_save(
        this, tr("Export"), tr("%1 (%2)").arg(QString::fromStdString(row.name), patterns.join(' ')),
        QString::fromStdString(row.endings.front()), [this](const QString& path) { write(path); });
}

void ExportDialog::write(const QString& path) {
    if (busy()) return;
    for (const auto& [name, line] : fields_) mark_field(*line, false);
    ExportWish wish{source_->source(),      workbench_.drawing().result(),
                    format().name,          options_text(),
                    snippets_->isChecked(), QFile::encodeName(path).toStdString()};
    mark_field(*max_error_, false);
    try {
        wish.max_error = max_error();
    } catch (const Error& error) {
        return fail(QString::fromUtf8(error.what()));
    }
    run_ = std::make_shared<Run>();
    background_.start(
        [this, wish](Run& run, const Background::Post&) -> Background::Delivery {
            const ExportOutcome outcome = export_brdf(wish, run);
            return [this, outcome] { end(outcome); };
        },
        run_);
    report_->clear();
    progress_->begin(tr("exporting"));
    show_state();
}

void ExportDialog::end(const ExportOutcome& outcome) {
    QString html;
    if (!outcome.written.isEmpty()) html += heading(tr("Written"));
    for (const QString& path : outcome.written) html += path.toHtmlEscaped() + "<br>";
    if (!outcome.fidelity.isEmpty())
        html +=
            heading(tr("Fidelity")) + "<p>" + capital(outcome.fidelity).toHtmlEscaped() + "</p>";
    if (!outcome.remarks.isEmpty()) html += heading(tr("Remarks"));
    for (const QString& remark : outcome.remarks)
        html += "<p>" + capital(remark).toHtmlEscaped() + "</p>";
    report_->setHtml(html);
    const QString name =
        outcome.written.isEmpty() ? QString() : QFileInfo(outcome.written.first()).fileName();
    const QString far = tr("%1 is written, but holds the data within %2 % only")
                            .arg(name)
                            .arg(100 * outcome.mean_l1, 0, 'g', 3);
    progress_->end(outcome.too_far    ? far
                   : !outcome.stopped ? tr("%1 is written").arg(name)
                   : outcome.written.isEmpty()
                       ? tr("stopped before anything was written")
                       : tr("stopped: %1 is whole, it was not read back").arg(name),
                   outcome.stopped || outcome.too_far);
    for (const QString& path : outcome.written) workbench_.log(tr("wrote %1").arg(path));
    if (!outcome.fidelity.isEmpty()) workbench_.log(outcome.fidelity);
    show_state();
    emit exported();
}

void ExportDialog::fail(const QString& sentence) {
    const std::string where = sentence.section(": ", 0, 0).toStdString();
    if (const auto field = fields_.find(where); field != fields_.end())
        mark_field(*field->second, true);
    if (where == "max-error") mark_field(*max_error_, true);
    progress_->end(in_words_of_forms(sentence), true);
    show_state();
    emit exported();
}

}  // namespace asperity::studio

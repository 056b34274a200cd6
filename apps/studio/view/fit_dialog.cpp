// SPDX-License-Identifier: Apache-2.0
#include "fit_dialog.h"

#include "../model/settings_keys.h"
#include "../model/words.h"
#include "file_questions.h"
#include "fit_table.h"
#include "param_control.h"
#include "section.h"

#include <asperity/bsdf/bsdf_models.h>

#include <shared/write_materialx.h>
#include <shared/write_residuals.h>

#include <QClipboard>
#include <QFile>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace asperity::studio {

namespace {

QPushButton* make_button(const QString& label, const char* name, const QString& tooltip) {
    auto* button = new QPushButton(label);
    button->setObjectName(name);
    button->setToolTip(tooltip);
    button->setAutoDefault(false);
    return button;
}

}  // namespace

FitDialog::FitDialog(Workbench& workbench, QWidget* parent)
    : QDialog(parent),
      workbench_(workbench),
      bindings_(workbench.document(), this),
      background_(this, [this](const QString& why) { fail(why); }) {
    setObjectName("fit-dialog");
    setWindowTitle(tr("Fit Models"));
    progress_ = new ProgressRow("fit", [this] { return run_ ? run_->progress() : Progress{}; });
    fit_ = make_button(tr("Fit"), "fit-begin", tr("Fits the models that are ticked"));
    QPushButton* close = make_button(tr("Close"), "close-fit", {});
    auto* columns = new QHBoxLayout;
    columns->addWidget(make_left());
    columns->addWidget(make_right(), 1);
    auto* row = new QHBoxLayout;
    row->addWidget(progress_, 1);
    row->addWidget(fit_);
    row->addWidget(close);
    auto* column = new QVBoxLayout(this);
    column->addLayout(columns, 1);
    column->addLayout(row);
    resize(960, 600);

    connect(fit_, &QPushButton::clicked, this, &FitDialog::begin);
    connect(close, &QPushButton::clicked, this, &QDialog::hide);
    connect(progress_, &ProgressRow::stop, this, [this] {
        if (!busy()) return;
        background_.cancel();
        progress_->end(tr("stopped"));
        show_state();
        emit fitted();
    });
    connect(source_, &SourcePicker::changed, this, &FitDialog::show_state);
    bindings_.follow([this](const StudioSettings&) { show_models(); });
    show_state();
}

QWidget* FitDialog::make_left() {
    auto* left = new QWidget;
    auto* column = new QVBoxLayout(left);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* from = new Section(tr("Data"));
    source_ = new SourcePicker("fit", workbench_, SourcePicker::Models::No);
    from->add_named_row(tr("BRDF"), source_, tr("What models are fitted to"));
    column->addWidget(from);

    auto* models = new Section(tr("Models"));
    models->form().addRow(make_models());
    column->addWidget(models, 1);

    auto* how = new Section(tr("How"));
    for (const char* name : {"metric", "reflectance", "free", "lambert", "light", "max-theta"}) {
        const auto& row = *asperity::find(all_params(), std::string("fit-") + name);
        const QString label = QString::fromStdString(asperity::label(row.info));
        how->add_named_row(label,
                           make_control(row, tr("Fit: %1").arg(label), bindings_,
                                        workbench_.document(), QString("fit-") + name),
                           tooltip_of(row));
    }
    column->addWidget(how);
    left->setFixedWidth(56 * fontMetrics().averageCharWidth());
    return left;
}

QWidget* FitDialog::make_models() {
    models_ = new QTreeWidget;
    models_->setObjectName("fit-models");
    models_->setAccessibleName(tr("Models"));
    models_->setRootIsDecorated(false);
    models_->setHeaderLabels({tr("Model"), tr("Held")});
    models_->headerItem()->setToolTip(1, tr("What is not fitted: metallic=1,k=ibl"));
    models_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
                             QAbstractItemView::SelectedClicked);
    models_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    models_->setMinimumHeight(7 * models_->fontMetrics().height());
    for (const BsdfModel& model : bsdf_models()) {
        const QString name = QString::fromStdString(model.name);
        auto* row = new QTreeWidgetItem(
            models_, {model.label.empty() ? name : QString::fromStdString(model.label)});
        row->setData(0, Qt::UserRole, name);
        row->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable |
                      Qt::ItemIsEditable);
        row->setCheckState(0, Qt::Checked);
        row->setToolTip(0, QString::fromStdString(model.doc));
        QStringList keys;
        for (const BsdfParam& param : model.params) keys << QString::fromStdString(param.info.name);
        row->setToolTip(
            1, tr("Not fitted but held, as in key=value,key=value: %1").arg(keys.join(", ")));
    }
    connect(models_, &QTreeWidget::itemChanged, this, &FitDialog::take_models);
    return models_;
}

/// What is ticked is the setting "model": "all", or "ggx,cook-torrance:metallic=1".
void FitDialog::show_models() {
    const std::string& asked = workbench_.settings().fit.models;
    const bool all = asked == "all";
    std::map<QString, QString> held;
    if (!all)
        for (const std::string& text : split_models(asked)) {
            const QString line = QString::fromStdString(text);
            held[line.section(':', 0, 0)] = line.section(':', 1);
        }
    const QSignalBlocker quiet(models_);
    for (int k = 0; k < models_->topLevelItemCount(); ++k) {
        QTreeWidgetItem* row = models_->topLevelItem(k);
        const auto found = held.find(row->data(0, Qt::UserRole).toString());
        const bool ticked = all || found != held.end();
        row->setCheckState(0, ticked ? Qt::Checked : Qt::Unchecked);
        row->setText(1, found != held.end() ? found->second : QString());
    }
    show_state();
}

void FitDialog::take_models() {
    QStringList asked;
    bool all = true;
    for (int k = 0; k < models_->topLevelItemCount(); ++k) {
        const QTreeWidgetItem* row = models_->topLevelItem(k);
        const bool ticked = row->checkState(0) == Qt::Checked;
        const QString held = row->text(1).trimmed();
        all = all && ticked && held.isEmpty();
        if (!ticked) continue;
        const QString name = row->data(0, Qt::UserRole).toString();
        asked << (held.isEmpty() ? name : name + ":" + held);
    }
    workbench_.document().change(tr("Fit: Models"), [&](StudioSettings& s) {
        s.fit.models = all ? "all" : asked.join(',').toStdString();
    });
    show_models();
}

QWidget* FitDialog::make_right() {
    auto* right = new QWidget;
    auto* column = new QVBoxLayout(right);
    column->setContentsMargins(0, 0, 0, 0);
    table_ = new QTreeWidget;
    table_->setObjectName("fit-table");
    table_->setAccessibleName(tr("Fits"));
    table_->setHeaderLabels({tr("Model")});
    table_->setAlternatingRowColors(true);
    verdict_ = new QLabel(tr("Errors are standard errors. χ²/dof near 1: as good as the data."));
    verdict_->setObjectName("fit-verdict");
    verdict_->setWordWrap(true);
    verdict_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    verdict_->setFixedHeight(5 * verdict_->fontMetrics().lineSpacing());
    verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(table_, 1);
    column->addWidget(verdict_);
    column->addLayout(make_uses());
    connect(table_, &QTreeWidget::itemSelectionChanged, this, &FitDialog::show_state);
    return right;
}

QLayout* FitDialog::make_uses() {
    plots_ = make_button(tr("Show in Plots"), "fit-to-plots",
                         tr("Draws the chosen fit beside the layers, in the plots and lobes"));
    compare_ = make_button(tr("Compare on Model"), "fit-to-compare",
                           tr("The data left of the line, the chosen fit right of it"));
    copy_ = make_button(tr("Copy Spec"), "fit-copy",
                        tr("The chosen fit as asperity render, plot, export take it"));
    residuals_ = make_button(tr("Save Residuals..."), "fit-residuals",
                             tr("A picture of the chosen fit over the data, layer by layer"));
    auto* row = new QHBoxLayout;
    materialx_ = make_button(tr("Save MaterialX..."), "fit-materialx",
                             tr("The chosen fit of ggx as an OpenPBR surface"));
    for (QPushButton* button : {plots_, compare_, copy_, residuals_, materialx_})
        row->addWidget(button);
    row->addStretch(1);
    connect(plots_, &QPushButton::clicked, this, [this] {
        const SurfaceSource& surface = workbench_.surface();
        std::optional<double> alpha;
        if (surface.surface()) alpha = surface.statistics().rms_gradient;
        workbench_.document().change(
            tr("Fit in Plots"), [&](StudioSettings& s) { put_in_plots(s, chosen()->spec, alpha); });
    });
    connect(compare_, &QPushButton::clicked, this, [this] {
        workbench_.document().change(tr("Compare Fit"), [&](StudioSettings& s) {
            put_in_compare(s, chosen()->spec, fitted_source_);
        });
    });
    connect(copy_, &QPushButton::clicked, this, [this] {
        QGuiApplication::clipboard()->setText(QString::fromStdString(chosen()->spec));
    });
    connect(residuals_, &QPushButton::clicked, this, &FitDialog::save_residuals);
    connect(materialx_, &QPushButton::clicked, this, &FitDialog::save_materialx);
    return row;
}

const Fit* FitDialog::chosen() const {
    if (!outcome_) return nullptr;
    const int row = table_->indexOfTopLevelItem(table_->currentItem());
    const std::vector<Fit>& fits = outcome_->report.fits;
    return row >= 0 && row < static_cast<int>(fits.size()) ? &fits[static_cast<std::size_t>(row)]
                                                           : nullptr;
}

void FitDialog::begin() {
    if (busy()) return;
    const FitWish wish{source_->source(), workbench_.drawing().result(), workbench_.settings().fit};
    fitted_source_ = wish.source;
    run_ = std::make_shared<Run>();
    background_.start(
        [this, wish](Run& run, const Background::Post&) -> Background::Delivery {
            const FitOutcome outcome = fit_brdf(wish, run);
            return [this, outcome] { end(outcome); };
        },
        run_);
    progress_->begin(tr("fitting"));
    show_state();
}

void FitDialog::end(const FitOutcome& outcome) {
    outcome_ = outcome;
    fill_fit_table(*table_, outcome);
    QString text = QString::fromStdString(outcome.report.verdict);
    text = text.left(1).toUpper() + text.mid(1) + ".";
    if (!outcome.report.note.empty()) {
        const QString note = QString::fromStdString(outcome.report.note);
        text += "\n" + note.left(1).toUpper() + note.mid(1) + ".";
    }
    if (!outcome.hint.isEmpty()) text += "\n" + outcome.hint;
    verdict_->setText(text);
    verdict_->setToolTip(text);
    progress_->end(tr("%1: %2 layers, %3 blocks of cells, metric %4")
                       .arg(QString::fromStdString(outcome.data->name))
                       .arg(outcome.data->layers.size())
                       .arg(outcome.data->blocks.size())
                       .arg(QString::fromStdString(fit_metric_name(outcome.report.metric))));
    workbench_.log(QString::fromStdString(outcome.report.verdict));
    show_state();
    emit fitted();
}

void FitDialog::fail(const QString& sentence) {
    progress_->end(in_words_of_forms(sentence), true);
    show_state();
    emit fitted();
}

void FitDialog::show_state() {
    const bool there = source_->source().kind != BrdfSource::Kind::Drawn ||
                       workbench_.drawing().result() != nullptr;
    const bool some = !workbench_.settings().fit.models.empty();
    fit_->setEnabled(!busy() && there && some);
    fit_->setToolTip(!there  ? tr("Nothing is drawn yet: Draw To Textures first")
                     : !some ? tr("Tick a model first")
                             : tr("Fits the models that are ticked"));
    for (QPushButton* button : {plots_, compare_, copy_, residuals_})
        button->setEnabled(chosen() != nullptr && !busy());
    materialx_->setEnabled(chosen() != nullptr && !busy() && fits_materialx(*chosen()));
}

void FitDialog::save_materialx() {
    ask_file_to_save(this, tr("Save MaterialX"), tr("MaterialX (*.mtlx)"), "mtlx",
                     [this, fit = *chosen()](const QString& path) {
                         try {
                             write_materialx(fit, QFile::encodeName(path).toStdString());
                             progress_->end(tr("%1 is written").arg(path));
                         } catch (const Error& error) {
                             progress_->end(QString::fromUtf8(error.what()), true);
                         }
                     });
}

void FitDialog::save_residuals() {
    ask_file_to_save(this, tr("Save Residuals"), tr("PNG (*.png)"), "png",
                     [this, outcome = *outcome_, fit = *chosen()](const QString& path) {
                         try {
                             write_residuals(*outcome.data, fit,
                                             QFile::encodeName(path).toStdString());
                             progress_->end(tr("%1 is written").arg(path));
                         } catch (const Error& error) {
                             progress_->end(QString::fromUtf8(error.what()), true);
                         }
                     });
}

}  // namespace asperity::studio

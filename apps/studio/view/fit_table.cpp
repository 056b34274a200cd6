// SPDX-License-Identifier: Apache-2.0
#include "fit_table.h"

#include <asperity/fit/verdict.h>

#include <QHeaderView>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

QString percent(double share) {
    return QObject::tr("%1 %").arg(100 * share, 0, 'f', 2);
}

QString param_name(const FittedParam& p) {
    const QString key = QString::fromStdString(p.key);
    return p.entry < 0 ? key : QString("%1[%2]").arg(key).arg(p.entry);
}

QString value_text(const FittedParam& p) {
    if (p.at_end) return QObject::tr("%1, the end of its range").arg(p.value, 0, 'g', 4);
    return with_error(p.value, p.error);
}

QTreeWidgetItem* row_of(const Fit& fit, const FitOutcome& outcome) {
    QStringList cells = {QString::fromStdString(fit.text)};
    if (outcome.report.metric != FitMetric::Chi2) cells << QString::number(fit.misfit, 'g', 4);
    if (outcome.data->has_errors()) cells << QString::fromStdString(figure_of(fit.chi2_per_dof, 4));
    cells << percent(fit.mean_l1);
    if (outcome.data->has_errors()) cells << percent(fit.mean_noise);
    cells << (fit.max_albedo_difference >= 0 ? "+" : "") +
                 QString::number(fit.max_albedo_difference, 'f', 4);
    auto* row = new QTreeWidgetItem(cells);
    row->setToolTip(0, QString::fromStdString(fit.spec));
    for (const FittedParam& p : fit.params) {
        auto* param = new QTreeWidgetItem(row, {param_name(p) + " = " + value_text(p)});
        param->setFirstColumnSpanned(true);
        param->setFlags(Qt::ItemIsEnabled);
    }
    return row;
}

}  // namespace

QString with_error(double value, double error) {
    if (!(error > 0) || !std::isfinite(error))
        return QObject::tr("%1 (error not known)").arg(value, 0, 'g', 4);
    const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 17);
    return QString("%1 ± %2").arg(value, 0, 'f', digits).arg(error, 0, 'f', digits);
}

void fill_fit_table(QTreeWidget& table, const FitOutcome& outcome) {
    table.clear();
    QStringList heads = {QObject::tr("Model")};
    if (outcome.report.metric != FitMetric::Chi2)
        heads << QString::fromStdString(fit_metric_name(outcome.report.metric));
    if (outcome.data->has_errors()) heads << QObject::tr("χ²/dof");
    heads << QObject::tr("L1");
    if (outcome.data->has_errors()) heads << QObject::tr("Noise");
    heads << QObject::tr("Albedo");
    table.setColumnCount(static_cast<int>(heads.size()));
    table.setHeaderLabels(heads);
    for (const Fit& fit : outcome.report.fits) table.addTopLevelItem(row_of(fit, outcome));
    for (int k = 0; k < table.topLevelItemCount(); ++k) {
        QTreeWidgetItem* row = table.topLevelItem(k);
        row->setExpanded(true);
        for (int p = 0; p < row->childCount(); ++p) row->child(p)->setFirstColumnSpanned(true);
        for (int column = 1; column < table.columnCount(); ++column)
            row->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
    table.header()->setStretchLastSection(false);
    table.header()->setSectionResizeMode(0, QHeaderView::Stretch);
    for (int column = 1; column < table.columnCount(); ++column) {
        table.headerItem()->setTextAlignment(column, Qt::AlignRight);
        table.header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    }
    if (table.topLevelItemCount() > 0) table.setCurrentItem(table.topLevelItem(0));
}

}  // namespace asperity::studio

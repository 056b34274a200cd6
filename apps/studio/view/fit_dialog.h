// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/background.h"
#include "../model/fit_job.h"
#include "bindings.h"
#include "progress_row.h"
#include "source_picker.h"

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>

#include <optional>

namespace asperity::studio {

/// Fits models to a BRDF and shows how good they are; a fit goes on into the plots, or beside the
/// data on the model. Models are those of bsdf_models(), settings the rows of fit_params().
class FitDialog : public QDialog {
    Q_OBJECT

  public:
    explicit FitDialog(Workbench& workbench, QWidget* parent = nullptr);

    /// Begins; nothing while it runs. `fitted` follows.
    void begin();
    bool busy() const { return background_.busy(); }
    /// Of the latest run; none before.
    const FitOutcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
    SourcePicker& source() { return *source_; }
    QTreeWidget& table() { return *table_; }

  signals:
    void fitted();

  private:
    QWidget* make_left();
    QWidget* make_models();
    QWidget* make_right();
    QLayout* make_uses();
    void show_models();
    void take_models();
    void end(const FitOutcome& outcome);
    void fail(const QString& sentence);
    void show_state();
    void show_table();
    void save_residuals();
    void save_materialx();
    /// The fit that is chosen in the table; null: none.
    const Fit* chosen() const;

    Workbench& workbench_;
    Bindings bindings_;
    SourcePicker* source_;
    QTreeWidget *models_, *table_;
    QLabel* verdict_;
    ProgressRow* progress_;
    QPushButton *fit_, *plots_, *compare_, *copy_, *residuals_, *materialx_;
    std::optional<FitOutcome> outcome_;
    BrdfSource fitted_source_;
    std::shared_ptr<Run> run_;
    Background background_;
};

}  // namespace asperity::studio

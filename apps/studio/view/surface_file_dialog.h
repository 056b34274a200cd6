// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/figures_of_surface.h"
#include "../model/workbench.h"
#include "before_after.h"
#include "file_surface_form.h"
#include "progress_row.h"

#include <QDialog>
#include <QTextBrowser>

namespace asperity::studio {

/// A surface file made ready for light: the settings, pictures of before and after, and the report
/// of what was read, assumed and done, with the figures of ISO 25178. What is set acts at once, as
/// everywhere, and can be undone. Stays open beside the window.
class SurfaceFileDialog : public QDialog {
    Q_OBJECT

  public:
    explicit SurfaceFileDialog(Workbench& workbench, QWidget* parent = nullptr);

    QString report() const { return report_->toPlainText(); }

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void changeEvent(QEvent* event) override;

  private:
    QWidget* make_left();
    QWidget* make_right();
    void follow_surface();
    void show_state();
    void show_report();

    Workbench& workbench_;
    FileSurfaceForm* form_;
    BeforeAfter* pictures_;
    QTextBrowser* report_;
    ProgressRow* progress_;
    FiguresOfSurface figures_;
    QString refused_;  ///< what was typed last and is no value
};

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/background.h"
#include "../model/export_job.h"
#include "../model/workbench.h"
#include "progress_row.h"
#include "source_picker.h"

#include <asperity/formats/bsdfs/bsdf_format.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QLineEdit>
#include <QTextBrowser>

#include <map>

namespace asperity::studio {

/// Writes a BRDF in a format of other programs and reads the file back: what is lost is said.
/// Formats and their options are the rows of io::BsdfFormats.
class ExportDialog : public QDialog {
    Q_OBJECT

  public:
    explicit ExportDialog(Workbench& workbench, QWidget* parent = nullptr);

    /// Writes by what the fields say; nothing while it runs. `exported` follows.
    void write(const QString& path);
    bool busy() const { return background_.busy(); }
    QString report() const { return report_->toPlainText(); }

  signals:
    void exported();

  private:
    QWidget* make_left();
    void show_format();
    void ask_for_file();
    void end(const ExportOutcome& outcome);
    void fail(const QString& sentence);
    void show_state();
    const io::BsdfFormat& format() const;
    std::string options_text() const;
    double max_error() const;

    Workbench& workbench_;
    io::BsdfFormats formats_;
    std::vector<const io::BsdfFormat*> writers_;
    SourcePicker* source_;
    QComboBox* format_;
    QLabel* doc_;
    QWidget* options_;  ///< the fields of the format
    std::map<std::string, QLineEdit*> fields_;
    QCheckBox* snippets_;
    QLineEdit* max_error_;
    QTextBrowser* report_;
    ProgressRow* progress_;
    QPushButton* export_;
    std::shared_ptr<Run> run_;
    Background background_;
};

}  // namespace asperity::studio

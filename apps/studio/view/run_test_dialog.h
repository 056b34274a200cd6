// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/background.h"

#include <QDialog>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTreeWidget>

namespace asperity::studio {

/// The thesis' "Test Window" (figure 2.13a): runs the 79 checks in the background and shows each.
class RunTestDialog : public QDialog {
    Q_OBJECT

  public:
    explicit RunTestDialog(QWidget* parent = nullptr);

    void begin();  ///< from the first check; nothing while they run
    void stop();
    bool busy() const { return background_.busy(); }
    int passed() const { return passed_; }
    int ran() const { return done_; }

  signals:
    void finished_checks();

  protected:
    void done(int result) override;  ///< Exit, Esc or closed: stops

  private:
    void add(const QString& name, const QString& failure);
    void show_result();
    void end(const QString& why);

    QTreeWidget *textures_, *models_;
    QLabel* result_;
    QProgressBar* progress_;
    QPushButton *again_, *stop_;
    int done_ = 0, passed_ = 0;
    Background background_;
};

}  // namespace asperity::studio

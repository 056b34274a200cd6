// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTimer>
#include <QWidget>

#include <functional>

namespace asperity::studio {

/// How far work has come, and Stop; in the same place, while nothing runs, a sentence. Nothing
/// beside it moves when work begins and ends. The controls take the name given with "-progress",
/// "-stop" and "-message" behind it.
class ProgressRow : public QWidget {
    Q_OBJECT

  public:
    ProgressRow(const QString& name, std::function<Progress()> progress, QWidget* parent = nullptr);

    /// `doing` says what runs as long as the work does not say it itself.
    void begin(const QString& doing);
    void end(const QString& message, bool trouble = false);
    QString message() const { return message_->text(); }

  signals:
    void stop();

  private:
    void update_bar();

    std::function<Progress()> progress_;
    QProgressBar* bar_;
    QLabel* message_;
    QPushButton* stop_;
    QTimer timer_;
    QString doing_;
};

/// The colour of sentences about what went wrong.
QColor trouble_colour();

}  // namespace asperity::studio

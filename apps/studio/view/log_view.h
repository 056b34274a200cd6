// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QPlainTextEdit>

namespace asperity::studio {

/// The log window: what was printed to the log, what was drawn, what went wrong.
class LogView : public QPlainTextEdit {
    Q_OBJECT

  public:
    explicit LogView(Workbench& workbench, QWidget* parent = nullptr);

  protected:
    void contextMenuEvent(QContextMenuEvent* event) override;
};

/// Writes into the log what becomes of drawings and surfaces.
void log_events(Workbench& workbench);

}  // namespace asperity::studio

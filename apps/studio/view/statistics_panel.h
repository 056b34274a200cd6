// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/statistics_text.h"
#include "../model/workbench.h"
#include "section.h"

#include <QLabel>
#include <QTimer>

#include <functional>

namespace asperity::studio {

/// "Statistics" of one scene, thesis figures 2.6 - 2.8: a few times a second while it is seen.
class StatisticsPanel : public Section {
    Q_OBJECT

  public:
    using Look = std::function<StudioStatistics()>;

    StatisticsPanel(Workbench& workbench, Look look, QWidget* parent = nullptr);

    QString text() const { return text_->text(); }
    void refresh();
    void print_to_log();

  protected:
    void showEvent(QShowEvent*) override { refresh(); }

  private:
    Workbench& workbench_;
    Look look_;
    QLabel* text_;
    QTimer timer_;
};

}  // namespace asperity::studio

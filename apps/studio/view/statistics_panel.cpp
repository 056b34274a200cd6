// SPDX-License-Identifier: Apache-2.0
#include "statistics_panel.h"

#include <QPushButton>

namespace asperity::studio {

StatisticsPanel::StatisticsPanel(Workbench& workbench, Look look, QWidget* parent)
    : Section(tr("Statistics"), parent),
      workbench_(workbench),
      look_(std::move(look)),
      text_(new QLabel) {
    auto* print = new QPushButton(tr("Print to log"));
    print->setObjectName("print-to-log");
    print->setToolTip(tr("Writes these lines into the log window"));
    print->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    connect(print, &QPushButton::clicked, this, &StatisticsPanel::print_to_log);

    text_->setObjectName("statistics-text");
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    text_->setToolTip(
        tr("Frames of the picture while it moves; every cell of a surface counts as a mesh of two "
           "triangles, as in the thesis; rays launched by Draw To Textures"));
    form().addRow(print);
    form().addRow(text_);

    timer_.setInterval(250);
    connect(&timer_, &QTimer::timeout, this, [this] {
        if (isVisible()) refresh();
    });
    timer_.start();
}

void StatisticsPanel::refresh() {
    text_->setText(statistics_text(look_()));
}

void StatisticsPanel::print_to_log() {
    refresh();
    for (const QString& line : text().split('\n')) workbench_.log(line);
}

}  // namespace asperity::studio

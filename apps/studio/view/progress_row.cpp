// SPDX-License-Identifier: Apache-2.0
#include "progress_row.h"

#include "theme.h"

#include <QHBoxLayout>
#include <QStackedLayout>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr int kLookMs = 100, kSteps = 1000;

}  // namespace

QColor trouble_colour() {
    return is_dark() ? QColor("#f08a6a") : QColor("#b3401c");
}

ProgressRow::ProgressRow(const QString& name, std::function<Progress()> progress, QWidget* parent)
    : QWidget(parent),
      progress_(std::move(progress)),
      bar_(new QProgressBar),
      message_(new QLabel),
      stop_(new QPushButton(tr("Stop"))) {
    bar_->setObjectName(name + "-progress");
    bar_->setAccessibleName(tr("Progress"));
    message_->setObjectName(name + "-message");
    message_->setWordWrap(true);
    message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    // Two lines, whatever it says
    message_->setFixedHeight(message_->fontMetrics().lineSpacing() * 2 + 4);
    message_->setAlignment(Qt::AlignVCenter | Qt::AlignLeft);
    stop_->setObjectName(name + "-stop");
    stop_->setAutoDefault(false);

    auto* place = new QStackedLayout;
    auto* middle = new QWidget;
    auto* column = new QVBoxLayout(middle);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(bar_, 0, Qt::AlignVCenter);
    place->addWidget(message_);
    place->addWidget(middle);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addLayout(place, 1);
    row->addWidget(stop_, 0, Qt::AlignVCenter);
    connect(stop_, &QPushButton::clicked, this, &ProgressRow::stop);
    timer_.setInterval(kLookMs);
    connect(&timer_, &QTimer::timeout, this, &ProgressRow::update_bar);
    end({});
}

void ProgressRow::begin(const QString& doing) {
    doing_ = doing;
    message_->clear();
    static_cast<QStackedLayout*>(layout()->itemAt(0)->layout())->setCurrentIndex(1);
    stop_->setEnabled(true);
    timer_.start();
    update_bar();
}

void ProgressRow::end(const QString& message, bool trouble) {
    timer_.stop();
    QPalette colours;
    if (trouble) colours.setColor(QPalette::WindowText, trouble_colour());
    message_->setPalette(colours);
    message_->setText(message);
    message_->setToolTip(message);
    static_cast<QStackedLayout*>(layout()->itemAt(0)->layout())->setCurrentIndex(0);
    stop_->setEnabled(false);
}

void ProgressRow::update_bar() {
    const Progress now = progress_();
    const QString stage = now.stage.empty() ? doing_ : QString::fromStdString(now.stage);
    if (now.total == 0) {
        bar_->setRange(0, 0);
        bar_->setFormat(stage);
        return;
    }
    const double share = static_cast<double>(now.done) / static_cast<double>(now.total);
    bar_->setRange(0, kSteps);
    bar_->setValue(static_cast<int>(std::lround(kSteps * std::min(share, 1.0))));
    bar_->setFormat(stage + ", %p %");
}

}  // namespace asperity::studio

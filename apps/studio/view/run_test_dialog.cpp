// SPDX-License-Identifier: Apache-2.0
#include "run_test_dialog.h"

#include "section.h"

#include <checks/checks.h>

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace asperity::studio {

namespace {

QTreeWidget* make_list(const char* name) {
    auto* list = new QTreeWidget;
    list->setObjectName(name);
    list->setColumnCount(2);
    list->setHeaderHidden(true);
    list->setRootIsDecorated(false);
    list->setUniformRowHeights(true);
    list->setAlternatingRowColors(true);
    list->setMinimumHeight(8 * list->fontMetrics().height());
    return list;
}

Section* make_section(const QString& title, QTreeWidget* list) {
    auto* section = new Section(title);
    section->form().addRow(list);
    section->set_open(false);
    return section;
}

}  // namespace

RunTestDialog::RunTestDialog(QWidget* parent)
    : QDialog(parent),
      textures_(make_list("texture-tests")),
      models_(make_list("model-tests")),
      result_(new QLabel),
      progress_(new QProgressBar),
      again_(new QPushButton(tr("Run Again"))),
      stop_(new QPushButton(tr("Stop"))),
      background_(this, [this](const QString& why) { end(why); }) {
    setObjectName("run-test-dialog");
    setWindowTitle(tr("Test Window"));
    result_->setObjectName("final-result");
    again_->setObjectName("run-again");
    stop_->setObjectName("stop-test");
    progress_->setRange(0, checks::kThesisChecks);
    progress_->setTextVisible(false);
    auto* exit = new QPushButton(tr("Exit"));
    exit->setObjectName("exit-test");

    auto* layout = new QVBoxLayout(this);
    layout->addWidget(make_section(tr("Texture Resolution Test:"), textures_));
    layout->addWidget(make_section(tr("Load Model Test:"), models_));
    layout->addWidget(progress_);
    layout->addWidget(new QLabel(tr("Final Result:")));
    layout->addWidget(result_);
    layout->addStretch(1);
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(exit);
    buttons->addStretch(1);
    buttons->addWidget(stop_);
    buttons->addWidget(again_);
    layout->addLayout(buttons);
    resize(52 * fontMetrics().averageCharWidth(), 16 * fontMetrics().height());

    connect(exit, &QPushButton::clicked, this, &QDialog::reject);
    connect(again_, &QPushButton::clicked, this, &RunTestDialog::begin);
    connect(stop_, &QPushButton::clicked, this, &RunTestDialog::stop);
}

void RunTestDialog::begin() {
    if (busy()) return;
    textures_->clear();
    models_->clear();
    done_ = passed_ = 0;
    background_.start([this](Run& run, const Background::Post& post) -> Background::Delivery {
        const checks::CheckReport report = [&](const std::string& name,
                                               const std::string& failure) {
            post([this, name = QString::fromStdString(name),
                  why = QString::fromStdString(failure)] { add(name, why); });
        };
        checks::check_thesis(run, report);
        return [this] { end({}); };
    });
    show_result();
}

void RunTestDialog::stop() {
    background_.cancel();
    show_result();
}

void RunTestDialog::done(int result) {
    stop();
    QDialog::done(result);
}

void RunTestDialog::add(const QString& name, const QString& failure) {
    ++done_;
    if (failure.isEmpty()) ++passed_;
    QTreeWidget* list = name.startsWith("Texture") ? textures_ : models_;
    const QString outcome = failure.isEmpty() ? tr("PASSED") : tr("FAILED: %1").arg(failure);
    auto* item = new QTreeWidgetItem(list, {name, outcome});
    item->setForeground(1, QColor(failure.isEmpty() ? "#3f9c57" : "#d64545"));
    list->resizeColumnToContents(0);
    show_result();
}

void RunTestDialog::show_result() {
    progress_->setValue(done_);
    result_->setText(
        tr("%1 out of %2 Passed").arg(passed_).arg(busy() ? checks::kThesisChecks : done_));
    stop_->setEnabled(busy());
    again_->setEnabled(!busy());
}

void RunTestDialog::end(const QString& why) {
    show_result();
    if (!why.isEmpty()) result_->setText(why);
    emit finished_checks();
}

}  // namespace asperity::studio

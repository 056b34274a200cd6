// SPDX-License-Identifier: Apache-2.0
#include "file_field.h"

#include "file_questions.h"

#include <QHBoxLayout>

namespace asperity::studio {

FileField::FileField(const QString& name, const QString& title, const QString& filter,
                     QWidget* parent)
    : QWidget(parent), text_(new QLineEdit) {
    text_->setObjectName(name + "-file");
    text_->setAccessibleName(title);
    text_->setClearButtonEnabled(true);
    auto* button = new QToolButton;
    button->setObjectName("open-" + name);
    button->setAccessibleName(title);
    button->setText("…");
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(text_, 1);
    layout->addWidget(button);
    setFocusProxy(text_);

    const auto take = [this](const QString& path) {
        if (path == path_) return;
        set_path(path);
        emit chosen(path);
    };
    connect(text_, &QLineEdit::editingFinished, this, [this, take] { take(text_->text()); });
    connect(text_, &QLineEdit::textChanged, this, [take](const QString& path) {
        if (path.isEmpty()) take(path);  // by the button that clears it, which edits nothing
    });
    connect(button, &QToolButton::clicked, this,
            [this, title, filter, take] { ask_file_to_open(window(), title, filter, take); });
}

void FileField::set_path(const QString& path) {
    path_ = path;
    if (text_->text() != path) text_->setText(path);
    text_->setCursorPosition(static_cast<int>(path.size()));  // the name is in sight, not the root
}

void FileField::set_placeholder(const QString& placeholder) {
    text_->setPlaceholderText(placeholder);
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QLineEdit>
#include <QString>
#include <QToolButton>
#include <QWidget>

namespace asperity::studio {

/// A file's name to be typed, cleared, or chosen in a dialog. The text takes the name given with
/// "-file" behind it, the button "open-" before it.
class FileField : public QWidget {
    Q_OBJECT

  public:
    /// `title` and `filter` are those of the dialog.
    FileField(const QString& name, const QString& title, const QString& filter,
              QWidget* parent = nullptr);

    void set_path(const QString& path);                ///< without `chosen`
    void set_placeholder(const QString& placeholder);  ///< shown as long as there is no file

  signals:
    void chosen(const QString& path);  ///< by the user; empty: none

  private:
    QLineEdit* text_;
    QString path_;
};

}  // namespace asperity::studio

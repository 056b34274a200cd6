// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAbstractButton>
#include <QFontMetrics>
#include <QFormLayout>
#include <QWidget>

namespace asperity::studio {

/// The bar of a Section: a triangle and a title; a click or Space opens and closes it.
class SectionBar : public QAbstractButton {
    Q_OBJECT

  public:
    explicit SectionBar(const QString& title, QWidget* parent = nullptr);
    QSize sizeHint() const override;

  protected:
    void paintEvent(QPaintEvent*) override;
    void enterEvent(QEnterEvent*) override { update(); }
    void leaveEvent(QEvent*) override { update(); }
};

/// A group of controls under a bar, as the sub-menus of thesis figure 2.2b. Its object name is the
/// title in kebab-case; that of the bar ends in "-bar".
class Section : public QWidget {
    Q_OBJECT

  public:
    explicit Section(const QString& title, QWidget* parent = nullptr);

    /// Rows of label and control; what is not such a row goes in by form().addRow(widget).
    QFormLayout& form() { return *form_; }
    /// Such a row; label and control get the tooltip, and a control without an object name that of
    /// the label.
    void add_named_row(const QString& label, QWidget* control, const QString& tooltip);
    void set_open(bool open);
    bool is_open() const { return bar_->isChecked(); }

  protected:
    void showEvent(QShowEvent*) override;  ///< labels of all sections take the same width

  private:
    SectionBar* bar_;
    QWidget* body_;
    QFormLayout* form_;
};

/// What labels of rows get at least, so that fields of several forms stand below each other.
int label_width(const QFontMetrics& letters);

/// "Surface Roughness" -> "surface-roughness": the object name of a control from its label.
QString kebab_case(const QString& label);

}  // namespace asperity::studio

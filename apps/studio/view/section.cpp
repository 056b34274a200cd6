// SPDX-License-Identifier: Apache-2.0
#include "section.h"

#include "theme.h"

#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

SectionBar::SectionBar(const QString& title, QWidget* parent) : QAbstractButton(parent) {
    setText(title);
    setCheckable(true);
    setChecked(true);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Minimum, QSizePolicy::Fixed);
    setAccessibleName(title);
}

QSize SectionBar::sizeHint() const {
    const QFontMetrics metrics(font());
    const int height = metrics.height() * 3 / 2;
    return {metrics.horizontalAdvance(text()) + 2 * height, height};
}

void SectionBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);

    // The bar
    const double strength = underMouse() ? 0.42 : 0.30;
    const QColor colour = mix(palette().window().color(), palette().highlight().color(), strength);
    painter.setPen(hasFocus() ? QPen(palette().highlight(), 1.5) : QPen(Qt::NoPen));
    painter.setBrush(colour);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.75, 0.75, -0.75, -0.75), 3, 3);

    // The triangle points down while the section is open
    const double size = 0.22 * height();
    painter.translate(0.55 * height(), 0.5 * height());
    painter.save();
    if (isChecked()) painter.rotate(90);
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().windowText());
    const QPointF triangle[] = {{-0.7 * size, -size}, {size, 0}, {-0.7 * size, size}};
    painter.drawPolygon(triangle, 3);
    painter.restore();

    painter.setPen(palette().windowText().color());
    const QRectF place(0.6 * height(), -0.5 * height(), width() - 1.2 * height(), height());
    painter.drawText(place, Qt::AlignVCenter | Qt::AlignLeft, text());
}

Section::Section(const QString& title, QWidget* parent)
    : QWidget(parent), bar_(new SectionBar(title)), body_(new QWidget), form_(new QFormLayout) {
    setObjectName(kebab_case(title));
    bar_->setObjectName(objectName() + "-bar");
    body_->setLayout(form_);
    form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form_->setContentsMargins(8, 4, 4, 6);
    form_->setVerticalSpacing(5);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(bar_);
    layout->addWidget(body_);
    connect(bar_, &SectionBar::toggled, body_, &QWidget::setVisible);
}

void Section::showEvent(QShowEvent*) {
    const int width = label_width(fontMetrics());
    for (int row = 0; row < form_->rowCount(); ++row) {
        const QLayoutItem* item = form_->itemAt(row, QFormLayout::LabelRole);
        if (item && item->widget()) item->widget()->setMinimumWidth(width);
    }
}

void Section::add_named_row(const QString& label, QWidget* control, const QString& tooltip) {
    if (control->objectName().isEmpty() && control->focusProxy() == nullptr)
        control->setObjectName(kebab_case(label));
    control->setToolTip(tooltip);
    auto* name = new QLabel(label);
    name->setToolTip(tooltip);
    name->setBuddy(control);
    form_->addRow(name, control);
}

void Section::set_open(bool open) {
    bar_->setChecked(open);
}

int label_width(const QFontMetrics& letters) {
    return std::max(letters.horizontalAdvance("Surface Roughness"),
                    letters.horizontalAdvance("Texture Resolution"));
}

QString kebab_case(const QString& label) {
    QString name;
    for (const QChar letter : label.toLower()) {
        if (letter.isLetterOrNumber())
            name += letter;
        else if (!name.isEmpty() && !name.endsWith('-'))
            name += '-';
    }
    while (name.endsWith('-')) name.chop(1);
    return name;
}

}  // namespace asperity::studio

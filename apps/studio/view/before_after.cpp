// SPDX-License-Identifier: Apache-2.0
#include "before_after.h"

#include "theme.h"

#include <asperity/pictures/colour_map.h>

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr io::ColourMap kMap = io::ColourMap::Viridis;

QRgb pixel_of(const io::Colour& c) {
    const auto level = [](double part) {
        return static_cast<int>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
    };
    return qRgb(level(c.r), level(c.g), level(c.b));
}

QImage picture_of(const io::HeightMap& map) {
    QImage image(map.width, map.height, QImage::Format_RGB32);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const float h =
                map.heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(x)];
            image.setPixel(
                x, y,
                pixel_of(std::isnan(h) ? io::kZeroColour : io::colour_of(kMap, map.position(h))));
        }
    return image;
}

/// To three digits: more are no help at the end of a bar.
QString round_length(const io::HeightMap& map, double value) {
    return QString::fromStdString(map.length(QString::number(value, 'g', 3).toDouble()));
}

void paint_bar(QPainter& painter, const QRectF& bar, const io::HeightMap& map) {
    QLinearGradient gradient(bar.topLeft(), bar.topRight());
    constexpr int kStops = 16;
    for (int k = 0; k <= kStops; ++k) {
        const double t = static_cast<double>(k) / kStops;
        gradient.setColorAt(t, QColor(pixel_of(io::colour_of(kMap, t))));
    }
    painter.fillRect(bar, gradient);
    const QRectF below = bar.translated(0, bar.height() + 2);
    const QRectF text(below.left(), below.top(), below.width(), painter.fontMetrics().height());
    painter.drawText(text, Qt::AlignLeft, round_length(map, map.low));
    painter.drawText(text, Qt::AlignRight, round_length(map, map.high));
}

}  // namespace

BeforeAfter::BeforeAfter(QWidget* parent) : QWidget(parent) {
    before_.title = tr("As measured");
    after_.title = tr("Made ready");
    setAccessibleName(tr("The surface before and after"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void BeforeAfter::set_maps(const io::HeightMap& before, const io::HeightMap& after) {
    set_side(before_, before);
    set_side(after_, after);
    update();
}

void BeforeAfter::set_side(Side& side, const io::HeightMap& map) {
    side.map = map;
    side.image = map.width > 0 ? picture_of(map) : QImage();
    side.holes =
        std::any_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); });
}

void BeforeAfter::set_reason(const QString& reason) {
    reason_ = reason;
    update();
}

QSize BeforeAfter::sizeHint() const {
    const int em = fontMetrics().height();
    return {36 * em, 20 * em};
}

QSize BeforeAfter::minimumSizeHint() const {
    const int em = fontMetrics().height();
    return {18 * em, 11 * em};
}

void BeforeAfter::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const double gap = fontMetrics().height(), half = 0.5 * (width() - gap);
    paint_side(painter, {0, 0, half, 1.0 * height()}, before_);
    paint_side(painter, {half + gap, 0, half, 1.0 * height()}, after_);
}

void BeforeAfter::paint_side(QPainter& painter, const QRectF& area, const Side& side) const {
    const double line = fontMetrics().height();
    const QColor text = palette().color(QPalette::WindowText);
    const QColor faint = palette().color(QPalette::PlaceholderText);
    painter.setPen(text);
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.drawText(QRectF(area.left(), area.top(), area.width(), line), Qt::AlignLeft,
                     side.title);
    painter.setFont(font());
    if (side.holes) {
        painter.setPen(faint);
        painter.drawText(QRectF(area.left(), area.top(), area.width(), line), Qt::AlignRight,
                         tr("black: not measured"));
    }
    const QRectF room = area.adjusted(0, 2.3 * line, 0, -2.1 * line);
    if (side.image.isNull()) {
        painter.setPen(QPen(palette().color(QPalette::Mid), 1, Qt::DashLine));
        painter.drawRect(room.adjusted(0.5, 0.5, -0.5, -0.5));
        painter.setPen(faint);
        painter.drawText(room.adjusted(line, line, -line, -line),
                         Qt::AlignCenter | Qt::TextWordWrap, reason_);
        return;
    }
    painter.setPen(faint);
    const QString caption = QString::fromStdString(side.map.caption());
    painter.drawText(
        QRectF(area.left(), area.top() + line, area.width(), line), Qt::AlignLeft,
        fontMetrics().elidedText(caption, Qt::ElideRight, static_cast<int>(area.width())));
    const QSizeF size = QSizeF(side.image.size()).scaled(room.size(), Qt::KeepAspectRatio);
    const QRectF picture(room.topLeft(), size);
    painter.drawImage(picture, side.image);
    painter.setPen(text);
    paint_bar(painter, {area.left(), picture.bottom() + 0.35 * line, area.width(), 0.5 * line},
              side.map);
}

}  // namespace asperity::studio

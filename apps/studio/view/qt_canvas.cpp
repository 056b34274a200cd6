// SPDX-License-Identifier: Apache-2.0
#include "qt_canvas.h"

#include <asperity/core/directions.h>

#include <QFontInfo>
#include <QFontMetricsF>
#include <QImage>
#include <QPolygonF>

#include <algorithm>
#include <cmath>
#include <memory>

namespace asperity::studio {

namespace {

QFont sized(QFont font, plots::Font size) {
    font.setPixelSize(std::max(1, static_cast<int>(std::lround(size.size))));
    font.setBold(size.bold);
    return font;
}

QString words_of(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

class QtMeasure final : public plots::TextMeasure {
  public:
    explicit QtMeasure(const QFont& font) : font_(font) {}
    double width(std::string_view text, plots::Font font) const override {
        return QFontMetricsF(sized(font_, font)).horizontalAdvance(words_of(text));
    }
    double height(plots::Font font) const override {
        return QFontMetricsF(sized(font_, font)).height();
    }

  private:
    QFont font_;
};

QPen pen_of(const plots::Stroke& stroke) {
    const bool dashed = !stroke.dashes.empty();
    QPen pen(to_qt(stroke.colour), stroke.width, Qt::SolidLine, dashed ? Qt::FlatCap : Qt::RoundCap,
             Qt::RoundJoin);
    if (dashed) {
        QList<qreal> pattern;  // in widths of the pen
        for (const double length : stroke.dashes) pattern << length / stroke.width;
        pen.setDashPattern(pattern);
    }
    return pen;
}

QPolygonF polygon_of(std::span<const plots::Place> points) {
    QPolygonF polygon;
    for (const plots::Place point : points) polygon << to_qt(point);
    return polygon;
}

}  // namespace

QColor to_qt(plots::Colour c) {
    const auto part = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); };
    return QColor::fromRgbF(part(c.r), part(c.g), part(c.b), part(c.a));
}

plots::Colour from_qt(const QColor& colour) {
    return {double{colour.redF()}, double{colour.greenF()}, double{colour.blueF()},
            double{colour.alphaF()}};
}

plots::PlotStyle style_of(const QPalette& palette, const QFont& font) {
    return {std::make_shared<QtMeasure>(font), 1.0 * QFontInfo(font).pixelSize(),
            from_qt(palette.color(QPalette::Base)), from_qt(palette.color(QPalette::Text))};
}

QtCanvas::QtCanvas(QPainter& painter, const QFont& font) : painter_(painter), font_(font) {
    painter_.setRenderHint(QPainter::Antialiasing);
    painter_.setRenderHint(QPainter::SmoothPixmapTransform);
}

void QtCanvas::polyline(std::span<const plots::Place> points, const plots::Stroke& stroke) {
    painter_.setPen(pen_of(stroke));
    painter_.setBrush(Qt::NoBrush);
    painter_.drawPolyline(polygon_of(points));
}

void QtCanvas::polygon(std::span<const plots::Place> points, plots::Colour fill) {
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(to_qt(fill));
    painter_.drawPolygon(polygon_of(points), Qt::WindingFill);
}

void QtCanvas::arc(plots::Place centre, double radius, double from, double to,
                   const plots::Stroke& stroke) {
    constexpr double kSixteenths = 16;  // Qt's angles are sixteenths of a degree
    painter_.setPen(pen_of(stroke));
    painter_.setBrush(Qt::NoBrush);
    const QRectF square(centre.x - radius, centre.y - radius, 2 * radius, 2 * radius);
    painter_.drawArc(square, static_cast<int>(std::lround(kSixteenths * degrees(from))),
                     static_cast<int>(std::lround(kSixteenths * degrees(to - from))));
}

void QtCanvas::disc(plots::Place centre, double radius, plots::Colour fill) {
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(to_qt(fill));
    painter_.drawEllipse(to_qt(centre), radius, radius);
}

void QtCanvas::text(plots::Place place, std::string_view text, plots::Font font,
                    plots::Colour colour, plots::TextAlign align, double turn) {
    const QFont type = sized(font_, font);
    const QFontMetricsF metrics(type);
    const QString words = words_of(text);
    const double share = align == plots::TextAlign::Left     ? 0
                         : align == plots::TextAlign::Centre ? 0.5
                                                             : 1;
    painter_.save();
    painter_.translate(to_qt(place));
    painter_.rotate(-turn);
    painter_.setFont(type);
    painter_.setPen(to_qt(colour));
    painter_.drawText(QPointF(-share * metrics.horizontalAdvance(words),
                              (metrics.ascent() - metrics.descent()) / 2),
                      words);
    painter_.restore();
}

void QtCanvas::picture(const plots::Box& box, const plots::Raster& raster) {
    if (raster.width < 1 || raster.height < 1) return;
    const QImage image(reinterpret_cast<const uchar*>(raster.argb.data()), raster.width,
                       raster.height, QImage::Format_ARGB32_Premultiplied);
    painter_.drawImage(QRectF(box.left, box.top, box.width, box.height), image);
}

void QtCanvas::push_clip(const plots::Box& box) {
    painter_.save();
    painter_.setClipRect(QRectF(box.left, box.top, box.width, box.height), Qt::IntersectClip);
}

void QtCanvas::pop_clip() {
    painter_.restore();
}

double QtCanvas::pixels_per_unit() const {
    return painter_.device()->devicePixelRatioF();
}

}  // namespace asperity::studio

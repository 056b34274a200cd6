// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/canvas.h>
#include <asperity/plots/plot_style.h>

#include <QColor>
#include <QFont>
#include <QPainter>
#include <QPalette>
#include <QPointF>
#include <QRectF>

namespace asperity::studio {

inline QPointF to_qt(plots::Place place) {
    return {place.x, place.y};
}
inline plots::Place from_qt(QPointF place) {
    return {place.x(), place.y()};
}
inline plots::Box from_qt(const QRectF& box) {
    return {box.left(), box.top(), box.width(), box.height()};
}
QColor to_qt(plots::Colour colour);
plots::Colour from_qt(const QColor& colour);

/// Plots in the colours of the palette and the type of the font.
plots::PlotStyle style_of(const QPalette& palette, const QFont& font);

/// Lets the painters of plots draw on a widget or an image; units are its own.
class QtCanvas final : public plots::Canvas {
  public:
    /// `font`: the family that texts are written in.
    QtCanvas(QPainter& painter, const QFont& font);

    void polyline(std::span<const plots::Place> points, const plots::Stroke& stroke) override;
    void polygon(std::span<const plots::Place> points, plots::Colour fill) override;
    void arc(plots::Place centre, double radius, double from, double to,
             const plots::Stroke& stroke) override;
    void disc(plots::Place centre, double radius, plots::Colour fill) override;
    void text(plots::Place place, std::string_view text, plots::Font font, plots::Colour colour,
              plots::TextAlign align, double turn) override;
    void picture(const plots::Box& box, const plots::Raster& raster) override;
    void push_clip(const plots::Box& box) override;
    void pop_clip() override;
    double pixels_per_unit() const override;

  private:
    QPainter& painter_;
    QFont font_;
};

}  // namespace asperity::studio

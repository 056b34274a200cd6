// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot.h"
#include "plot_axis.h"
#include "plot_disc.h"

#include <asperity/gonio/measurement.h>
#include <asperity/pictures/layer_view.h>

#include <QImage>

#include <memory>

namespace asperity::studio {

/// The whole hemisphere of a layer seen from above, as a disc of radius sin(theta_o); phi_o = 0 to
/// the right, counter-clockwise. Equal areas are equal projected solid angles.
class HemispherePlot final : public Plot {
  public:
    struct Data {
        std::shared_ptr<const Measurement> head;
        std::shared_ptr<const Layer> layer;
        io::SkyMapSettings settings;
        std::optional<int> cell;               ///< outlined
        std::shared_ptr<DiscPainter> painter;  ///< for this plot and those that follow it
    };
    explicit HemispherePlot(Data data);

    void paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(QPointF place, const QRectF& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override;

    /// The square around the disc, as paint() has it in `area`.
    QRectF disc(const QRectF& area, const PlotStyle& style) const;
    /// Where a direction lies in `disc`.
    static QPointF place_of(const QRectF& disc, double theta, double phi);

  private:
    QString title() const;
    double standard_error(int cell) const;
    const QImage& image(int pixels) const;
    void paint_grid(QPainter& painter, const QRectF& disc, const PlotStyle& style) const;
    void paint_marks(QPainter& painter, const QRectF& disc) const;
    void paint_cell(QPainter& painter, const QRectF& disc) const;
    void paint_bar(QPainter& painter, const QRectF& disc, const PlotStyle& style) const;

    Data data_;
    std::vector<double> values_;  ///< of the cells
    io::ValueScale scale_;
    mutable QImage image_;  ///< as painted last
};

}  // namespace asperity::studio

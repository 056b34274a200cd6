// SPDX-License-Identifier: Apache-2.0
#include "model_lobes.h"

#include "plot_overlays.h"
#include "qt_canvas.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>

#include <QFontMetricsF>

#include <algorithm>

namespace asperity::studio {

std::vector<ModelLobe> model_lobes(const PlotView& plots, std::optional<double> surface_alpha,
                                   const Layers& layers, std::shared_ptr<const Layer> layer,
                                   const io::SkyMapSettings& look, const QPalette& palette) {
    std::vector<ModelLobe> lobes;
    const plots::PlotStyle style = style_of(palette, {});
    for (const OverlayModel& overlay : overlay_models(plots, surface_alpha, layers.head.get())) {
        std::shared_ptr<const Bsdf> model;
        try {
            model = parse_brdf_spec(overlay.spec);
        } catch (const Error&) {
            continue;
        }
        const QColor colour = to_qt(style.ink(model_ink(overlay.place)));
        const Lobe::Pixel tint = {static_cast<float>(colour.red()),
                                  static_cast<float>(colour.green()),
                                  static_cast<float>(colour.blue())};
        lobes.push_back(
            {overlay.title, colour,
             std::make_shared<const Lazy<Lobe>>([model, head = layers.head, layer, look, tint] {
                 return Lobe(*model, *head, *layer, look, tint);
             })});
    }
    return lobes;
}

void paint_lobe_legend(QPainter& painter, QPointF top_left, const std::vector<ModelLobe>& lobes) {
    if (lobes.empty()) return;
    const QFontMetricsF metrics = painter.fontMetrics();
    const double line = metrics.height() * 1.1, padding = 0.5 * metrics.height();
    double width = metrics.horizontalAdvance(QObject::tr("Simulated"));
    for (const ModelLobe& lobe : lobes)
        width = std::max(width, metrics.horizontalAdvance(lobe.title));
    const QRectF box(top_left, QSizeF(width + 2 * line + padding,
                                      static_cast<double>(lobes.size()) * line + padding));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 22, 26, 170));
    painter.drawRoundedRect(box, padding, padding);
    double y = box.top() + 0.5 * padding + 0.5 * line;
    for (const ModelLobe& lobe : lobes) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(lobe.colour);
        painter.drawEllipse(QPointF(box.left() + padding + 0.35 * line, y), 0.3 * line, 0.3 * line);
        painter.setPen(Qt::white);
        painter.drawText(QRectF(box.left() + padding + 1.2 * line, y - 0.5 * line, width + 1, line),
                         Qt::AlignVCenter | Qt::AlignLeft, lobe.title);
        y += line;
    }
}

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/drawing.h"
#include "../model/lazy.h"
#include "../model/lobe.h"
#include "../model/settings.h"

#include <QColor>
#include <QPainter>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace asperity::studio {

/// A model that the plots show, as a shell around the lobe of a layer.
struct ModelLobe {
    QString title;  ///< "GGX α = 0.3"
    QColor colour;  ///< of its curve
    std::shared_ptr<const Lazy<Lobe>> lobe;
};

/// Those that the plots show, in their order; models that cannot be made are left out, the plots
/// say why. `surface_alpha` as overlay_models() has it.
std::vector<ModelLobe> model_lobes(const PlotView& plots, std::optional<double> surface_alpha,
                                   const Layers& layers, std::shared_ptr<const Layer> layer,
                                   const io::SkyMapSettings& look, const QPalette& palette);

/// Which shell is which; `top_left` is the corner.
void paint_lobe_legend(QPainter& painter, QPointF top_left, const std::vector<ModelLobe>& lobes);

}  // namespace asperity::studio

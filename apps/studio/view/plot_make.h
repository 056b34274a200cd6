// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot_models.h"

#include "../model/drawing.h"

#include <asperity/plots/plot.h>
#include <asperity/plots/plot_disc.h>

#include <memory>
#include <optional>

namespace asperity::studio {

/// What a plot is made of, as it stands.
struct PlotSource {
    PlotView view;
    io::SkyMapSettings sky_map;  ///< colours, decades and channel as the dome has them
    int current_layer = 15;
    Layers layers;
    std::optional<int> cell;
    std::shared_ptr<const Heightfield> surface;
    std::optional<double> surface_alpha;
    std::shared_ptr<plots::DiscPainter> disc_painter;
};

/// The curves of models that the plot shows; none when there is nothing to compare with yet.
std::optional<ModelWish> models_for(const PlotSource& source);

/// The plot of the source's kind; `models`, if not null, are of its scene. Where there is nothing
/// to show, the plot says so.
std::shared_ptr<const plots::Plot> make_plot(const PlotSource& source, const ModelValues* models);

}  // namespace asperity::studio

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/dome.h"
#include "../model/drawing.h"
#include "viewport.h"

#include <QPainter>
#include <QString>

#include <optional>

namespace asperity::studio {

/// "Layer 12 of 15 · incident angle 18° · albedo 0.934 ± 0.001"; without a layer "not drawn yet"
/// stands for the albedo.
QString layer_text(const IlluminationSettings& light, int number, const Layers& layers,
                   int channel);

/// "θ 34.5°  φ 120.2°  f = 0.123 ± 0.004 /sr" of a cell; without a layer the direction alone.
QString cell_text(const Detector& detector, int cell, const Layers& layers, int number,
                  int channel);

/// Text in a box beside a place, kept inside `within`.
void paint_bubble(QPainter& painter, const QRectF& within, QPointF place, const QString& text);

/// What the colours of the paths mean, up to `most` reflections; `bottom_left` is its corner.
void paint_bounce_legend(QPainter& painter, QPointF bottom_left, std::size_t most);

/// The bar of the dome's colours with the values at its ends, in the corner at the lower right.
void paint_colour_bar(QPainter& painter, const QRectF& within, const io::ValueScale& scale,
                      io::ColourMap map);

/// The axes of the surface as the camera sees them, about `middle`.
void paint_axis_cross(QPainter& painter, QPointF middle, const Camera& camera);

}  // namespace asperity::studio

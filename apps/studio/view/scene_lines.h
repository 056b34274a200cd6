// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/surface_body.h"
#include "viewport.h"

#include <QColor>
#include <QPainter>

namespace asperity::studio {

/// Lines of the world painted over a picture of the surface: full in front of it, faint behind.
class SceneLines {
  public:
    struct Stroke {
        QColor from, to;      ///< at both ends, evenly between
        double width = 1.2;   ///< [pixels]
        double hidden = 0.2;  ///< share of the opacity left behind the surface

        explicit Stroke(const QColor& colour, double width_ = 1.2)
            : from(colour), to(colour), width(width_) {}
        Stroke(const QColor& from_, const QColor& to_, double width_ = 1.2)
            : from(from_), to(to_), width(width_) {}
    };

    /// `body` may be null: nothing hides anything then.
    SceneLines(QPainter& painter, const Viewport& view, const SurfaceBody* body)
        : painter_(painter), view_(view), body_(body) {}

    void line(Vec3 a, Vec3 b, const Stroke& stroke) const;
    void polyline(const std::vector<Vec3>& points, const Stroke& stroke) const;
    /// A disc of `radius` pixels.
    void dot(Vec3 at, const QColor& colour, double radius) const;

  private:
    bool hidden(Vec3 point) const {
        return body_ && body_->hides(view_.shown_camera().position, point);
    }

    QPainter& painter_;
    const Viewport& view_;
    const SurfaceBody* body_;
};

}  // namespace asperity::studio

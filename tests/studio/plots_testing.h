// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>
#include <QImage>
#include <QPointF>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace asperity::studio::test {

/// The largest difference of two colours in red, green or blue.
inline int difference(QColor a, QColor b) {
    return std::max({std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
                     std::abs(a.blue() - b.blue())});
}

/// The colour nearest to `wanted` within two pixels of a place.
inline int distance_near(const QImage& image, QPointF place, QColor wanted) {
    int best = 255;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const QPoint p = place.toPoint() + QPoint(dx, dy);
            if (image.rect().contains(p))
                best = std::min(best, difference(image.pixelColor(p), wanted));
        }
    return best;
}

}  // namespace asperity::studio::test

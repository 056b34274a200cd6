// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/horizon_terms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace asperity::detail {

namespace {

using Reach = HorizonReach;

struct Vec {
    double x, y;
};

double dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y;
}

/// A box of vectors.
struct Box {
    double x0, x1, y0, y1;

    double shortest() const {
        return std::hypot(std::max({x0, -x1, 0.0}), std::max({y0, -y1, 0.0}));
    }
};

/// A sector, described in its own quadrant.
struct Cone {
    double sign_x, sign_y;  ///< of its quadrant
    double from, to;        ///< angles, 0 <= from < to <= pi / 2

    Vec middle() const {
        return {sign_x * std::cos((from + to) / 2), sign_y * std::sin((from + to) / 2)};
    }
    /// max u . d over the directions d of the cone, of some u in its quadrant.
    double most(Vec u) const {
        const double angle = std::atan2(std::fabs(u.y), std::fabs(u.x));
        return std::cos(std::max({from - angle, angle - to, 0.0}));
    }
    /// Does some vector of the box (more than its rim) point into the cone?
    bool meets(const Box& box) const {
        const double x0 = std::max(0.0, sign_x > 0 ? box.x0 : -box.x1);
        const double x1 = sign_x > 0 ? box.x1 : -box.x0;
        const double y0 = std::max(0.0, sign_y > 0 ? box.y0 : -box.y1);
        const double y1 = sign_y > 0 ? box.y1 : -box.y0;
        constexpr double kRim = 1e-9;
        return x1 > kRim && y1 > kRim && std::atan2(y0, x1) < to - kRim &&
               std::atan2(y1, x0) > from + kRim;
    }
};

/// The terms of one sector, one for each offset: the nearest wins.
class Nearest {
  public:
    void add(int offset, double inverse) {
        double& known = terms_[offset];
        known = std::max(known, inverse);
    }
    HorizonTerms list() const {
        HorizonTerms result;
        for (const auto& [offset, inverse] : terms_)
            result.push_back({offset, static_cast<float>(inverse)});
        return result;
    }

  private:
    std::map<int, double> terms_;
};

/// Builds the lists of one sector.
class SectorBuilder {
  public:
    SectorBuilder(const Cone& cone, double aspect, const HorizonGeometry::Pitches& pitches)
        : cone_(cone), aspect_(aspect), pitches_(pitches) {}

    HorizonSector build() const {
        HorizonSector s;
        const Vec u = cone_.middle();
        for (int k = 0; k < 4; ++k) {
            const Vec v{static_cast<double>(k % 2), aspect_ * (k / 2)};
            s.back[k] = static_cast<float>(front_of(u) - dot(u, v));
        }
        add_samples(s);
        add_windows(s);
        s.tiles = tiles(Reach::kTile, Reach::kTilesInside, Reach::kTiles, Reach::kWindows,
                        pitches_.tiles);
        s.wide_tiles = tiles(Reach::kWideTile, Reach::kWideTilesInside, Reach::kWideTiles,
                             Reach::kTile * Reach::kTiles, pitches_.wide_tiles);
        return s;
    }

  private:
    /// max u . p over the points p of the viewer's cell.
    double front_of(Vec u) const { return std::max(u.x, 0.0) + aspect_ * std::max(u.y, 0.0); }

    /// All q - p for p in a square of `from` cells at (0, 0), q in one of `to` cells at (a, b).
    Box between(int a, int b, int from, int to) const {
        return {static_cast<double>(a - from), static_cast<double>(a + to), aspect_ * (b - from),
                aspect_ * (b + to)};
    }

    /// Distance of sample (a, b) along u, counted so that `slope` times it is what a line of this
    /// slope in the sector climbs at most; <= 0 if u is of no use here.
    double along(Vec u, int a, int b) const {
        return (dot(u, {static_cast<double>(a), aspect_ * b}) - front_of(u)) / cone_.most(u);
    }

    /// 1 / along() of the corners of cell (a, b), or infinity.
    std::array<double, 4> inverses(Vec u, int a, int b) const {
        std::array<double, 4> result;
        for (int k = 0; k < 4; ++k) {
            const double distance = along(u, a + k % 2, b + k / 2);
            result[static_cast<std::size_t>(k)] =
                distance > 0 ? 1 / distance : std::numeric_limits<double>::infinity();
        }
        return result;
    }

    static double sum(const std::array<double, 4>& values) {
        return values[0] + values[1] + values[2] + values[3];
    }

    void add_samples(HorizonSector& s) const {
        Nearest plane, close_front, close_blunt, front, blunt;
        const auto add = [](Nearest& to, const std::array<double, 4>& inverse, int a, int b,
                            int pitch) {
            for (int k = 0; k < 4; ++k)
                to.add((b + k / 2) * pitch + a + k % 2, inverse[static_cast<std::size_t>(k)]);
        };
        for (int b = -Reach::kNear; b <= Reach::kNear; ++b) {
            for (int a = -Reach::kNear; a <= Reach::kNear; ++a) {
                const int ring = std::max(std::abs(a), std::abs(b));
                const Box box = between(a, b, 1, 1);
                if (ring < 2 || !cone_.meets(box)) continue;
                std::array<double, 4> bluntly;
                bluntly.fill(1 / box.shortest());
                const auto straight = inverses(cone_.middle(), a, b);
                const bool sharp = sum(straight) < sum(bluntly), close = ring <= Reach::kPlane;
                Nearest& list =
                    close ? (sharp ? close_front : close_blunt) : (sharp ? front : blunt);
                add(list, sharp ? straight : bluntly, a, b, pitches_.samples);
                if (!close) continue;
                // The plane is taken off already, so any direction will do to measure along
                std::array<double, 4> best = bluntly;
                for (const auto& other : {straight, inverses({cone_.sign_x, 0}, a, b),
                                          inverses({0, cone_.sign_y}, a, b)})
                    if (sum(other) < sum(best)) best = other;
                add(plane, best, a + Reach::kPlane, b + Reach::kPlane, pitches_.plane);
            }
        }
        s.plane = plane.list();
        s.close_front = close_front.list();
        s.close_blunt = close_blunt.list();
        s.front = front.list();
        s.blunt = blunt.list();
    }

    void add_windows(HorizonSector& s) const {
        constexpr int kSize = Reach::kWindow;
        Nearest front, blunt;
        for (int b = -Reach::kWindows; b <= Reach::kWindows; b += kSize) {
            for (int a = -Reach::kWindows; a <= Reach::kWindows; a += kSize) {
                const auto inside = [](int x) { return std::abs(x + kSize / 2) <= Reach::kNear; };
                const Box box = between(a, b, 1, kSize);
                if ((inside(a) && inside(b)) || !cone_.meets(box)) continue;
                double straight = std::numeric_limits<double>::infinity();
                for (int k = 0; k < 4; ++k)
                    straight = std::min(
                        straight, along(cone_.middle(), a + kSize * (k % 2), b + kSize * (k / 2)));
                // Looking along the sector's middle knows better where in the cell a path starts
                constexpr double kWorth = 0.95;
                const bool sharp = straight > kWorth * box.shortest();
                (sharp ? front : blunt)
                    .add(b * pitches_.samples + a, 1 / (sharp ? straight : box.shortest()));
            }
        }
        s.window_front = front.list();
        s.window_blunt = blunt.list();
    }

    /// Tiles of `size` cells seen from blocks of as many; what is nearer than `seen` cells in both
    /// directions has been seen already.
    HorizonTerms tiles(int size, int inside, int reach, int seen, int pitch) const {
        Nearest result;
        const double least = (seen + 1 - 1) * std::min(1.0, aspect_);
        for (int b = -reach; b <= reach; ++b) {
            for (int a = -reach; a <= reach; ++a) {
                const Box box = between(a * size, b * size, size, size);
                if (std::max(std::abs(a), std::abs(b)) <= inside || !cone_.meets(box)) continue;
                result.add(b * pitch + a, 1 / std::max(box.shortest(), least));
            }
        }
        return result.list();
    }

    const Cone& cone_;
    double aspect_;
    const HorizonGeometry::Pitches& pitches_;
};

}  // namespace

HorizonGeometry::HorizonGeometry(double dx, double dy, const Pitches& pitches)
    : aspect(static_cast<float>(dy / dx)) {
    constexpr double kWidth = std::numbers::pi / 8;
    secant = static_cast<float>(1 / std::cos(kWidth / 2));
    for (int k = 0; k < kEdges; ++k) {
        edge_x[k] = k == kEdges - 1 ? 0 : static_cast<float>(std::cos(kWidth * k));
        edge_y[k] = static_cast<float>(std::sin(kWidth * k));
    }
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        for (int k = 0; k < 4; ++k) {
            const Cone cone{quadrant & 1 ? -1.0 : 1.0, quadrant & 2 ? -1.0 : 1.0, kWidth * k,
                            kWidth * (k + 1)};
            sectors[sector(quadrant, k)] = SectorBuilder(cone, dy / dx, pitches).build();
        }
    }
    const double all = HorizonReach::kWideTile * HorizonReach::kWideTiles;
    beyond = static_cast<float>(1 / (all * std::min(1.0, dy / dx)));
}

}  // namespace asperity::detail

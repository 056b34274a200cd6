// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/random.h>
#include <asperity/surface/make_surface.h>
#include <asperity/tracing/engines/wide/horizon.h>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace asperity {
namespace {

constexpr double kSectorWidth = 2 * std::numbers::pi / Horizon::kSectors;

Heightfield noise(int nx, int ny, double height, std::uint64_t seed) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    const CounterRandom random(seed, 0);
    for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(nx * ny); ++k)
        s.heights.push_back(static_cast<float>(height * random.uniform2(k)[0]));
    return s;
}

Heightfield shape(const std::string& kind, int size, double alpha = 0.3) {
    SurfaceSettings settings;
    settings.kind = kind;
    settings.size = size;
    settings.alpha_x = settings.alpha_y = alpha;
    Run run(2);
    return make_surface(settings, run);
}

/// Height at (x, y) [length] straight from the definition of the triangles. In the frame of the
/// padded heights: x runs backwards over a surface with the main diagonal.
double height_in_frame(const Heightfield& s, double x, double y) {
    const bool main = s.diagonal == Diagonal::Main;
    const double gx = main ? s.cells_x() - x / s.dx : x / s.dx, gy = y / s.dy;
    double i = std::floor(gx), j = std::floor(gy);
    if (s.boundary == Boundary::Finite) {
        i = std::clamp(i, 0.0, s.cells_x() - 1.0);
        j = std::clamp(j, 0.0, s.cells_y() - 1.0);
    }
    const double u = gx - i, v = gy - j;
    const auto h = [&](int a, int b) {
        const int p = ((static_cast<int>(i) + a) % s.nx + s.nx) % s.nx;
        const int q = ((static_cast<int>(j) + b) % s.ny + s.ny) % s.ny;
        return static_cast<double>(s.heights[static_cast<std::size_t>(q * s.nx + p)]);
    };
    const double h00 = h(0, 0), h10 = h(1, 0), h01 = h(0, 1), h11 = h(1, 1);
    if (main)
        return u > v ? h00 + u * (h10 - h00) + v * (h11 - h10)
                     : h00 + v * (h01 - h00) + u * (h11 - h01);
    return u + v < 1 ? h00 + u * (h10 - h00) + v * (h01 - h00)
                     : h11 + (1 - u) * (h01 - h11) + (1 - v) * (h10 - h11);
}

int sector_to(double angle) {
    return Horizon::sector_of(static_cast<float>(std::cos(angle)),
                              static_cast<float>(std::sin(angle)));
}

/// Looks from random points (corners and rims of cells among them) in random directions (borders of
/// sectors among them) at random distances (samples among them), and counts what is seen steeper
/// than the horizon says.
int count_above_horizon(const Heightfield& s, int looks) {
    const PaddedHeights padded(s, 2);
    const Horizon horizon(padded, 2);
    const double width = s.dx * padded.cells_x(), depth = s.dy * padded.cells_y();
    const double furthest = std::log(3000 * std::hypot(s.dx, s.dy));
    int above = 0;
    for (int n = 0; n < looks; ++n) {
        const CounterRandom random(7, static_cast<std::uint32_t>(n));
        const auto where = random.uniform2(0), place = random.uniform2(1), rim = random.uniform2(2),
                   aim = random.uniform2(3), how = random.uniform2(4);
        const int i = static_cast<int>(where[0] * padded.cells_x());
        const int j = static_cast<int>(where[1] * padded.cells_y());
        const double u = rim[0] < 0.3 ? std::round(place[0]) : place[0];
        const double v = rim[1] < 0.3 ? std::round(place[1]) : place[1];
        const double px = (i + u) * s.dx, py = (j + v) * s.dy;

        const double turn = aim[0] * Horizon::kSectors;
        const double angle = kSectorWidth * (how[0] < 0.2 ? std::round(turn) : turn);
        const double nearest = std::log(0.01 * std::min(s.dx, s.dy));
        const double distance = std::exp(nearest + aim[1] * (furthest - nearest));
        double qx = px + distance * std::cos(angle), qy = py + distance * std::sin(angle);
        if (how[1] < 0.5) {
            qx = std::round(qx / s.dx) * s.dx;
            qy = std::round(qy / s.dy) * s.dy;
        }
        const bool outside = qx < 0 || qx > width || qy < 0 || qy > depth;
        const double run = std::hypot(qx - px, qy - py);
        if (run == 0 || (s.boundary == Boundary::Finite && outside)) continue;

        const double slope = (height_in_frame(s, qx, qy) - height_in_frame(s, px, py)) / run;
        const int sector =
            Horizon::sector_of(static_cast<float>(qx - px), static_cast<float>(qy - py));
        const float bound = Horizon::slope_of(horizon.byte(i, j, sector));
        above += slope > static_cast<double>(bound) ? 1 : 0;
    }
    return above;
}

struct Named {
    std::string name;
    Heightfield surface;
};

std::vector<Named> surfaces() {
    std::vector<Named> all;
    const auto add = [&](const char* name, Heightfield s, double dx, double dy) {
        s.dx = dx;
        s.dy = dy;
        all.push_back({name, std::move(s)});
    };
    add("smooth", shape("gaussian", 200, 0.15), 1, 1);
    add("rough", shape("gaussian", 128, 1), 1, 1);
    add("in metres", noise(90, 70, 2e-6, 1), 1e-6, 1.5e-6);
    add("white noise", noise(150, 131, 2, 2), 1, 1);
    add("gentle noise", noise(97, 64, 0.3, 3), 1, 0.7);
    add("long cells", noise(80, 65, 3, 4), 1, 30);
    add("wide cells", noise(66, 90, 3, 5), 30, 1);
    add("tiny", noise(3, 5, 1, 6), 1.25, 0.75);
    add("smallest", noise(2, 2, 1, 7), 1, 1);
    add("narrow", noise(7, 300, 0.5, 8), 1, 1);
    add("sawtooth", shape("sawtooth", 64), 1, 1);
    add("pyramids", shape("pyramids", 64), 1, 1);
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
        all.push_back(all[k]);
        all.back().name += ", finite";
        all.back().surface.boundary = Boundary::Finite;
        all.push_back(all[k]);
        all.back().name += ", main diagonal";
        all.back().surface.diagonal = Diagonal::Main;
    }
    return all;
}

TEST(Horizon, NothingIsSeenAboveIt) {
    for (const Named& s : surfaces()) EXPECT_EQ(count_above_horizon(s.surface, 60000), 0) << s.name;
}

TEST(Horizon, FlatSurfaceNeedsNoClimbing) {
    const PaddedHeights padded(noise(100, 40, 0, 1), 1);
    const Horizon horizon(padded, 1);
    for (int j = 0; j < padded.cells_y(); ++j)
        for (int i = 0; i < padded.cells_x(); ++i)
            for (int s = 0; s < Horizon::kSectors; ++s) EXPECT_EQ(horizon.byte(i, j, s), 0);
}

// A groove along y, slopes 1 and -1, valleys at x = 0, 16, ..., ridges at 8, 24, ...
// Cell 12 holds 12 <= x <= 13 on the way down. Towards +x, the lowest of its points sees the next
// ridge best: from (13, height 3) to (24, height 8), a slope of 5 / 11, times cos of the azimuth.
// Towards -x it looks uphill: a slope of 1, times cos of the azimuth.
TEST(Horizon, GrooveByHand) {
    const PaddedHeights padded(shape("vgroove", 64), 1);
    const Horizon horizon(padded, 1);
    for (int k = 0; k < Horizon::kSectors; ++k) {
        // At the azimuth of the sector that comes closest to +x or -x
        const double across = std::max(std::fabs(std::cos(k * kSectorWidth)),
                                       std::fabs(std::cos((k + 1) * kSectorWidth)));
        const bool forward = std::cos((k + 0.5) * kSectorWidth) > 0;
        const double expected = across * (forward ? 5.0 / 11 : 1);
        const float bound =
            Horizon::slope_of(horizon.byte(12, 20, sector_to((k + 0.5) * kSectorWidth)));
        EXPECT_GE(bound, expected) << k;
        // Looking along the groove, what lies just outside the sector is counted too
        if (across > 0.9) {
            EXPECT_LE(bound, expected + (forward ? 0.1 : 0.05)) << k;
        }
    }
}

// A wall of height 30 above flat ground, in the last row of a surface with an end: y = 200. No row
// of tiles begins there that would know it, too. From the far edge of the cells (i, j), y = j + 1,
// it rises by 30 / (199 - j) towards +y, which is where two sectors meet. Seen from 88 cells and
// more it is in tiles of 32 cells, which begin at y = 192, seen from blocks of 32 cells.
TEST(Horizon, AWallInTheLastRowIsSeenFromAfar) {
    Heightfield s = noise(201, 201, 0, 1);
    s.boundary = Boundary::Finite;
    std::fill(s.heights.end() - s.nx, s.heights.end(), 30.0f);
    EXPECT_EQ(count_above_horizon(s, 60000), 0);
    const PaddedHeights padded(s, 2);
    const Horizon horizon(padded, 2);
    for (const int j : {1, 31, 63, 95, 150}) {
        const int edge = 31 - j % 32;  // how far the far edge of the block is from the cell's
        const double seen = 30.0 / (199 - j), most = 30.0 / (199 - j - edge - 8);
        for (const double turn : {-0.01, 0.01}) {
            const int ahead = sector_to(0.5 * std::numbers::pi + turn);
            const int behind = sector_to(-0.5 * std::numbers::pi + turn);
            EXPECT_GE(Horizon::slope_of(horizon.byte(100, j, ahead)), seen) << j;
            EXPECT_LE(Horizon::slope_of(horizon.byte(100, j, ahead)), 1.15 * most) << j;
            EXPECT_LT(Horizon::slope_of(horizon.byte(100, j, behind)), seen / 2) << j;
        }
    }
}

/// The steepest slope seen from a few points of a cell in a few directions of each sector.
std::array<double, Horizon::kSectors> look_around(const Heightfield& s, int i, int j) {
    std::array<double, Horizon::kSectors> steepest{};
    constexpr double kInside = 1e-7;
    for (int k = 0; k < 9; ++k) {
        const double px = i + std::clamp(0.5 * (k % 3), kInside, 1 - kInside);
        const double py = j + std::clamp(0.5 * (k / 3), kInside, 1 - kInside);
        const double height = height_in_frame(s, px, py);
        for (int ray = 0; ray < 5 * Horizon::kSectors; ++ray) {
            const double angle = kSectorWidth * (ray / 5 + 0.02 + 0.24 * (ray % 5));
            double& most = steepest[static_cast<std::size_t>(sector_to(angle))];
            const double x = std::cos(angle), y = std::sin(angle);
            for (double t = 0.05; t < 120; t += t < 20 ? 0.25 : 0.5)
                most = std::max(most, (height_in_frame(s, px + t * x, py + t * y) - height) / t);
        }
    }
    return steepest;
}

// On a Gaussian surface the horizon lies at most 0.25 RMS slopes above what can be seen, and on
// white noise a third of it.
TEST(Horizon, IsTight) {
    const auto mean_excess = [](const Heightfield& s, double& seen) {
        const PaddedHeights padded(s, 2);
        const Horizon horizon(padded, 2);
        double excess = 0;
        constexpr int kCells = 40;
        for (int n = 0; n < kCells; ++n) {
            const int i = n * 37 % s.nx, j = n * 91 % s.ny;
            const auto steepest = look_around(s, i, j);
            for (int k = 0; k < Horizon::kSectors; ++k) {
                const double most = steepest[static_cast<std::size_t>(k)];
                excess += static_cast<double>(Horizon::slope_of(horizon.byte(i, j, k))) - most;
                seen += most / (kCells * Horizon::kSectors);
            }
        }
        return excess / (kCells * Horizon::kSectors);
    };
    double seen = 0;
    EXPECT_LT(mean_excess(shape("gaussian", 128, 0.1 * std::numbers::sqrt2), seen), 0.027);
    EXPECT_LT(mean_excess(shape("gaussian", 128, 0.3 * std::numbers::sqrt2), seen), 0.08);
    seen = 0;
    const double excess = mean_excess(noise(128, 128, 0.5, 1), seen);
    EXPECT_LT(excess, seen / 3);
}

std::vector<std::uint8_t> all_bytes(const Horizon& horizon) {
    return {horizon.bytes(), horizon.bytes() + horizon.memory_bytes()};
}

TEST(Horizon, SameBytesForAnyNumberOfThreads) {
    const PaddedHeights padded(noise(300, 170, 1, 1), 1);
    EXPECT_EQ(all_bytes(Horizon(padded, 1)), all_bytes(Horizon(padded, 3)));
}

TEST(Horizon, SameBytesOnAnyInstructionSet) {
    const PaddedHeights padded(shape("gaussian", 140), 1);
    const auto expected = all_bytes(Horizon(padded, 1));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        EXPECT_EQ(all_bytes(Horizon(padded, 1)), expected) << hwy::TargetName(target);
        hwy::SetSupportedTargetsForTest(0);
    }
    hwy::GetChosenTarget().DeInit();
}

// Above 1024 x 1024 cells, an entry speaks for 2 x 2 cells: no less than any cell's own would. The
// surface repeats, so its cells' own entries are those of one of its tiles.
TEST(Horizon, SharedEntriesSpeakForAllTheirCells) {
    constexpr int kTile = 128, kTimes = 9;
    const Heightfield tile = noise(kTile, kTile, 1, 1);
    Heightfield many = tile;
    many.nx = many.ny = kTile * kTimes;
    many.heights.clear();
    for (int j = 0; j < many.ny; ++j)
        for (int i = 0; i < many.nx; ++i)
            many.heights.push_back(
                tile.heights[static_cast<std::size_t>(j % kTile * kTile + i % kTile)]);
    const PaddedHeights one_padded(tile, 2), many_padded(many, 2);
    const Horizon one(one_padded, 2), all(many_padded, 2);
    ASSERT_EQ(one.pool_shift(), 0);
    ASSERT_EQ(all.pool_shift(), 1);
    for (int j = 0; j < many.ny; j += 2) {
        for (int i = 0; i < many.nx; i += 2) {
            for (int s = 0; s < Horizon::kSectors; ++s) {
                std::uint8_t most = 0;
                for (int k = 0; k < 4; ++k)
                    most = std::max(most, one.byte((i + k % 2) % kTile, (j + k / 2) % kTile, s));
                ASSERT_EQ(all.byte(i, j, s), most);
            }
        }
    }
}

TEST(Horizon, SectorsAndBytesMeanWhatTheHeaderSays) {
    EXPECT_EQ(Horizon::slope_of(0), 0);
    EXPECT_FLOAT_EQ(Horizon::slope_of(254), Horizon::kSteepest);
    EXPECT_TRUE(std::isinf(Horizon::slope_of(255)));
    // Counter-clockwise from +x; bits: 1 x < 0, 2 y < 0, 4 steep, 8 away from both axes
    const std::array<int, Horizon::kSectors> order{0, 8,  12, 4, 5, 13, 9,  1,
                                                   3, 11, 15, 7, 6, 14, 10, 2};
    for (int k = 0; k < Horizon::kSectors; ++k)
        EXPECT_EQ(sector_to((k + 0.5) * kSectorWidth), order[static_cast<std::size_t>(k)]);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
// Made surfaces of known truth, spoilt as measurements are, and made ready again.
#include <asperity/surface/topography.h>

#include <asperity/core/error.h>
#include <asperity/surface/fill_missing.h>
#include <asperity/surface/gaussian_filter.h>
#include <asperity/surface/polynomial_form.h>
#include <asperity/surface/resample.h>
#include <asperity/surface/statistics.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace asperity {
namespace {

using Height = std::function<double(double x, double y)>;

constexpr double kStep = 0.5e-6;
constexpr double kTurn = 2 * std::numbers::pi;

// x and y in metres from the middle.
Topography made(int nx, int ny, const Height& height) {
    Topography t;
    t.nx = nx, t.ny = ny;
    t.dx = t.dy = kStep;
    t.unit = "m";
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            t.heights.push_back(height((i - 0.5 * (nx - 1)) * kStep, (j - 0.5 * (ny - 1)) * kStep));
    return t;
}

// Waves that are even about the middle: no plane is hidden in them.
double waves(double x, double y) {
    return 1e-7 * (std::cos(kTurn * 4 * x / (64 * kStep)) + std::cos(kTurn * 3 * y / (48 * kStep)));
}

Topography waves_and(const Height& more) {
    return made(64, 48, [&](double x, double y) { return waves(x, y) + more(x, y); });
}

Heightfield ready(const Topography& t, const Preparation& how = {}, int threads = 1) {
    return prepare(t, how, "made", asperity::Run(threads));
}

std::size_t at(const Topography& t, int i, int j) {
    return static_cast<std::size_t>(j * t.nx + i);
}

void expect_same(const Heightfield& a, const Topography& truth, double tolerance) {
    ASSERT_EQ(a.heights.size(), truth.heights.size());
    for (std::size_t k = 0; k < a.heights.size(); ++k)
        ASSERT_NEAR(static_cast<double>(a.heights[k]), truth.heights[k], tolerance) << k;
}

void expect_refused(ErrorCode code, const std::string& why, const std::function<void()>& act) {
    try {
        act();
        FAIL() << "not refused: " << why;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
}

// A plane of 20 mrad is taken off: the heights and Sq of the level surface come back.
TEST(Level, TakesOffATiltOf20Milliradians) {
    const Topography truth = waves_and([](double, double) { return 0.0; });
    const double slope = std::tan(0.020) / std::numbers::sqrt2;
    const Topography tilted = waves_and([&](double x, double y) { return slope * (x - y) + 3e-5; });
    const Heightfield level = ready(tilted);
    expect_same(level, truth, 1e-13);
    EXPECT_NEAR(statistics(level, 1).rms_height, 1e-7, 1e-12);  // two waves of amplitude a
    EXPECT_NE(level.prepared.find("the mean plane taken off, a tilt of 20 mrad (the default"),
              std::string::npos)
        << level.prepared;

    Preparation none;
    none.level = Level::None;
    EXPECT_GT(statistics(ready(tilted, none), 1).rms_height, 1.5e-7);
    EXPECT_EQ(ready(tilted, none).prepared.find("not levelled"), 0u);
}

TEST(Level, IsForMeasurementsUnlessAsked) {
    Topography t = waves_and([](double x, double) { return 0.02 * x; });
    t.ours = true;
    EXPECT_EQ(ready(t).prepared, "");
    expect_same(ready(t), t, 1e-13);
    t.ours = false;
    t.unit = "cell";
    expect_same(ready(t), t, 1e-13);
    EXPECT_NE(ready(t).prepared.find("not levelled, as the file has no unit of length: a tilt of "
                                     "20 mrad stays"),
              std::string::npos);
}

TEST(Level, TakesOffFormsOfTheirOrderAndNoLess) {
    const Topography truth = waves_and([](double, double) { return 0.0; });
    const Height bowl = [](double x, double y) {
        return 4e3 * x * x + 2.5e3 * y * y - 3e3 * x * y;
    };
    const Height third = [&](double x, double y) {
        return bowl(x, y) + 2e9 * x * x * y - 1e9 * y * y * y;
    };
    for (const auto& [level, form] : {std::pair{Level::Order2, bowl}, {Level::Order3, third}}) {
        // Of the waves alone the fit takes a little, which is none of the form
        Preparation how;
        how.level = level;
        const Heightfield left = ready(waves_and(form), how);
        const Heightfield of_waves = ready(truth, how);
        for (std::size_t k = 0; k < left.heights.size(); ++k)
            ASSERT_NEAR(left.heights[k], of_waves.heights[k], 1e-13f);
        how.level = level == Level::Order2 ? Level::Plane : Level::Order2;
        EXPECT_GT(statistics(ready(waves_and(form), how), 1).rms_height, 1.2e-7);
    }
    const PolynomialForm form(made(9, 7, third), 3, asperity::Run(1));
    EXPECT_NEAR(form.slope().x, 0, 1e-9);
    const PolynomialForm slanted(
        made(9, 7, [](double x, double y) { return x - 2 * y + 5e11 * (x * x * x + y * x * x); }),
        3, asperity::Run(1));
    EXPECT_NEAR(slanted.slope().x, 1, 1e-9);
    EXPECT_NEAR(slanted.slope().y, -2, 1e-9);
}

// A film is exact where the surface is a plane, at the edge too, or a saddle.
TEST(Fill, SmoothBringsBackPlanesAndSaddles) {
    const Height plane = [](double x, double y) { return 0.3 * x - 0.1 * y + 1e-6; };
    Topography t = made(40, 30, plane);
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 7; ++i) t.mark_missing(at(t, i, j)), t.heights[at(t, i, j)] = 7;
    fill_smooth(t, asperity::Run(1));
    const Topography truth = made(40, 30, plane);
    for (std::size_t k = 0; k < t.heights.size(); ++k)
        ASSERT_NEAR(t.heights[k], truth.heights[k], 1e-15);

    const Height saddle = [](double x, double y) { return 5e3 * (x * x - y * y) + 3e3 * x * y; };
    Topography s = made(40, 30, saddle);
    const Topography whole = made(40, 30, saddle);
    for (int j = 8; j < 20; ++j)
        for (int i = 10; i < 31; ++i) s.mark_missing(at(s, i, j)), s.heights[at(s, i, j)] = 7;
    fill_smooth(s, asperity::Run(1));
    for (std::size_t k = 0; k < s.heights.size(); ++k)
        ASSERT_NEAR(s.heights[k], whole.heights[k], 1e-9 * 5e3 * 1e-10);
}

TEST(Fill, NearestTakesTheNearestMeasuredHeight) {
    Topography t = made(12, 9, [](double x, double y) { return 100 * x + y; });
    const Topography truth = t;
    t.dy = 3 * kStep;
    for (int k = 0; k < 70; ++k)
        t.mark_missing(static_cast<std::size_t>((k * k * 5 + 3 * k) % 108));
    fill_nearest(t);
    for (int j = 0; j < t.ny; ++j)
        for (int i = 0; i < t.nx; ++i) {
            double best = 1e300;
            for (int b = 0; b < t.ny; ++b)
                for (int a = 0; a < t.nx; ++a)
                    if (t.missing[at(t, a, b)] == 0)
                        best = std::min(best, std::hypot(a - i, 3 * (b - j)));
            // Among those at the same least distance
            bool found = false;
            for (int b = 0; b < t.ny; ++b)
                for (int a = 0; a < t.nx; ++a)
                    found |= t.missing[at(t, a, b)] == 0 &&
                             std::hypot(a - i, 3 * (b - j)) < best + 1e-9 &&
                             truth.heights[at(t, a, b)] == t.heights[at(t, i, j)];
            EXPECT_TRUE(found) << i << ' ' << j;
        }
}

TEST(Fill, RefusesManyMissingPointsUnlessAsked) {
    Topography t = waves_and([](double, double) { return 0.0; });
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 12; ++i) t.mark_missing(at(t, i + 20, j + 20));
    expect_refused(ErrorCode::InvalidInput,
                   "made: 192 of 3072 points are missing (6.25 %), more than the 5 % that are "
                   "filled unasked: --fill smooth or nearest",
                   [&] { ready(t); });
    Preparation how;
    how.fill = Fill::Smooth;
    EXPECT_NE(ready(t, how).prepared.find("192 points (6.25 %) filled smoothly"),
              std::string::npos);
    how.fill = Fill::None;
    t.missing.assign(t.missing.size(), 0);
    t.mark_missing(5);
    expect_refused(ErrorCode::InvalidInput, "1 of 3072 points are missing (0.0326 %): --fill",
                   [&] { ready(t, how); });
    t.missing.assign(t.missing.size(), 1);
    expect_refused(ErrorCode::InvalidInput, "no point was measured", [&] { ready(t); });
}

TEST(Outliers, AreFoundAndFilled) {
    const Topography truth = waves_and([](double x, double) { return 0.02 * x; });
    Topography t = truth;
    const std::vector<std::size_t> spikes = {at(t, 5, 5), at(t, 6, 5), at(t, 40, 0), at(t, 63, 47)};
    for (const std::size_t k : spikes) t.heights[k] += 3e-6;
    Preparation how;
    how.outliers = 30;
    how.level = Level::None;
    const Heightfield clean = ready(t, how);
    EXPECT_EQ(clean.prepared.find("4 points further than 30 deviations"), 0u) << clean.prepared;
    expect_same(clean, truth, 6e-8);
    Topography marked = t;
    mark_outliers(marked, 30, asperity::Run(1));
    for (const std::size_t k : spikes) EXPECT_EQ(marked.missing[k], 1);
    how.fill = Fill::None;
    expect_refused(ErrorCode::InvalidInput, "outliers are to be filled", [&] { ready(t, how); });
    // On a mirror more than half of the differences are zero
    Topography flat = made(64, 64, [](double, double) { return 0.0; });
    flat.heights[at(flat, 9, 9)] = 1e-9;
    EXPECT_EQ(mark_outliers(flat, 5, asperity::Run(1)), 1u);
}

// Height that is left of a wave along x that goes round `waves` times on 512 samples.
double transmitted(int waves, double cutoff_in_samples, Boundary boundary) {
    const int n = 512;
    std::vector<double> heights;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < n; ++i) heights.push_back(std::cos(kTurn * waves * (i - 256) / n));
    gaussian_low_pass(heights, n, 4, 2.0, 2.0, 2 * cutoff_in_samples, boundary, asperity::Run(1));
    return heights[512 + 256];
}

TEST(GaussianFilter, PassesHalfOfAWaveAtTheCutOff) {
    for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
        EXPECT_NEAR(transmitted(16, 32, boundary), 0.5, 2e-6);
        EXPECT_NEAR(transmitted(8, 32, boundary), std::exp2(-0.25), 2e-6);
        EXPECT_NEAR(transmitted(32, 32, boundary), std::exp2(-4), 2e-6);
        EXPECT_NEAR(transmitted(64, 8, boundary), 0.5, 2e-6);
    }
}

TEST(GaussianFilter, KeepsWhatIsLevelAndTheMeanOfWhatRepeats) {
    std::vector<double> level(37 * 23, 5e3);
    gaussian_low_pass(level, 37, 23, 1, 2, 11, Boundary::Finite, asperity::Run(1));
    for (const double h : level) ASSERT_NEAR(h, 5e3, 1e-8);
    std::vector<double> spike(30 * 20);
    spike[0] = 1;
    gaussian_low_pass(spike, 30, 20, 1, 1, 25, Boundary::Periodic, asperity::Run(1));
    double sum = 0;
    for (const double h : spike) sum += h;
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(spike[1], spike[29], 1e-15);
    EXPECT_NEAR(spike[30], spike[19 * 30], 1e-15);
}

TEST(GaussianFilter, SAndLAddUpToTheSurface) {
    const Topography t = waves_and([](double, double) { return 0.0; });
    Preparation s, l;
    s.level = l.level = Level::None;
    s.filter_s = l.filter_l = Length{4, "um"};
    const Heightfield low = ready(t, s), high = ready(t, l);
    for (std::size_t k = 0; k < low.heights.size(); ++k)
        ASSERT_NEAR(static_cast<double>(low.heights[k]) + static_cast<double>(high.heights[k]),
                    t.heights[k], 1e-13);
    EXPECT_NE(low.prepared.find("S-filter, Gaussian, cut-off 4 um"), std::string::npos);
    EXPECT_NE(high.prepared.find("L-filter, Gaussian, cut-off 4 um"), std::string::npos);
    s.filter_s = Length{4, ""};
    expect_refused(ErrorCode::Usage, "filter-s: a cut-off of 4 m is longer than the surface (32 um",
                   [&] { ready(t, s); });
    s.filter_s = Length{0.9, "um"};
    expect_refused(ErrorCode::Usage, "shorter than two samples (1 um)", [&] { ready(t, s); });
    s.filter_s = Length{4, "um"}, s.filter_l = Length{3, "um"};
    expect_refused(ErrorCode::Usage, "filter-l: a cut-off of 3 um leaves nothing",
                   [&] { ready(t, s); });
    Topography cells = t;
    cells.unit = "cell", cells.dx = cells.dy = 1;
    expect_refused(ErrorCode::Usage, "write a number alone", [&] { ready(cells, l); });
}

TEST(Crop, TakesWholeSamples) {
    const Topography t = made(20, 10, [](double x, double y) { return x + 10 * y; });
    Preparation how;
    how.level = Level::None;
    how.crop = Crop{{1, "um"}, {0.5, "um"}, {4, "um"}, {2, "um"}};
    const Heightfield part = ready(t, how);
    EXPECT_EQ(part.nx, 8);
    EXPECT_EQ(part.ny, 4);
    EXPECT_EQ(part.heights[0], static_cast<float>(t.heights[at(t, 2, 1)]));
    EXPECT_EQ(part.heights.back(), static_cast<float>(t.heights[at(t, 9, 4)]));
    how.crop->width = {10, "um"};
    expect_refused(ErrorCode::Usage, "crop: a part of 10 um x 2 um at 1 um, 0.5 um does not lie",
                   [&] { ready(t, how); });
    how.crop->width = {0.5, "um"};
    expect_refused(ErrorCode::Usage, "less than 2 x 2 samples", [&] { ready(t, how); });
}

TEST(Resample, KeepsPlanesAndMeans) {
    const Height plane = [](double x, double y) { return 0.2 * x - 0.7 * y; };
    for (const auto& [nx, ny] : {std::pair{6, 5}, {18, 15}, {7, 11}, {30, 4}}) {
        Topography t = made(18, 15, plane);
        resample(t, nx, ny);
        EXPECT_DOUBLE_EQ(t.dx * nx, 18 * kStep);
        EXPECT_DOUBLE_EQ(t.dy * ny, 15 * kStep);
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                ASSERT_NEAR(t.heights[at(t, i, j)],
                            plane((i + 0.5 - 0.5 * nx) * t.dx, (j + 0.5 - 0.5 * ny) * t.dy), 1e-18);
    }
    Topography t = waves_and([](double x, double) { return x; });
    t.boundary = Boundary::Periodic;
    double sum = 0;
    for (const double h : t.heights) sum += h;
    resample(t, 24, 17);
    double less = 0;
    for (const double h : t.heights) less += h;
    EXPECT_NEAR(less / (24 * 17), sum / (64 * 48), 1e-18);
    Preparation how;
    how.resample = 32;
    EXPECT_EQ(ready(waves_and([](double, double) { return 0.0; }), how).ny, 24);
}

TEST(Prepare, GivesTheSameBitsForAnyNumberOfThreads) {
    Topography t = waves_and([](double x, double y) { return 0.02 * x + 50 * y * y; });
    for (int k = 0; k < 60; ++k) t.mark_missing(static_cast<std::size_t>(k * 51));
    t.heights[777] = 1e-5;
    Preparation how;
    how.outliers = 20;
    how.level = Level::Order2;
    how.filter_s = Length{2, "um"}, how.filter_l = Length{12, "um"};
    how.resample = 50;
    EXPECT_EQ(ready(t, how, 1).heights, ready(t, how, 4).heights);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/make_surface.h>

#include <asperity/core/error.h>
#include <asperity/surface/gaussian.h>
#include <asperity/surface/ggx.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_testing.h>
#include <asperity/surface/thesis_noise.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include <sys/resource.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

std::vector<std::string> made_kinds() {
    std::vector<std::string> names;
    for (const SurfaceKind& kind : surface_kinds()) names.push_back(kind.name);
    return names;
}
const std::vector<std::string> kMadeKinds = made_kinds();

void expect_refused(const SurfaceSettings& settings, const std::string& where) {
    try {
        make(settings);
        ADD_FAILURE() << "accepted a bad " << where;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Usage) << e.what();
        EXPECT_EQ(e.where(), where) << e.what();
        EXPECT_FALSE(e.message().empty());
        EXPECT_EQ(e.message().find('\n'), std::string::npos);
        EXPECT_NE(e.message().back(), '.');
    }
}

TEST(MakeSurface, EveryKindMakesASoundSurface) {
    for (const std::string& kind : kMadeKinds)
        for (const int size : {64, 80}) {
            const Heightfield s = make(settings_of(kind, size));
            EXPECT_EQ(s.nx, size);
            EXPECT_EQ(s.ny, size);
            EXPECT_EQ(s.dx, 1);
            EXPECT_EQ(s.dy, 1);
            EXPECT_EQ(s.unit, "cell");
            EXPECT_FALSE(s.name.empty());
            EXPECT_EQ(s.diagonal, Diagonal::Anti);
            EXPECT_EQ(s.boundary, Boundary::Periodic);
            EXPECT_NO_THROW(validate(s, s.name));
        }
}

TEST(MakeSurface, SmallestSize) {
    for (const std::string kind : {"thesis", "gaussian", "ggx", "flat", "tilted"}) {
        SurfaceSettings s = settings_of(kind, 2);
        s.correlation_x = s.correlation_y = 1;
        EXPECT_NO_THROW(validate(make(s), "size 2"));
    }
}

TEST(MakeSurface, DeclaresIsotropyOnlyWhereItHolds) {
    for (const std::string& kind : kMadeKinds) {
        const bool isotropic = kind == "flat" || kind == "gaussian" || kind == "ggx";
        EXPECT_EQ(make(settings_of(kind, 64)).isotropic, isotropic);
    }
    SurfaceSettings s = settings_of("gaussian", 64);
    s.alpha_y = 0.25;
    EXPECT_FALSE(make(s).isotropic);
}

TEST(MakeSurface, RefusesValuesOutOfRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    using Change = std::function<void(SurfaceSettings&, double)>;
    struct Case {
        const char* where;
        std::vector<double> values;
        Change change;
    };
    const std::vector<Case> cases = {
        {"size", {-5, 0, 1, 32769, 1e9}, [](auto& s, double v) { s.size = static_cast<int>(v); }},
        {"roughness", {-0.1, 1.01, nan, inf}, [](auto& s, double v) { s.roughness = v; }},
        {"alpha", {0, -0.3, 101, nan, inf}, [](auto& s, double v) { s.alpha_x = v; }},
        {"alpha", {0, -0.3, 101, nan, inf}, [](auto& s, double v) { s.alpha_y = v; }},
        {"correlation-length", {0, -1, 1e9, nan}, [](auto& s, double v) { s.correlation_x = v; }},
        {"correlation-length", {0, -1, inf, nan}, [](auto& s, double v) { s.correlation_y = v; }},
        {"hurst", {0, -0.5, 1.1, nan}, [](auto& s, double v) { s.hurst = v; }},
        {"max-slope", {0, -1, nan, inf}, [](auto& s, double v) { s.max_slope = v; }},
        {"tilt", {-1, 90, 120, nan}, [](auto& s, double v) { s.tilt_deg = v; }},
        {"period", {-4, 0, 1, 1e6}, [](auto& s, double v) { s.period = static_cast<int>(v); }},
        {"amplitude", {-1, 1e7, nan, inf}, [](auto& s, double v) { s.amplitude = v; }},
        {"cell-size", {0, -1, nan, inf}, [](auto& s, double v) { s.cell_x = v; }},
        {"cell-size", {0, -1, nan, inf}, [](auto& s, double v) { s.cell_y = v; }},
        {"height-scale", {0, nan, inf, -inf, 1e10}, [](auto& s, double v) { s.height_scale = v; }},
    };
    for (const Case& c : cases)
        for (const double value : c.values)
            for (const std::string kind : {"gaussian", "flat"}) {
                SurfaceSettings s = settings_of(kind, 64);
                c.change(s, value);
                SCOPED_TRACE(value);
                expect_refused(s, c.where);
            }
}

TEST(MakeSurface, RefusesSettingsThatContradictEachOther) {
    SurfaceSettings s = settings_of("vgroove", 60);
    s.period = 16;
    expect_refused(s, "period");
    for (const std::string kind : {"vgroove", "pyramids"}) {
        s = settings_of(kind, 60);
        s.period = 15;
        expect_refused(s, "period");
    }
    s = settings_of("sinusoid", 60);
    s.period = 3;
    expect_refused(s, "period");
    s = settings_of("gaussian", 64);
    s.correlation_x = s.correlation_y = 65;
    expect_refused(s, "correlation-length");
    s = settings_of("ggx", 64);
    s.correlation_y = 5;
    expect_refused(s, "correlation-length");
    s = settings_of("ggx", 64);
    s.max_slope = 0.3;
    expect_refused(s, "max-slope");
    s = settings_of("gaussian", 64);
    s.alpha_x = 0.9;
    s.alpha_y = 0.001;
    expect_refused(s, "alpha");
    s = settings_of("flat", 64);
    s.cell_x = 1;
    s.cell_y = 101;
    expect_refused(s, "cell-size");
    s = settings_of("tilted", 1024);
    s.tilt_deg = 89.9999999999;
    s.cell_x = 1e15;
    s.height_scale = 1e9;
    expect_refused(s, "height-scale");
    s = settings_of(kSurfaceFile, 64);
    expect_refused(s, "surface");
}

TEST(MakeSurface, IgnoresWhatItsKindDoesNotUse) {
    SurfaceSettings s = settings_of("thesis", 121);
    s.period = 16;                             // does not divide 121
    s.correlation_x = s.correlation_y = 1000;  // longer than the tile
    EXPECT_NO_THROW(make(s));
}

// A cell of 0.5 units halves the heights and keeps the slopes; a height scale multiplies both.
TEST(MakeSurface, CellSizeKeepsSlopesAndHeightScaleDoesNot) {
    for (const std::string kind : {"thesis", "gaussian", "ggx", "vgroove", "eggcrate"}) {
        SurfaceSettings settings = settings_of(kind, 64);
        const auto plain = statistics(make(settings), 2);
        settings.cell_x = 0.5;  // counts for y too
        const Heightfield small = make(settings);
        EXPECT_EQ(small.dx, 0.5);
        EXPECT_EQ(small.dy, 0.5);
        const auto cells = statistics(small, 2);
        EXPECT_NEAR(cells.rms_gradient, plain.rms_gradient, 1e-6 * plain.rms_gradient);
        EXPECT_NEAR(cells.rms_height, 0.5 * plain.rms_height, 1e-6 * plain.rms_height);
        settings.height_scale = -3;
        const auto scaled = statistics(make(settings), 2);
        EXPECT_NEAR(scaled.rms_gradient, 3 * plain.rms_gradient, 1e-6 * 3 * plain.rms_gradient);
        EXPECT_NEAR(scaled.max_height, -1.5 * plain.min_height, 1e-5 * plain.rms_height);
    }
}

TEST(MakeSurface, AFinitePatchHasTheSameHeights) {
    for (const std::string kind : {"thesis", "ggx", "pyramids"}) {
        SurfaceSettings settings = settings_of(kind, 64);
        const Heightfield whole = make(settings);
        settings.boundary = Boundary::Finite;
        const Heightfield patch = make(settings);
        EXPECT_EQ(patch.boundary, Boundary::Finite);
        EXPECT_EQ(patch.cell_count(), 63U * 63U);
        EXPECT_EQ(patch.heights, whole.heights);
    }
}

TEST(MakeSurface, ReportsProgressToTheEnd) {
    for (const std::string& kind : kMadeKinds) {
        asperity::Run run(2);
        std::string stage;
        run.on_progress([&](const Progress& p) { stage = p.stage; });
        make_surface(settings_of(kind, 128), run);
        const Progress p = run.progress();
        EXPECT_EQ(stage, "surface");
        EXPECT_EQ(p.done, p.total);
        EXPECT_GT(p.total, 0U);
    }
}

/// Steps a maker takes on a 96 x 96 surface, counted under a total it cannot reach.
std::uint64_t steps_of(const std::function<void(Heightfield&, Run&)>& maker) {
    Heightfield surface = testing::flat_grid(96, 96);
    Run run(2);
    run.begin("counting", std::uint64_t{1} << 40);
    maker(surface, run);
    return run.progress().done;
}

/// Steps make_surface announces when it begins.
std::uint64_t announced_steps(const std::string& kind) {
    Run run(2);
    std::uint64_t total = 0;
    run.on_progress([&](const Progress& p) { total = p.total; });
    make_surface(settings_of(kind, 96), run);
    return total;
}

TEST(MakeSurface, AnnouncesTheStepsItTakes) {
    PowerSpectrumSettings spectrum;
    spectrum.nx = spectrum.ny = 96;
    const auto thesis =
        steps_of([](Heightfield& s, asperity::Run& run) { fill_thesis_noise(s, 0.2, 1, run); });
    const auto shape = steps_of([](Heightfield& s, asperity::Run& run) {
        find_surface_kind("vgroove")->fill(s, settings_of("vgroove", 96), run);
    });
    const auto gaussian = steps_of(
        [&](Heightfield& s, asperity::Run& run) { fill_gaussian(s, spectrum, 0.3, 1, run); });
    const auto round =
        steps_of([](Heightfield& s, asperity::Run& run) { impose_slope_law(s, {}, 1, run); });
    EXPECT_EQ(announced_steps("thesis"), thesis);
    EXPECT_EQ(announced_steps("vgroove"), shape);
    EXPECT_EQ(announced_steps("gaussian"), gaussian);
    EXPECT_EQ(announced_steps("ggx"), gaussian + kGgxRounds * round);
}

TEST(MakeSurface, StopsWhenAsked) {
    for (const std::string& kind : kMadeKinds) {
        asperity::Run run(2);
        run.request_stop();
        try {
            make_surface(settings_of(kind, 256), run);
            ADD_FAILURE() << "did not stop";
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::Stopped);
        }
    }
}

// Sanitizers take terabytes of address space for themselves.
#ifdef __has_feature  // Clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ASPERITY_CLANG_SANITIZES
#endif
#endif
#if !defined(ASPERITY_CLANG_SANITIZES) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
TEST(MakeSurface, SaysWhenMemoryIsShort) {
    // Address space for this process ends 2 GiB from nothing: 32768^2 heights need 4
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    rlimit small = before;
    small.rlim_cur = rlim_t{2} << 30;
    ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
    try {
        make(settings_of("thesis", kMaxSurfaceSide));
        ADD_FAILURE() << "found the memory";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
        EXPECT_EQ(e.where(), "size");
    }
    ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
}
#endif

}  // namespace
}  // namespace asperity

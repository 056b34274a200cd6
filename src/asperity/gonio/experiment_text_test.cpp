// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/experiment_text.h>

#include <asperity/core/energy.h>
#include <asperity/surface/surface_kinds.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <tuple>

namespace asperity {
namespace {

std::optional<Error> error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

void expect_error(ErrorCode code, const std::string& part, const std::function<void()>& action) {
    const auto error = error_of(action);
    ASSERT_TRUE(error) << "no error: " << part;
    EXPECT_EQ(error->code(), code);
    EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
}

// Every field, so that a setting that is forgotten shows.
auto fields(const SurfaceSettings& s) {
    return std::tie(s.kind, s.size, s.roughness, s.alpha_x, s.alpha_y, s.autocorrelation,
                    s.correlation_x, s.correlation_y, s.hurst, s.max_slope, s.seed, s.tilt_deg,
                    s.period, s.amplitude, s.along_y, s.file, s.tiling, s.cell_x, s.cell_y,
                    s.height_scale, s.diagonal, s.boundary, s.own);
}

void expect_equal(const Experiment& a, const Experiment& b) {
    EXPECT_TRUE(fields(a.surface) == fields(b.surface));
    const auto optics = [](const OpticsSettings& o) {
        return std::tie(o.fresnel, o.f0, o.ior, o.k, o.material, o.wavelengths);
    };
    EXPECT_TRUE(optics(a.optics) == optics(b.optics));
    const auto light = [](const IlluminationSettings& i) {
        return std::tie(i.layers, i.theta_deg, i.phi_deg, i.isotropic);
    };
    EXPECT_TRUE(light(a.illumination) == light(b.illumination));
    const auto detector = [](const DetectorSettings& d) {
        return std::tie(d.kind, d.resolution, d.orders);
    };
    EXPECT_TRUE(detector(a.detector) == detector(b.detector));
    const auto run = [](const RunSettings& r) {
        return std::tie(r.jitter, r.rays, r.until, r.until_cells, r.max_rays, r.bounces, r.launch,
                        r.batches, r.seed);
    };
    EXPECT_TRUE(run(a.run) == run(b.run));
}

// An experiment in which every setting has a random value of its range, awkward digits included.
class RandomExperiment {
  public:
    explicit RandomExperiment(unsigned seed) : engine_(seed) {}

    Experiment make() {
        Experiment e;
        e.surface = surface();
        e.optics.fresnel = static_cast<FresnelKind>(integer(0, 3));
        e.optics.f0 = list(0, 1);
        e.optics.ior = list(1e-3, 5);
        e.optics.k = list(0, 9);
        e.optics.material = integer(0, 1) == 0 ? "" : "Au";
        e.optics.wavelengths = list(400, 700);
        e.illumination = {integer(1, 9000), list(0, 89.99), list(-360, 360), integer(0, 1) == 0};
        e.detector = {static_cast<DetectorKind>(integer(0, 1)), integer(2, 8192), integer(1, 256)};
        e.run.jitter = number(1e-9, 1e9);
        e.run.rays = engine_() % kMaxRaysPerLayer;
        e.run.until = number(1e-6, 0.999);
        e.run.until_cells = number(0, 0.999);
        e.run.max_rays = engine_() % kMaxRaysPerLayer;
        e.run.bounces = integer(1, 10000);
        e.run.launch = static_cast<LaunchPattern>(integer(0, 2));
        e.run.batches = integer(2, 4096);
        e.run.seed = engine_();
        return e;
    }

  private:
    SurfaceSettings surface() {
        SurfaceSettings s;
        std::vector<std::string> kinds = {kSurfaceFile};
        for (const SurfaceKind& kind : surface_kinds()) kinds.push_back(kind.name);
        s.kind = kinds[static_cast<std::size_t>(integer(0, static_cast<int>(kinds.size()) - 1))];
        if (s.kind == "ridges") s.own["land"] = std::int64_t{integer(0, 100)};
        s.size = integer(2, kMaxSurfaceSide);
        s.roughness = number(0, 1);
        s.alpha_x = number(1e-4, 3), s.alpha_y = number(1e-4, 100);
        s.autocorrelation = static_cast<Autocorrelation>(integer(0, 2));
        s.correlation_x = number(0.1, 100), s.correlation_y = number(0.1, 32768);
        s.hurst = number(0.001, 1);
        s.max_slope = number(0.1, 50);
        s.seed = engine_();
        s.tilt_deg = number(0, 89.999);
        s.period = integer(2, 100);
        s.amplitude = number(0, 9);
        s.along_y = integer(0, 1) == 0;
        const std::string names[] = {"a.gsf",          "./flat",    "flat",   "gaussian:x.gsf",
                                     "file:a",         "a b#c.gsf", " a.gsf", "\"q\"\\.gsf",
                                     "two\nlines.gsf", "x.gsf "};
        if (s.kind == kSurfaceFile) s.file = names[integer(0, 9)];
        s.tiling = static_cast<Tiling>(integer(0, 3));
        if (integer(0, 1) == 0) s.cell_x = number(1e-9, 2);
        if (integer(0, 1) == 0) s.cell_y = number(1e-9, 2);
        s.height_scale = number(-5, 5);
        s.diagonal = static_cast<Diagonal>(integer(0, 1));
        s.boundary = static_cast<Boundary>(integer(0, 1));
        return s;
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    std::vector<double> list(double low, double high) {
        std::vector<double> numbers(static_cast<std::size_t>(integer(0, 3)));
        for (double& x : numbers) x = number(low, high);
        return numbers;
    }

    std::mt19937_64 engine_;
};

TEST(ExperimentText, RoundTripsEveryField) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Experiment experiment = RandomExperiment(seed).make();
        const std::string text = to_text(experiment);
        expect_equal(experiment_from_text(text, "text"), experiment);
        EXPECT_EQ(to_text(experiment_from_text(text, "text")), text);
        // Over another experiment, too: every field is written.
        Experiment other = RandomExperiment(seed + 1000).make();
        other.surface.own.clear();
        for (const Setting& s : settings_of(experiment)) apply_setting(other, s.key, s.value);
        expect_equal(other, experiment);
        if (HasFailure()) FAIL() << text;
    }
    expect_equal(experiment_from_text("", "text"), Experiment{});
    expect_equal(experiment_from_text(to_text(Experiment{}), "text"), Experiment{});
}

TEST(ExperimentText, DefaultsPassTheirOwnRules) {
    const Experiment defaults = experiment_from_text(to_text(Experiment{}), "text");
    EXPECT_NO_THROW(validate(defaults));
}

TEST(ExperimentText, SettingsFile) {
    const auto settings = parse_settings(
        "\xef\xbb\xbf# a comment\r\n\n  surface = gaussian # rough\r\nfile-name=\" a # \\\"b\\\" "
        "\" #\n"
        "theta=0, 30,60",
        "e.txt");
    ASSERT_EQ(settings.size(), 3u);
    EXPECT_EQ(settings[0].key, "surface");
    EXPECT_EQ(settings[0].value, "gaussian");
    EXPECT_EQ(settings[0].line, 3);
    EXPECT_EQ(settings[1].value, " a # \"b\" ");
    EXPECT_EQ(settings[2].value, "0, 30,60");
    EXPECT_EQ(settings[2].line, 5);
    const auto bad = [](const std::string& text, const std::string& part) {
        expect_error(ErrorCode::InvalidInput, part, [&] { experiment_from_text(text, "e.txt"); });
    };
    bad("\nsurface", "e.txt:2: 'surface' is no 'key = value'");
    bad("= 2", "e.txt:1: '' is no name of a setting");
    bad("Size = 2", "e.txt:1: 'Size' is no name of a setting");
    bad("size = \"2", "e.txt:1: a closing double quote is missing");
    bad("size = \"2\" 3", "e.txt:1: '3' follows the closing quote");
    bad("size = \"\\x\"", "e.txt:1: only");
    bad("size = \"\\", "e.txt:1: only");
    bad("size = 8\nsize = 9", "e.txt:2: 'size' is set twice");
    bad("size = 8\nsise = 9", "e.txt:2: sise: there is no such setting");
    bad("alpha = 0.3x", "e.txt:1: alpha: '0.3x' is not a number");
    bad(std::string("alpha = 0.3\0", 12), "e.txt:1: alpha: '0.3?' is not a number");
}

TEST(ExperimentText, SectionsBelongToOthers) {
    const std::string text =
        "size = 8\n\n[studio]  # a comment\nsize = large\nbeam = \"a # b\"\n[ other-2 ]\nsize=1";
    const auto settings = parse_settings(text, "e.txt");
    ASSERT_EQ(settings.size(), 4u);
    EXPECT_EQ(settings[0].section, "");
    EXPECT_EQ(settings[1].section, "studio");
    EXPECT_EQ(settings[1].line, 4);
    EXPECT_EQ(settings[2].section, "studio");
    EXPECT_EQ(settings[3].section, "other-2");
    EXPECT_EQ(experiment_from_text(text, "e.txt").surface.size, 8);
    for (const char* line : {"[", "[]", "[a", "[A b]", "[run] seed = 1", "[[run]]"})
        expect_error(ErrorCode::InvalidInput, "e.txt:2: '",
                     [&] { parse_settings(std::string("size = 8\n") + line + "\n", "e.txt"); });
}

TEST(ExperimentText, OldValuesThatDoNotCountAreRead) {
    const Experiment e = experiment_from_text("surface = a.gsf\nalpha = 1e-09\n", "e.txt");
    EXPECT_EQ(e.surface.alpha_x, 1e-9);
    expect_error(ErrorCode::InvalidInput, "e.txt:1: alpha: '1e-09' must be in 0.0001 .. 100",
                 [] { experiment_from_text("alpha = 1e-09\nsurface = ggx\n", "e.txt"); });
}

TEST(ExperimentText, SettingsOfOneKindStandWhereItIsUsed) {
    EXPECT_EQ(to_text(Experiment{}).find("land"), std::string::npos);
    Experiment e;
    apply_setting(e, "surface", "ridges:land=6");
    EXPECT_NE(to_text(e).find("land = 6\n"), std::string::npos);
    e.surface.kind = "flat";
    EXPECT_EQ(to_text(e).find("land"), std::string::npos);
}

TEST(ExperimentText, ReadsListsPairsAndShares) {
    Experiment e;
    apply_setting(e, "alpha", "0.25");
    EXPECT_EQ(e.surface.alpha_y, 0.25);
    apply_setting(e, "alpha", "0.5, 0.125");
    EXPECT_EQ(e.surface.alpha_x, 0.5);
    EXPECT_EQ(e.surface.alpha_y, 0.125);
    apply_setting(e, "theta", "0,30,60.5");
    EXPECT_EQ(e.illumination.theta_deg, (std::vector<double>{0, 30, 60.5}));
    apply_setting(e, "theta", "none");
    EXPECT_TRUE(e.illumination.theta_deg.empty());
    apply_setting(e, "until", "1%");
    EXPECT_EQ(e.run.until, 0.01);
    apply_setting(e, "until", "0.02");
    EXPECT_EQ(e.run.until, 0.02);
    apply_setting(e, "until", "1%,5%");
    EXPECT_EQ(e.run.until_cells, 0.05);
    apply_setting(e, "until", "1%");
    EXPECT_EQ(e.run.until_cells, 0);
    apply_setting(e, "rays", "1e6");
    EXPECT_EQ(e.run.rays, 1000000u);
    apply_setting(e, "seed", "18446744073709551615");
    EXPECT_EQ(e.run.seed, std::numeric_limits<std::uint64_t>::max());
    apply_setting(e, "cell-size", "1e-6");
    EXPECT_EQ(e.surface.cell_y, 1e-6);
    apply_setting(e, "cell-size", "auto,2");
    EXPECT_FALSE(e.surface.cell_x);
    EXPECT_EQ(e.surface.cell_y, 2.0);
    apply_setting(e, "isotropic", "on");
    EXPECT_TRUE(e.illumination.isotropic);
}

TEST(ExperimentText, RefusesSillyValuesNamingKeyAndValue) {
    // Values no numeric setting may take, and some that only certain ones refuse.
    const char* const kNumeric[] = {"size",    "roughness",  "alpha",        "correlation-length",
                                    "hurst",   "max-slope",  "surface-seed", "tilt",
                                    "period",  "amplitude",  "cell-size",    "height-scale",
                                    "theta",   "phi",        "layers",       "f0",
                                    "ior",     "k",          "wavelengths",  "bounces",
                                    "jitter",  "rays",       "until",        "max-rays",
                                    "batches", "resolution", "orders",       "seed"};
    const char* const kSilly[] = {"nan",  "inf",  "-inf", "1e999", "1x",   "0x10",
                                  "1,,2", "1;2",  "one",  "1 2",   "--1",  "+-1",
                                  ",",    "1,2,", "%",    "1e",    "\xff", "auto,"};
    for (const std::string key : kNumeric)
        for (const std::string value : kSilly) {
            Experiment e;
            const auto error = error_of([&] { apply_setting(e, key, value); });
            ASSERT_TRUE(error) << key << " = " << value;
            EXPECT_EQ(error->code(), ErrorCode::Usage);
            EXPECT_EQ(error->where(), key);
        }
    const auto bad = [](const std::string& key, const std::string& value, const std::string& part) {
        Experiment e;
        expect_error(ErrorCode::Usage, key + ": '" + value + "' " + part,
                     [&] { apply_setting(e, key, value); });
    };
    bad("size", "1", "must be in 2 .. 32768");
    bad("size", "32769", "must be in 2 .. 32768");
    bad("size", "99999999999999999999", "is not a whole number");
    bad("size", "8.5", "is not a whole number");
    bad("roughness", "1.001", "must be in 0 .. 1");
    bad("alpha", "0", "must be in 0.0001 .. 100");
    bad("alpha", "-1", "must be in 0.0001 .. 100");
    bad("tilt", "90", "must be at least 0 and below 90");
    bad("theta", "90", "must be at least 0 and below 90");
    bad("until", "1", "must be above 0 and below 1");
    bad("until", "-0.01", "must be above 0 and below 1");
    bad("rays", "4294967296", "must be in 2 .. " + std::to_string(kMaxRaysPerLayer));
    bad("rays", "-1", "is not a whole number");
    bad("rays", "1.5", "is not a whole number");
    bad("bounces", "0", "must be in 1 .. 10000");
    bad("batches", "1", "must be in 2 .. 4096");
    bad("fresnel", "gold", "is none of none, schlick, dielectric, conductor");
    bad("along-y", "maybe", "is neither true nor false");
    bad("surface", "bumpy", "is neither a file nor one of thesis, gaussian");
    bad("surface", "", "is neither a file nor");
    expect_error(ErrorCode::Usage, "nothing: there is no such setting", [] {
        Experiment e;
        apply_setting(e, "nothing", "1");
    });
}

}  // namespace
}  // namespace asperity

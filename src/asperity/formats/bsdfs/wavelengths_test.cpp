// SPDX-License-Identifier: Apache-2.0
// Channels that are wavelengths, of models and files as of measurements.
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/test_files.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace asperity::io {
namespace {

using Names = std::vector<std::string>;

ExportSource source_of(const std::string& spec) {
    Experiment cells;
    cells.detector.resolution = 16;
    cells.illumination.theta_deg = {10, 50};
    return {std::shared_ptr<const Bsdf>(parse_brdf_spec(spec)), cells, 2};
}

double value(const Bsdf& bsdf, Vec3 wi, Vec3 wo, std::size_t channel) {
    std::vector<double> f(static_cast<std::size_t>(bsdf.channels()));
    bsdf.eval(wi, wo, f);
    return f[channel];
}

TEST(Wavelengths, NamesOfChannels) {
    const auto names = [](const char* spec) { return parse_brdf_spec(spec)->channel_names(); };
    EXPECT_EQ(names("ggx:alpha=0.3"), Names{"all"});
    EXPECT_EQ(names("lambert:albedo=0.1/0.2/0.3"), (Names{"R", "G", "B"}));
    EXPECT_EQ(names("ggx:alpha=0.3,material=Au"), (Names{"R", "G", "B"}));
    EXPECT_EQ(names("ggx:alpha=0.3,material=Au,wavelengths=500/600"), (Names{"500nm", "600nm"}));
    EXPECT_EQ(names("ggx:alpha=0.3,material=Au,wavelengths=500/600,lambert=0.1"),
              (Names{"500nm", "600nm"}));
    EXPECT_EQ(names("ggx:alpha=0.3,f0=0.1/0.2/0.3/0.4"), (Names{"c1", "c2", "c3", "c4"}));
    EXPECT_EQ(source_of("ggx:alpha=0.3,material=Au,wavelengths=500/600").wavelengths_nm(),
              (std::vector<double>{500, 600}));
}

/// In whatever order the model has them: each channel is found again under its wavelength.
TEST(Wavelengths, AreKeptByTheFormatsThatHaveThem) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    for (const char* wavelengths : {"450/500/600/700", "700/450/600.5/500"}) {
        const ExportSource source =
            source_of(std::string("ggx:alpha=0.4,material=Cu,wavelengths=") + wavelengths);
        for (const auto& [name, options] : {std::pair{"rgl", "colour=spectral,n=32"},
                                            {"csv", "step=5"},
                                            {"astm", "step=5"},
                                            {"speos-brdf", "step=5"},
                                            {"openmaterial", "step=5"}}) {
            const BsdfFormat& format = *formats.find(name);
            const std::string path = folder / ("f." + format.endings.front());
            format.write(source, FormatOptions(format.options, options), path);
            const Fidelity fidelity = fidelity_of(source, format, path);
            EXPECT_LT(fidelity.mean_l1, 0.06) << name << " " << wavelengths;
            Names there = format.read(path)->channel_names(), ours = source.channel_names();
            std::sort(there.begin(), there.end());
            std::sort(ours.begin(), ours.end());
            EXPECT_EQ(there, ours) << name;
        }
    }
}

/// Three wavelengths in a file of red, green and blue: the longest is red.
TEST(Wavelengths, TheLongestIsRed) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const ExportSource source = source_of("ggx:alpha=0.5,material=Cu,wavelengths=450/550/650");
    EXPECT_EQ(source.rgb_channels(), (std::array{2, 1, 0}));
    const Vec3 wi = from_spherical(0.4, 0), wo = from_spherical(0.5, kPi);
    for (const auto& [name, options] :
         {std::pair{"rgl", "n=32"}, {"merl", ""}, {"zemax", "step=4"}, {"lighttools", "step=4"}}) {
        const BsdfFormat& format = *formats.find(name);
        const std::string path = folder / ("f." + format.endings.front());
        format.write(source, FormatOptions(format.options, options), path);
        const auto file = format.read(path);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(value(*file, wi, wo, c) / value(source.bsdf(), wi, wo, 2 - c), 1, 0.03)
                << name << c;
        EXPECT_LT(fidelity_of(source, format, path).mean_l1, 0.05) << name;
    }
    const ExportSource grey = source_of("ggx:alpha=0.5");
    EXPECT_EQ(source.luminance_weights(), (std::vector{0.0722, 0.7152, 0.2126}));
    EXPECT_EQ(grey.luminance_weights(), std::vector{1.0});
}

/// What was read from such a file goes on into another one.
TEST(Wavelengths, PassFromFileToFile) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat &csv = *formats.find("csv"), &rgl = *formats.find("rgl");
    csv.write(source_of("ggx:alpha=0.4,material=Cu,wavelengths=500/600"),
              FormatOptions(csv.options, "step=5"), folder / "a.csv");
    Experiment cells;
    cells.detector.resolution = 16;
    cells.illumination.theta_deg = {10, 50};
    const ExportSource second(std::shared_ptr<const Bsdf>(formats.read(folder / "a.csv")), cells,
                              2);
    EXPECT_EQ(second.channel_names(), (Names{"500nm", "600nm"}));
    rgl.write(second, FormatOptions(rgl.options, "colour=spectral"), folder / "b.bsdf");
    EXPECT_LT(fidelity_of(second, rgl, folder / "b.bsdf").mean_l1, 0.03);
}

}  // namespace
}  // namespace asperity::io

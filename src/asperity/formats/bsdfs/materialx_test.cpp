// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/snippets.h>
#include <asperity/formats/test_files.h>

namespace asperity::io {
namespace {

std::string written(const std::string& spec) {
    const test::TemporaryFolder folder;
    const ExportSource source(parse_brdf_spec(spec), Experiment{}, 1);
    BsdfFormats().find("materialx")->write(source, FormatOptions({}, ""), folder / "a.mtlx");
    return test::get(folder / "a.mtlx");
}

void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(MaterialX, RoughnessIsTheRootOfAlpha) {
    const std::string text = written("ggx:alpha=0.25,f0=0.9/0.6/0.3");
    expect_in(text, R"(name="specular_roughness" type="float" value="0.5")");
    expect_in(text, R"(name="specular_roughness_anisotropy" type="float" value="0")");
    expect_in(text, R"(name="base_color" type="color3" value="0.9, 0.6, 0.3")");
    expect_in(text, R"(name="specular_color" type="color3" value="1, 1, 1")");  // Schlick's own
    expect_in(text, "alpha = 0.25");
    expect_in(text, "sqrt(alpha) = 0.5:");
}

TEST(MaterialX, AnisotropyGivesBothWidthsBack) {
    // a = 1/2: sqrt(2 / (1 + 1/4)) = 1.26491; r^2 = 0.4 / 1.26491.
    const std::string text = written("ggx:alpha=0.4,alpha_y=0.2,masking=separable,material=Au");
    expect_in(text, R"(name="specular_roughness_anisotropy" type="float" value="0.5")");
    expect_in(text, R"(name="specular_roughness" type="float" value="0.562341")");
    expect_in(text, "0.2 along y");
    // Gold along the normal, from n + i k at 650, 550 and 450 nm: 0.97, 0.81, 0.38.
    expect_in(text, R"(name="base_color" type="color3" value="0.9)");
}

TEST(MaterialX, GlassHasAnIndex) {
    const std::string text = written("ggx:alpha=0.1,ior=1.45");
    expect_in(text, R"(name="specular_ior" type="float" value="1.45")");
    expect_in(text, R"(name="base_metalness" type="float" value="0")");
}

TEST(MaterialX, RefusesWhatItCannotHold) {
    for (const char* spec : {"beckmann:alpha=0.3", "lambert", "student-t:alpha=0.3,gamma=2"})
        EXPECT_THROW(written(spec), Error) << spec;
}

TEST(Snippets, StandBesideTheFile) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const auto names = [&](const char* format, const char* options) {
        std::string all;
        const auto& known = formats.find(format)->options;
        for (const std::string& path :
             write_snippets(format, FormatOptions(known, options), folder / "m.bsdf")) {
            all += std::filesystem::path(path).filename().string() + " ";
            const std::string text = test::get(path);
            EXPECT_EQ(text.find("{0}"), std::string::npos);
            EXPECT_NE(text.find(path.ends_with(".py") ? "m_mitsuba.xml" : "m.bsdf"),
                      std::string::npos);
        }
        return all;
    };
    EXPECT_EQ(names("rgl", ""), "m_mitsuba.xml m_mitsuba.py ");
    EXPECT_EQ(names("rgl", "colour=spectral"), "m_mitsuba.xml m_mitsuba.py m_pbrt.pbrt ");
    EXPECT_EQ(names("klems", ""), "m_radiance.rad ");
    EXPECT_THROW(names("merl", ""), Error);
}

}  // namespace
}  // namespace asperity::io

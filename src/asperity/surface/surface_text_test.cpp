// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/surface_text.h>

#include <asperity/core/error.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace asperity {
namespace {

SurfaceSettings read(const std::string& spec) {
    SurfaceSettings s;
    apply_surface_spec(s, spec);
    return s;
}

TEST(SurfaceText, KindsWithSettings) {
    EXPECT_EQ(read("gaussian").kind, "gaussian");
    const SurfaceSettings s = read("ggx:alpha=0.3/0.1,size=256, surface-seed=7");
    EXPECT_EQ(s.kind, "ggx");
    EXPECT_EQ(s.alpha_x, 0.3);
    EXPECT_EQ(s.alpha_y, 0.1);
    EXPECT_EQ(s.size, 256);
    EXPECT_EQ(s.seed, 7u);
    // In any order: hurst counts because of what follows
    EXPECT_EQ(read("gaussian:hurst=0.5,autocorrelation=self-affine").hurst, 0.5);
    EXPECT_EQ(std::get<std::int64_t>(read("ridges:land=6").own.at("land")), 6);
}

TEST(SurfaceText, Files) {
    for (const char* name : {"some/surface.gsf", "a.png"}) {
        EXPECT_EQ(read(name).kind, kSurfaceFile);
        EXPECT_EQ(read(name).file, name);
    }
    EXPECT_EQ(read("file:flat").file, "flat");
    SurfaceSettings s = read("file:flat");
    apply_surface_spec(s, "flat");
    EXPECT_EQ(s.kind, "flat");
    EXPECT_EQ(s.file, "");

    const auto folder = std::filesystem::temp_directory_path() / "asperity_surface_text_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "plain") << "x";
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(folder);
    EXPECT_EQ(read("plain").file, "plain");
    std::filesystem::current_path(here);
    std::filesystem::remove_all(folder);
}

TEST(SurfaceText, NamesReadBack) {
    for (const char* name : {"a.gsf", "./flat", "flat", "gaussian:x.gsf", "file:a", " a.gsf",
                             "x.gsf ", "\"q\"\\.gsf", "two\nlines.gsf"}) {
        SurfaceSettings s;
        s.kind = kSurfaceFile;
        s.file = name;
        EXPECT_EQ(read(surface_text(s)).kind, kSurfaceFile) << name;
        EXPECT_EQ(read(surface_text(s)).file, name);
    }
    EXPECT_EQ(surface_text(read("ggx:alpha=1")), "ggx");
}

TEST(SurfaceText, RefusesAndKeepsWhatThereWas) {
    const auto bad = [&](const std::string& spec, const std::string& sentence) {
        SurfaceSettings s = read("ggx:alpha=0.25");
        try {
            apply_surface_spec(s, spec);
            ADD_FAILURE() << spec;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            EXPECT_EQ(std::string(error.what()).substr(0, sentence.size()), sentence);
        }
        EXPECT_EQ(s.kind, "ggx");
        EXPECT_EQ(s.alpha_x, 0.25);
        EXPECT_EQ(s.size, 512);
    };
    bad("gaussian:alpha", "surface: 'alpha' is no 'setting=value'");
    bad("gaussian:", "surface: '' is no 'setting=value'");
    bad("gaussian:size=9,theta=30", "surface: 'theta' is no setting of a surface");
    bad("gaussian:alhpa=1", "surface: 'alhpa' is no setting of a surface; did you mean alpha?");
    bad("gaussian:surface=flat", "surface: 'surface' is no setting of a surface");
    bad("gaussian:size=8,alpha=x", "alpha: 'x' is not a number");
    bad("gaussian:size=8,alpha=1000", "alpha: '1000' must be in 0.0001 .. 100");
    bad("gaussian:size=8,roughness=0.3", "roughness: gaussian does not use it; it is for thesis");
    bad("flat:land=2", "land: flat does not use it; it is for ridges");
    bad("bumpy:alpha=1", "surface: 'bumpy:alpha=1' is neither a file nor one of thesis, gaussian");
    bad("gausian", "surface: 'gausian' is neither a file nor one of");
    bad("", "surface: '' is neither a file nor one of");
    bad("file:", "surface: the file name is empty");
}

}  // namespace
}  // namespace asperity

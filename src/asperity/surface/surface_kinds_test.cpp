// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/surface_kinds.h>

#include <asperity/surface/surface_params.h>
#include <asperity/surface/surface_testing.h>
#include <asperity/surface/surface_text.h>

#include <gtest/gtest.h>

#include <set>

namespace asperity {
namespace {

using testing::make;

SurfaceKind steps_of_own() {
    SurfaceKind kind;
    kind.name = "terraces";
    kind.label = "Terraces";
    kind.doc = "level steps";
    kind.params = {"period"};
    kind.own = {own_field<double>({.name = "rise", .range = {0, 10}}, 0.5)};
    kind.fill = [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
        for (int j = 0; j < surface.ny; ++j) {
            for (int i = 0; i < surface.nx; ++i)
                surface.heights[static_cast<std::size_t>(j * surface.nx + i)] =
                    static_cast<float>(own(s, "rise", 0.5) * (i % s.period));
            run.advance(1);
        }
    };
    return kind;
}

TEST(SurfaceKinds, RowsAreComplete) {
    const auto params = surface_params();
    std::set<std::string> names;
    for (const SurfaceKind& kind : surface_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_FALSE(kind.label.empty()) << kind.name;
        EXPECT_FALSE(kind.doc.empty()) << kind.name;
        EXPECT_TRUE(kind.fill) << kind.name;
        for (const std::string& name : kind.params)
            EXPECT_NE(find(params, name), nullptr) << kind.name << ": " << name;
    }
    std::set<std::string> settings;
    for (const auto& param : params) {
        EXPECT_TRUE(settings.insert(param.info.name).second) << param.info.name;
        EXPECT_FALSE(param.info.doc.empty()) << param.info.name;
    }
}

TEST(SurfaceKinds, KnowWhatTheyUse) {
    EXPECT_TRUE(surface_uses("gaussian", "alpha"));
    EXPECT_FALSE(surface_uses("gaussian", "roughness"));
    EXPECT_TRUE(surface_uses("flat", "size"));
    EXPECT_FALSE(surface_uses(kSurfaceFile, "size"));
    EXPECT_TRUE(surface_uses(kSurfaceFile, "tiling"));
    EXPECT_TRUE(surface_uses("ridges", "land"));
    EXPECT_FALSE(surface_uses("vgroove", "land"));
    const auto unused = [](const std::string& spec, const char* setting) {
        SurfaceSettings s;
        apply_surface_spec(s, spec);
        return find(surface_params(), setting)->unused(s);
    };
    EXPECT_EQ(unused("gaussian", "roughness"), "gaussian does not use it; it is for thesis");
    EXPECT_EQ(unused("a.gsf", "alpha"),
              "a surface read from a file does not use it; it is for gaussian, ggx");
    EXPECT_EQ(unused("gaussian", "hurst"),
              "the autocorrelation gaussian does not use it; it is for self-affine");
    EXPECT_EQ(unused("gaussian:autocorrelation=self-affine", "hurst"), "");
}

// What a kind says it does not use must not change it, and what it says it uses must count.
TEST(SurfaceKinds, UseWhatTheySay) {
    const std::pair<const char*, const char*> changes[] = {
        {"roughness", "0.7"}, {"alpha", "0.8"},    {"correlation-length", "5"},
        {"hurst", "0.3"},     {"max-slope", "2"},  {"surface-seed", "7"},
        {"tilt", "20"},       {"period", "32"},    {"amplitude", "3"},
        {"along-y", "true"},  {"land", "4"},       {"autocorrelation", "exponential"},
        {"size", "96"},       {"tiling", "mirror"}};
    const auto params = surface_params();
    for (const SurfaceKind& kind : surface_kinds()) {
        SurfaceSettings s = testing::settings_of(kind.name, 64);
        s.autocorrelation = Autocorrelation::SelfAffine;
        const Heightfield before = make(s);
        for (const auto& [name, value] : changes) {
            SurfaceSettings changed = s;
            find(params, name)->apply(changed, value);
            EXPECT_EQ(make(changed).heights != before.heights, surface_uses(kind.name, name))
                << kind.name << ", " << name;
        }
    }
}

TEST(SurfaceKinds, AProgramAddsItsOwn) {
    add_surface_kind(steps_of_own());
    SurfaceSettings s;
    apply_surface_spec(s, "terraces:period=4,rise=2,size=8");
    const Heightfield made = make(s);
    EXPECT_EQ(made.at(3, 0), 6);
    EXPECT_EQ(made.name, "terraces, period 4, rise 2");
    EXPECT_FALSE(made.isotropic);
    EXPECT_EQ(find(surface_params(), "rise")->text(s), "2");
    EXPECT_THROW(find(surface_params(), "rise")->apply(s, "11"), Error);
    s.own["rise"] = 11.0;
    EXPECT_THROW(make(s), Error);

    const auto refused = [](const SurfaceKind& kind) {
        EXPECT_THROW(add_surface_kind(kind), Error) << kind.name;
    };
    refused(steps_of_own());
    SurfaceKind kind = steps_of_own();
    kind.name = kSurfaceFile;
    refused(kind);
    kind.name = "other";  // "rise" is taken
    refused(kind);
    kind.own.clear();
    kind.params = {"no-such-setting"};
    refused(kind);
    kind.params.clear();
    kind.fill = nullptr;
    refused(kind);
    SurfaceSettings unknown;
    unknown.kind = "other";
    EXPECT_THROW(make(unknown), Error);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/optics_params.h>
#include <asperity/optics/scattering_law.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

namespace asperity {
namespace {

/// Settings that the law of this kind takes.
OpticsSettings settings_for(FresnelKind kind) {
    OpticsSettings s;
    s.fresnel = kind;
    if (kind == FresnelKind::Schlick) s.f0 = {0.04, 0.5};
    if (kind == FresnelKind::Dielectric) s.ior = {1, 1.5, 0.7};
    if (kind == FresnelKind::Conductor) s.ior = {0.2, 1.5, 1}, s.k = {3, 0, 0};
    return s;
}

TEST(ScatteringLawTest, EveryKindHasOneRow) {
    std::set<std::string> names;
    for (const FresnelKind kind : {FresnelKind::None, FresnelKind::Schlick, FresnelKind::Dielectric,
                                   FresnelKind::Conductor}) {
        const ScatteringLaw& law = scattering_law(kind);
        EXPECT_EQ(law.kind, kind);
        EXPECT_TRUE(names.insert(law.name).second) << law.name;
    }
    EXPECT_EQ(names.size(), scattering_laws().size());
    try {
        scattering_law(static_cast<FresnelKind>(99));
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_EQ(e.where(), "fresnel");
        EXPECT_EQ(e.message(), "is not one of none, schlick, dielectric, conductor");
    }
}

TEST(ScatteringLawTest, LanesAreTheLawInSinglePrecision) {
    std::array<float, 257> cosines{}, lanes{};
    for (std::size_t i = 0; i < cosines.size(); ++i) cosines[i] = static_cast<float>(i) / 256;
    for (const ScatteringLaw& law : scattering_laws()) {
        for (const FacetChannel& channel : law.channels(settings_for(law.kind))) {
            law.reflectances(cosines, channel, lanes.data());
            for (std::size_t i = 0; i < cosines.size(); ++i) {
                const double exact = law.reflectance(static_cast<double>(cosines[i]), channel);
                EXPECT_NEAR(static_cast<double>(lanes[i]), exact, 2e-6)
                    << law.name << " " << cosines[i];
                EXPECT_GE(exact, 0);
                EXPECT_LE(exact, 1);
            }
            EXPECT_NEAR(law.reflectance(1, channel), channel.f0, 1e-12) << law.name;
        }
    }
}

/// A law of a program: grey at every angle.
ScatteringLaw grey_law(const char* name) {
    return {FresnelKind::None,
            name,
            "Grey",
            "f0 at every angle",
            [](const OpticsSettings& s) {
                std::vector<FacetChannel> channels;
                for (const double f0 : s.f0) channels.push_back({f0, 1, 0});
                if (channels.empty()) throw Error(ErrorCode::Usage, "grey needs it", "f0");
                return channels;
            },
            [](double, const FacetChannel& c) { return c.f0; },
            nullptr};
}

TEST(ScatteringLawTest, AProgramAddsItsOwn) {
    OpticsSettings s;
    const auto apply_law = [&](const char* name) {
        find(optics_params(), "fresnel")->apply(s, name);
    };
    EXPECT_THROW(apply_law("grey"), Error);
    const FresnelKind grey = add_scattering_law(grey_law("grey"));
    apply_law("grey");
    EXPECT_EQ(s.fresnel, grey);
    EXPECT_EQ(find(optics_params(), "fresnel")->text(s), "grey");
    EXPECT_THROW(Fresnel{s}, Error);
    s.f0 = {0.25, 0.5};
    const Fresnel fresnel(s);
    ASSERT_EQ(fresnel.channels(), 2);
    EXPECT_FALSE(fresnel.perfect());
    std::array<double, 2> f{};
    fresnel.eval(0.125, f);
    EXPECT_EQ(f[1], 0.5);
    // In single precision, without a function of its own for many angles.
    const std::array<float, 3> cosines = {0, 0.5F, 1};
    std::array<float, 3> first{}, second{};
    const std::array<float*, 2> both = {first.data(), second.data()};
    fresnel.eval(cosines, both);
    EXPECT_EQ(first, (std::array{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(second[2], 0.5F);
}

TEST(ScatteringLawTest, WhatIsNoLawIsRefused) {
    const std::size_t before = scattering_laws().size();
    EXPECT_THROW(add_scattering_law(grey_law("")), Error);
    EXPECT_THROW(add_scattering_law(grey_law("schlick")), Error);
    ScatteringLaw empty = grey_law("empty");
    empty.reflectance = nullptr;
    EXPECT_THROW(add_scattering_law(empty), Error);
    EXPECT_EQ(scattering_laws().size(), before);
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
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

}  // namespace
}  // namespace asperity

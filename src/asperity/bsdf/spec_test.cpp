// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

#include <vector>

namespace asperity {
namespace {

TEST(SpecTest, KnowsAModelByItsName) {
    EXPECT_TRUE(is_brdf_spec("lambert"));
    EXPECT_TRUE(is_brdf_spec("ggx:alpha=0.3"));
    EXPECT_TRUE(is_brdf_spec("cook-torrance:nonsense"));
    EXPECT_FALSE(is_brdf_spec("ggx.asperity"));
    EXPECT_FALSE(is_brdf_spec("results/beckmann:1"));
    EXPECT_FALSE(is_brdf_spec(""));
}

TEST(SpecTest, NamesReadBackAsThemselves) {
    for (const char* spec :
         {"lambert:albedo=0.5/0.4/0.3", "ggx:alpha=0.3", "ggx:alpha=0.3,alpha_y=0.1",
          "beckmann:alpha=0.25,masking=separable,fresnel=conductor,ior=0.2/0.4/1.4,k=3.1/2.4/1.9",
          "ggx:alpha=0.5,fresnel=conductor,material=Au,wavelengths=450/550",
          "ggx:alpha=0.5,fresnel=dielectric,ior=1.5", "student-t:alpha=0.3,gamma=2.5",
          "student-t:alpha=0.3,alpha_y=0.1,gamma=4,masking=separable,fresnel=conductor,material=Au",
          "ggx:alpha=0.5,fresnel=schlick,ior=1.5",
          "cook-torrance:roughness=0.4,metallic=1,albedo=1/0.8/0.3,k=ibl,diffuse=off"}) {
        EXPECT_EQ(parse_brdf_spec(spec)->name(), spec);
    }
    EXPECT_EQ(parse_brdf_spec("cook-torrance:roughness=0.4,metallic=1,albedo=0.5")->name(),
              "cook-torrance:roughness=0.4,metallic=1,albedo=0.5/0.5/0.5,k=direct,diffuse=on");
    EXPECT_EQ(parse_brdf_spec("ggx:alpha=0.5,material=Cu")->channels(), 3);
    EXPECT_EQ(parse_brdf_spec("ggx:alpha=0.5,f0=0.04")->name(),
              "ggx:alpha=0.5,fresnel=schlick,f0=0.04");
    EXPECT_EQ(parse_brdf_spec("lambert")->name(), "lambert:albedo=1");
}

TEST(SpecTest, LambertIsTheAlbedoOverPi) {
    const auto brdf = parse_brdf_spec("lambert:albedo=0.5/0.25");
    std::vector<double> f(2), a(2);
    brdf->eval(from_spherical(1, 2), from_spherical(0.3, 4), f);
    EXPECT_DOUBLE_EQ(f[0], 0.5 / kPi);
    EXPECT_DOUBLE_EQ(f[1], 0.25 / kPi);
    brdf->albedo(from_spherical(1, 2), a);
    EXPECT_EQ(a, (std::vector<double>{0.5, 0.25}));
}

TEST(SpecTest, SaysWhatIsWrong) {
    struct Bad {
        const char* spec;
        const char* words;
    };
    const Bad bad[] = {
        {"phong:exponent=3", "there are lambert, cook-torrance, ggx, beckmann, student-t"},
        {"", "is not a model"},
        {"ggx", "alpha is missing"},
        {"ggx:", "alpha is missing"},
        {"ggx:alpha=0", "alpha: '0' must be in"},
        {"ggx:alpha=nan", "'nan' is not a number"},
        {"ggx:alpha=", "alpha: the value is empty"},
        {"ggx:alpha=0.3x", "'0.3x' is not a number"},
        {"ggx:alpha=1e999", "is not a number"},
        {"ggx:alpha=0.3,", "missing after the last"},
        {"ggx:alpha=0.3,,k=1", "is not of the form key=value"},
        {"ggx:alpha=0.3,alpha=0.4", "alpha is given twice"},
        {"ggx:alpha=0.3,roughness=1", "there are alpha, alpha_y, masking, fresnel"},
        {"ggx:alpha=0.3,masking=none", "masking: 'none' is none of correlated, separable"},
        {"ggx:alpha=0.3,material=Xx", "material: \"Xx\" is not known"},
        {"ggx:alpha=0.3,k=2", "ior: fresnel conductor needs"},
        {"ggx:alpha=0.3,alpha_y=-1", "alpha_y: '-1' must be in"},
        {"student-t:alpha=0.3,gamma=1.5", "gamma: '1.5' must be above 1.5"},
        {"ggx:alpha=0.3,gamma=2", "\"gamma\" is not a key of this model"},
        {"cook-torrance", "roughness is missing"},
        {"cook-torrance:roughness=0.4,albedo=1/1", "albedo: has 2 values"},
        {"cook-torrance:roughness=2", "roughness: '2' must be in 0.01 .. 1"},
        {"lambert:albedo=1.5", "albedo: '1.5' must be in 0 .. 1"},
        {"lambert:albedo=0.5/", "is not a number"},
    };
    for (const Bad& b : bad) {
        try {
            parse_brdf_spec(b.spec);
            ADD_FAILURE() << "accepted " << b.spec;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::Usage);
            EXPECT_EQ(e.where(), b.spec);
            EXPECT_NE(e.message().find(b.words), std::string::npos) << b.spec << ": " << e.what();
        }
    }
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/params/fields.h>

#include <gtest/gtest.h>

#include <set>

namespace asperity {
namespace {

TEST(BsdfModelsTest, EveryRowIsComplete) {
    std::set<std::string> names;
    for (const BsdfModel& model : bsdf_models()) {
        EXPECT_TRUE(names.insert(model.name).second) << model.name;
        EXPECT_FALSE(model.label.empty() || model.doc.empty()) << model.name;
        for (const BsdfParam& param : model.params) {
            EXPECT_FALSE(param.info.doc.empty()) << model.name << " " << param.info.name;
            // The default is a value of the row.
            const ParamValue value = parse(param.info, from_spec_text(param.info, param.otherwise));
            EXPECT_NO_THROW(check(param.info, value)) << model.name << " " << param.info.name;
        }
    }
}

TEST(BsdfModelsTest, DefaultsMayBeWrittenOut) {
    // A specification with every key at its default is the one that leaves them out.
    for (const BsdfModel& model : bsdf_models()) {
        std::string all = model.name + ":", few = all;
        for (const BsdfParam& param : model.params) {
            const std::string setting = param.info.name + "=" + param.otherwise;
            all += (all.back() == ':' ? "" : ",") + setting;
            if (param.required) few += (few.back() == ':' ? "" : ",") + setting;
        }
        EXPECT_EQ(parse_brdf_spec(all)->name(), parse_brdf_spec(few)->name());
        EXPECT_EQ(parse_brdf_spec(parse_brdf_spec(all)->name())->name(),
                  parse_brdf_spec(all)->name());
    }
}

TEST(BsdfModelsTest, HelpShowsEachModelAndKey) {
    const std::string help = brdf_spec_help();
    for (const BsdfModel& model : bsdf_models()) {
        EXPECT_NE(help.find("  " + model.name + ":"), std::string::npos) << help;
        for (const BsdfParam& param : model.params)
            EXPECT_NE(help.find(param.info.name + "="), std::string::npos) << help;
    }
    std::size_t begin = 0;
    for (std::size_t end; (end = help.find('\n', begin)) != std::string::npos; begin = end + 1)
        EXPECT_LE(end - begin, 90u) << help;
}

TEST(BsdfModelsTest, WidthsOfSlopes) {
    // D of GGX, Beckmann and Student's t along the normal: 1 / (pi alpha^2); that of the thesis'
    // model too, whose alpha is roughness^2.
    const auto peak = [](const std::string& name, double alpha) {
        const BsdfModel model = *find_bsdf_model(name);
        return *model.make(model.with_alpha(alpha))->normal_density({0, 0, 1});
    };
    for (const char* name : {"ggx", "beckmann", "cook-torrance"})
        EXPECT_NEAR(peak(name, 0.25) * kPi * 0.0625, 1, 1e-12) << name;
    // It ends at roughness 1.
    EXPECT_NEAR(peak("cook-torrance", 4) * kPi, 1, 1e-12);
    EXPECT_FALSE(find_bsdf_model("lambert")->with_alpha);
    EXPECT_FALSE(LambertBrdf({0.5}).normal_density({0, 0, 1}).has_value());
}

TEST(BsdfModelsTest, ManyDirectionsAtOnceMeanTheSame) {
    // 96 to a ring, more than a model takes at once, the last ring below the horizon
    std::vector<Vec3> wo;
    for (const double theta : {0.0, 0.4, 1.1, 1.56, 1.7})
        for (int k = 0; k < 96; ++k) wo.push_back(from_spherical(theta, 2 * kPi * k / 96));
    for (const char* spec :
         {"beckmann:alpha=0.3,material=Au", "ggx:alpha=0.2,alpha_y=0.5,masking=separable",
          "student-t:alpha=0.3,gamma=3,f0=0.9/0.5/0.1", "cook-torrance:roughness=0.4,metallic=0.5",
          "lambert:albedo=0.3"}) {
        const auto model = parse_brdf_spec(spec);
        const auto channels = static_cast<std::size_t>(model->channels());
        std::vector<double> many(wo.size() * channels), one(channels);
        for (const Vec3 wi : {from_spherical(0.9, 2), from_spherical(0, 0)}) {
            model->eval_many(wi, wo, many);
            for (std::size_t k = 0; k < wo.size(); ++k) {
                model->eval(wi, wo[k], one);
                for (std::size_t c = 0; c < channels; ++c)
                    ASSERT_NEAR(many[k * channels + c], one[c], 1e-12 * one[c]) << spec << k;
            }
        }
        const std::vector<Vec3> wi = {from_spherical(0.9, 2), from_spherical(0.1, 1)};
        const std::vector<Vec3> wm = {from_spherical(0.3, 1), from_spherical(0.9, 5)};
        std::vector<double> mirrored(4 * channels);
        model->eval_at_facets(wi, wm, mirrored);
        for (std::size_t k = 0; k < 4; ++k) {
            model->eval(wi[k / 2], reflect(wi[k / 2], wm[k % 2]), one);
            for (std::size_t c = 0; c < channels; ++c)
                ASSERT_NEAR(mirrored[k * channels + c], one[c], 1e-12 * one[c]) << spec << k;
        }
    }
}

struct GreySettings {
    double grey = 0.5;
};

BsdfModel grey_model(const char* name) {
    return bsdf_model<GreySettings>(
        name, "Grey", "a grey diffuse surface",
        {field(&GreySettings::grey, {.name = "grey", .range = kZeroToOne, .doc = "how grey"})},
        [](const GreySettings& s) {
            return std::make_unique<LambertBrdf>(std::vector<double>{s.grey});
        });
}

TEST(BsdfModelsTest, AProgramAddsItsOwn) {
    EXPECT_FALSE(is_brdf_spec("grey:grey=0.25"));
    add_bsdf_model(grey_model("grey"));
    EXPECT_EQ(parse_brdf_spec("grey:grey=0.25")->name(), "lambert:albedo=0.25");
    EXPECT_EQ(bsdf_models().back().label, "Grey");
    try {
        parse_brdf_spec("grey:grey=7");
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_EQ(e.message(), "grey: '7' must be in 0 .. 1");
    }
}

TEST(BsdfModelsTest, WhatIsNoRowIsRefused) {
    const std::size_t before = bsdf_models().size();
    EXPECT_THROW(add_bsdf_model(grey_model("")), Error);
    EXPECT_THROW(add_bsdf_model(grey_model("ggx")), Error);
    EXPECT_THROW(add_bsdf_model(grey_model("my:grey")), Error);
    BsdfModel empty = grey_model("empty");
    empty.make = nullptr;
    EXPECT_THROW(add_bsdf_model(empty), Error);
    EXPECT_EQ(bsdf_models().size(), before);
}

}  // namespace
}  // namespace asperity

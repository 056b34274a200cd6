// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/rgl_warp.h>
#include <asperity/formats/test_files.h>

#include <array>

namespace asperity::io {
namespace {

using namespace rgl;

/// Two slices of uneven numbers.
Images uneven() {
    Images images{5, 4, {}};
    for (int k = 0; k < 40; ++k) images.values.push_back(static_cast<float>(1 + (k * 7) % 11));
    return images;
}

TEST(RglWarp, SquareAndDirectionsBelongTogether) {
    const Point u = to_square(radians(45), radians(-90));
    EXPECT_NEAR(u.x, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(u.y, 0.25, 1e-15);
    EXPECT_NEAR(degrees(theta_of(u)), 45, 1e-12);
    EXPECT_NEAR(degrees(phi_of(u)), -90, 1e-12);
    // The Jacobian integrates to the hemisphere.
    double sum = 0;
    for (int k = 0; k < 1000; ++k) sum += solid_angle_of({(k + 0.5) / 1000, 0.3}) / 1000;
    EXPECT_NEAR(sum, 2 * kPi, 1e-5);
}

TEST(RglWarp, InvertUndoesSampleBetweenSlicesToo) {
    const Density density(uneven());
    const Blend blend{{0, 1, 0, 0}, {0.3, 0.7, 0, 0}};
    double integral = 0;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const Point s{(i + 0.5) / 40, (j + 0.5) / 40};
            const Density::Warped there = density.sample(s, blend);
            const Density::Warped back = density.invert(there.point, blend);
            EXPECT_NEAR(back.point.x, s.x, 1e-9);
            EXPECT_NEAR(back.point.y, s.y, 1e-9);
            EXPECT_NEAR(back.density, there.density, 1e-9);
            integral += 1 / there.density / 1600;  // E[1 / density] = area of the square
        }
    EXPECT_NEAR(integral, 1, 0.01);
}

/// Exports a model and reads it back.
std::unique_ptr<Bsdf> through_file(const std::string& spec, const std::string& options,
                                   Fidelity* fidelity, const Experiment& experiment) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat& rgl = *formats.find("rgl");
    const ExportSource source(parse_brdf_spec(spec), experiment, 2);
    rgl.write(source, FormatOptions(rgl.options, options), folder / "a.bsdf");
    if (fidelity) *fidelity = fidelity_of(source, rgl, folder / "a.bsdf");
    EXPECT_EQ(folder.files(), 1);
    return formats.read(folder / "a.bsdf");
}

Experiment few_layers() {
    Experiment experiment;
    experiment.illumination.theta_deg = {0, 30, 60, 80};
    experiment.detector.resolution = 128;
    return experiment;
}

TEST(Rgl, HoldsModelsWithinAPercent) {
    for (const char* spec : {"beckmann:alpha=0.1", "beckmann:alpha=0.3", "ggx:alpha=0.6",
                             "lambert:albedo=0.5", "ggx:alpha=0.3,f0=0.9/0.5/0.1"}) {
        Fidelity fidelity;
        const auto file = through_file(spec, "n=64", &fidelity, few_layers());
        EXPECT_LT(fidelity.mean_l1, 0.01) << spec;
        EXPECT_LT(std::abs(fidelity.max_albedo_difference), 0.005) << spec;
        EXPECT_EQ(file->channels(), 3);
        EXPECT_TRUE(file->isotropic());
    }
}

TEST(Rgl, HoldsBrushedMetal) {
    Experiment experiment = few_layers();
    experiment.illumination.theta_deg = {20, 60};
    experiment.illumination.phi_deg = {0, 45, 90};
    experiment.detector.resolution = 64;
    Fidelity fidelity;
    const auto file = through_file("ggx:alpha=0.2,alpha_y=0.5", "n=32", &fidelity, experiment);
    EXPECT_FALSE(file->isotropic());
    EXPECT_LT(fidelity.mean_l1, 0.03);
}

TEST(Rgl, SamplesAsItsDensitySays) {
    const auto file = through_file("ggx:alpha=0.4", "n=32", nullptr, few_layers());
    for (const double theta : {10.0, 50.0, 75.0}) {
        const Vec3 wi = from_spherical(radians(theta), 1.0);
        double sum = 0, none = 0;
        constexpr int kSide = 300;
        std::array<double, 3> f{}, albedo{};
        double estimate = 0;
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j) {
                // The density over the hemisphere, equal in projected solid angle...
                const double s = (i + 0.5) / kSide, phi = 2 * kPi * (j + 0.5) / kSide;
                const Vec3 wo = from_spherical(std::asin(std::sqrt(s)), phi);
                file->eval(wi, wo, f);
                albedo[0] += f[0] * kPi / (kSide * kSide);
                sum += file->pdf(wi, wo) / wo.z * kPi / (kSide * kSide);
                // ... and what sampling makes of it.
                const auto drawn = file->sample(wi, (i + 0.5) / kSide, (j + 0.5) / kSide);
                if (!drawn) {
                    none += 1.0 / (kSide * kSide);
                    continue;
                }
                file->eval(wi, drawn->wo, f);
                estimate += f[0] * drawn->wo.z / drawn->pdf / (kSide * kSide);
            }
        EXPECT_NEAR(sum + none, 1, 0.02) << theta;
        EXPECT_NEAR(estimate, albedo[0], 0.01 * albedo[0]) << theta;
    }
}

TEST(Rgl, RefusesDamagedFiles) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat& rgl = *formats.find("rgl");
    Experiment experiment = few_layers();
    const ExportSource source(parse_brdf_spec("lambert:albedo=0.5"), experiment, 1);
    rgl.write(source, FormatOptions(rgl.options, "n=4,theta=2,normals=8"), folder / "a.bsdf");
    const std::string good = test::get(folder / "a.bsdf");
    for (std::size_t length = 0; length < good.size(); length += 997) {
        test::put(folder / "cut.bsdf", good.substr(0, length));
        EXPECT_THROW(rgl.read(folder / "cut.bsdf"), Error) << length;
    }
    test::with_each_byte_damaged(folder / "a.bsdf", 700, [&](std::size_t) {
        try {
            const auto file = rgl.read(folder / "a.bsdf");
            std::vector<double> f(static_cast<std::size_t>(file->channels()));
            file->eval(from_spherical(0.5, 1), from_spherical(0.7, 3), f);
        } catch (const Error&) {
        }
    });
}

}  // namespace
}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/merl_angles.h>
#include <asperity/formats/test_files.h>

#include <array>
#include <cstring>
#include <string>

namespace asperity::io {
namespace {

using namespace merl;

TEST(MerlAngles, ByHand) {
    // Mirror at 30 degrees: the half vector is the normal, the difference 30 degrees.
    const Angles mirror =
        angles_of(from_spherical(radians(30), 0), from_spherical(radians(30), kPi));
    EXPECT_NEAR(mirror.half, 0, 1e-12);
    EXPECT_NEAR(degrees(mirror.difference), 30, 1e-9);
    // Straight back from 30 degrees: the half vector is the direction itself.
    const Vec3 w = from_spherical(radians(30), 1);
    EXPECT_NEAR(degrees(angles_of(w, w).half), 30, 1e-9);
    EXPECT_NEAR(angles_of(w, w).difference, 0, 1e-7);
}

TEST(MerlAngles, BothWaysGiveOneCellAndCentresComeBack) {
    for (std::size_t cell = 7; cell < 1'458'000; cell += 4999) {
        const auto [wi, wo] = directions_of(centre_of(cell));
        EXPECT_EQ(cell_of(angles_of(wi, wo)), cell);
        EXPECT_EQ(cell_of(angles_of(wo, wi)), cell);
        EXPECT_EQ(cell_of(angles_of(rotate_z(wi, 2), rotate_z(wo, 2))), cell);
    }
}

TEST(Merl, HoldsModelsWithinFivePercent) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat& merl = *formats.find("merl");
    Experiment experiment;
    experiment.illumination.theta_deg = {0, 40, 70};
    experiment.detector.resolution = 64;
    const ExportSource source(parse_brdf_spec("ggx:alpha=0.3,f0=0.9/0.6/0.3"), experiment, 2);
    merl.write(source, FormatOptions({}, ""), folder / "a.binary");
    EXPECT_EQ(test::get(folder / "a.binary").size(), 34'992'012U);
    const Fidelity fidelity = fidelity_of(source, merl, folder / "a.binary");
    EXPECT_LT(fidelity.mean_l1, 0.05);
    EXPECT_LT(std::abs(fidelity.max_albedo_difference), 0.01);
    // The channels have scales of their own in the file: a cell's middle comes back in each, and
    // what stands there is f over the database's scales, 1, 1.15 and 1.66 of 1500.
    const auto file = formats.read(folder / "a.binary");
    constexpr std::size_t kCell = 90 + 180 * (20 + 90 * 15), kAllCells = 1'458'000;
    const auto [wi, wo] = directions_of(centre_of(kCell));
    std::array<double, 3> expected{}, found{}, stored{};
    const std::string bytes = test::get(folder / "a.binary");
    for (std::size_t c = 0; c < 3; ++c)
        std::memcpy(&stored[c], &bytes[12 + 8 * (c * kAllCells + kCell)], sizeof(double));
    source.bsdf().eval(wi, wo, expected);
    file->eval(wi, wo, found);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-9 * expected[c]);
    constexpr std::array kScale = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(stored[c] * kScale[c], expected[c], 1e-9 * expected[c]);
}

TEST(Merl, RefusesOtherSizes) {
    const test::TemporaryFolder folder;
    test::put(folder / "a.binary", std::string("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12));
    EXPECT_THROW(BsdfFormats().read(folder / "a.binary"), Error);
    test::put(folder / "b.binary", "");
    EXPECT_THROW(BsdfFormats().read(folder / "b.binary"), Error);
}

}  // namespace
}  // namespace asperity::io

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/klems_basis.h>
#include <asperity/formats/test_files.h>

namespace asperity::io {
namespace {

TEST(KlemsBasis, PatchesCoverTheHemisphere) {
    for (const auto& [kind, patches] : {std::pair{"full", 145}, {"half", 77}, {"quarter", 41}}) {
        const KlemsBasis basis(kind);
        EXPECT_EQ(basis.patches(), patches);
        double sum = 0;
        for (int k = 0; k < patches; ++k) {
            sum += basis.projected_solid_angle(k);
            for (const double u : {0.01, 0.5, 0.99})
                EXPECT_EQ(basis.patch_of(basis.direction(k, u, 1 - u)), k);
        }
        EXPECT_NEAR(sum, kPi, 1e-12);
    }
    EXPECT_THROW(KlemsBasis("whole"), Error);
}

TEST(KlemsBasis, AMirrorIsTheDiagonal) {
    const KlemsBasis basis("full");
    const Vec3 wi = from_spherical(radians(40), radians(70));
    const Vec3 mirror = {-wi.x, -wi.y, wi.z};
    EXPECT_EQ(basis.patch_of(klems_incident(wi)), basis.patch_of(mirror));
    // Ring 40 .. 45 degrees begins with patch 1 + 8 + 16 + 20 = 45 (35 .. 45 degrees), 24 a ring:
    // azimuth 250 degrees is 16.67 patches of 15 degrees, rounded 17.
    EXPECT_EQ(basis.patch_of(mirror), 45 + 17);
}

Fidelity through_file(const char* spec, const char* options) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat& klems = *formats.find("klems");
    Experiment experiment;
    experiment.illumination.theta_deg = {40};
    experiment.detector.resolution = 16;
    const ExportSource source(parse_brdf_spec(spec), experiment, 2);
    klems.write(source, FormatOptions(klems.options, options), folder / "a.xml");
    return fidelity_of(source, klems, folder / "a.xml");
}

TEST(Klems, ADiffuseSurfaceIsExact) {
    for (const char* basis : {"basis=half", "basis=quarter"}) {
        const Fidelity fidelity = through_file("lambert:albedo=0.5", basis);
        EXPECT_LT(fidelity.mean_l1, 1e-5);  // digits of the file
    }
}

TEST(Klems, ABroadLobeKeepsItsEnergy) {
    const Fidelity fidelity = through_file("ggx:alpha=0.6", "basis=half");
    EXPECT_LT(fidelity.mean_l1, 0.12);
    EXPECT_LT(std::abs(fidelity.max_albedo_difference), 0.02);
}

TEST(Klems, RefusesWhatIsNoMatrix) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    for (const char* text : {"<WindowElement", "<WindowElement/>",
                             "<WindowElement><Optical><Layer><DataDefinition><AngleBasis>"
                             "<AngleBasisName>LBNL/Klems Full</AngleBasisName></AngleBasis>"
                             "</DataDefinition></Layer></Optical></WindowElement>"}) {
        test::put(folder / "a.xml", text);
        EXPECT_THROW(formats.read(folder / "a.xml"), Error) << text;
    }
}

}  // namespace
}  // namespace asperity::io

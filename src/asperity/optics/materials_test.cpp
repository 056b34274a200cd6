// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/materials.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

struct Anchor {
    const char* material;
    double wavelength, n, k, r0;
};

// Values read off the published tables by hand, linear between the points, to their last digit.
constexpr Anchor kAnchors[] = {
    {"Al", 450, .633, 5.454, .922},  {"Al", 550, 1.015, 6.627, .915},
    {"Al", 650, 1.558, 7.712, .906}, {"Ag", 450, .040, 2.648, .980},
    {"Ag", 550, .060, 3.597, .983},  {"Ag", 650, .052, 4.409, .990},
    {"Au", 450, 1.383, 1.916, .408}, {"Au", 550, .424, 2.472, .792},
    {"Au", 650, .156, 3.602, .957},  {"Cu", 450, 1.240, 2.393, .538},
    {"Cu", 550, 1.007, 2.582, .624}, {"Cu", 650, .238, 3.626, .935},
    {"Cr", 450, 2.323, 3.135, .555}, {"Cr", 550, 3.181, 3.329, .555},
    {"Cr", 650, 3.107, 3.331, .556},
};

TEST(MaterialsTest, PublishedValues) {
    for (const Anchor& a : kAnchors) {
        const ComplexIndex index = refractive_index(a.material, a.wavelength);
        EXPECT_NEAR(index.n, a.n, 6e-4) << a.material << " " << a.wavelength;
        EXPECT_NEAR(index.k, a.k, 6e-4) << a.material << " " << a.wavelength;
        EXPECT_NEAR(fresnel_conductor(1, index.n, index.k), a.r0, 6e-4)
            << a.material << " " << a.wavelength;
    }
}

TEST(MaterialsTest, MeasuredPointsAreMetExactly) {
    // Johnson and Christy 1974, rows at 0.521 and 0.659 micrometre.
    EXPECT_DOUBLE_EQ(refractive_index("Fe", 521).n, 2.86);
    EXPECT_DOUBLE_EQ(refractive_index("Fe", 659).k, 3.10);
    EXPECT_DOUBLE_EQ(refractive_index("Ni", 521).n, 1.85);
    EXPECT_DOUBLE_EQ(refractive_index("Ni", 659).k, 4.26);
    EXPECT_DOUBLE_EQ(refractive_index("Ti", 521).n, 2.44);
    EXPECT_DOUBLE_EQ(refractive_index("Ti", 659).k, 3.84);
    // Half way from 0.496 (1.82, 3.25) to 0.521 (1.85, 3.42).
    EXPECT_NEAR(refractive_index("Ni", 508.5).n, 1.835, 1e-12);
    EXPECT_NEAR(refractive_index("Ni", 508.5).k, 3.335, 1e-12);
}

TEST(MaterialsTest, EveryMaterialCoversTheWholeRange) {
    ASSERT_EQ(materials().size(), 8u);
    for (const TabulatedMaterial& material : materials()) {
        for (double w = kMinWavelength; w <= kMaxWavelength; w += 0.5) {
            const ComplexIndex index = refractive_index(material.symbol, w);
            EXPECT_GT(index.n, 0);
            EXPECT_GT(index.k, 1);  // metals
            EXPECT_LT(index.k, 9);
        }
        EXPECT_NE(material.source.find("(19"), std::string_view::npos);
    }
}

TEST(MaterialsTest, RefusesWhatItDoesNotKnow) {
    const auto where = [](const char* name, double w) {
        try {
            refractive_index(name, w);
        } catch (const Error& e) {
            return e.where();
        }
        return std::string("accepted");
    };
    EXPECT_EQ(where("Pb", 550), "material");
    EXPECT_EQ(where("", 550), "material");
    EXPECT_EQ(where("au", 550), "material");
    EXPECT_EQ(where("Au", 399.9), "wavelengths");
    EXPECT_EQ(where("Au", 700.1), "wavelengths");
    EXPECT_EQ(where("Au", std::nan("")), "wavelengths");
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/formats/bsdfs/fidelity.h>
#include <asperity/formats/bsdfs/tensor_tree.h>
#include <asperity/formats/test_files.h>

namespace asperity::io {
namespace {

TEST(TensorTree, TheMapKeepsAreasAndComesBack) {
    EXPECT_NEAR(disk_to_square(0, 0).u, 0.5, 1e-12);
    EXPECT_NEAR(disk_to_square(1, 0).u, 1, 1e-12);   // +x is the right side
    EXPECT_NEAR(disk_to_square(0, -1).v, 0, 1e-12);  // -y the lower one
    EXPECT_NEAR(disk_to_square(std::sqrt(0.5), std::sqrt(0.5)).u, 1, 1e-12);  // a corner
    constexpr int kSide = 64;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const SquarePoint s = {(i + 0.3) / kSide, (j + 0.6) / kSide};
            const Vec3 w = hemisphere_of_square(s);
            const SquarePoint back = disk_to_square(w.x, w.y);
            EXPECT_NEAR(back.u, s.u, 1e-12);
            EXPECT_NEAR(back.v, s.v, 1e-12);
            EXPECT_NEAR(length(w), 1, 1e-12);
            // The area of a small square, by its corners: pi times as large on the disk.
            const double h = 1e-5;
            const Vec3 a = hemisphere_of_square({s.u + h, s.v}),
                       b = hemisphere_of_square({s.u, s.v + h});
            const double area = (a.x - w.x) * (b.y - w.y) - (a.y - w.y) * (b.x - w.x);
            EXPECT_NEAR(area / (h * h), kPi, 0.01);
        }
}

TEST(TensorTree, CoordinatesOfAMirror) {
    // sin 30 = 1/2. The mirror direction of light from anywhere is at azimuth 0 of the second.
    const Vec3 wi = from_spherical(radians(30), 2.5);
    const auto c = tree_coordinates(3, wi, {-wi.x, -wi.y, wi.z});
    EXPECT_NEAR(c[0], 0.25, 1e-12);
    EXPECT_NEAR(c[1], 0.75, 1e-12);
    EXPECT_NEAR(c[2], 0.5, 1e-12);
    const auto c4 = tree_coordinates(4, wi, {-wi.x, -wi.y, wi.z});
    EXPECT_NEAR(c4[0], c4[2], 1e-12);
    EXPECT_NEAR(c4[1], c4[3], 1e-12);
    for (const int rank : {3, 4}) {
        const std::array<double, 4> given = {0.3, 0.2, 0.9, 0.6};
        const TreeDirections w = tree_directions(rank, given);
        const auto back = tree_coordinates(rank, w.wi, w.wo);
        for (std::size_t d = 0; d < static_cast<std::size_t>(rank); ++d)
            EXPECT_NEAR(back[d], given[d], 1e-12);
    }
}

TEST(TensorTree, BranchesAndLeavesAreReadInTheirOrders) {
    // A branch of eight: bit 0 is the upper half of the first coordinate. The last child is a leaf
    // of eight values, in which the first coordinate is the slowest.
    const TensorTree tree(3, "{{1}{2}{3}{4}{5}{6}{7}{10 11 12 13,14 15 16 17}}", "");
    EXPECT_EQ(tree.at({0.1, 0.1, 0.1}), 1);
    EXPECT_EQ(tree.at({0.9, 0.1, 0.1}), 2);
    EXPECT_EQ(tree.at({0.1, 0.9, 0.1}), 3);
    EXPECT_EQ(tree.at({0.1, 0.1, 0.9}), 5);
    EXPECT_EQ(tree.at({0.6, 0.6, 0.9}), 11);
    EXPECT_EQ(tree.at({0.9, 0.6, 0.6}), 14);
    EXPECT_EQ(TensorTree(3, tree.text(), "").text(), tree.text());
    for (const char* wrong :
         {"", "{", "{1 2}", "{{1}{2}}", "{1}{2}", "{{1}{2}{3}{4}{5}{6}{7}8}", "{x}"})
        EXPECT_THROW(TensorTree(3, wrong, "f"), Error) << wrong;
}

Fidelity through_file(const char* spec, const char* options) {
    const test::TemporaryFolder folder;
    const BsdfFormats formats;
    const BsdfFormat& tree = *formats.find("tensortree");
    Experiment experiment;
    experiment.illumination.theta_deg = {10, 50};
    experiment.detector.resolution = 32;
    const ExportSource source(parse_brdf_spec(spec), experiment, 2);
    tree.write(source, FormatOptions(tree.options, options), folder / "a.xml");
    EXPECT_TRUE(formats.can_read(folder / "a.xml"));
    EXPECT_EQ(formats.read(folder / "a.xml")->channels(), 1);
    return fidelity_of(source, tree, folder / "a.xml");
}

TEST(TensorTree, HoldsModels) {
    EXPECT_LT(through_file("lambert:albedo=0.5", "rank=3").mean_l1, 1e-4);
    EXPECT_LT(through_file("ggx:alpha=0.4", "rank=3,levels=5").mean_l1, 0.05);
    EXPECT_LT(through_file("ggx:alpha=0.6,alpha_y=0.4", "rank=4").mean_l1, 0.12);
}

}  // namespace
}  // namespace asperity::io

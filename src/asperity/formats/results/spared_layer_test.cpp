// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/spared_layer.h>

#include <asperity/formats/results/result_fields.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/test_measurements.h>

#include <algorithm>

namespace asperity::io {
namespace {

constexpr std::size_t kGroups = GroupSums::kGroups;

/// Two batches of ten rays, of which 5 and 7 meet known facets: these bring 3 units each to the
/// first cell, 5 to the second one. Paths bring 4 and 6 units to the first cell.
Layer two_batches() {
    Layer layer;
    layer.rays = 20;
    layer.energy = {3 * 12 + 10, 5 * 12};
    LayerSpread& spread = layer.spread;
    spread.done.add({0, 2});
    spread.largest_batch = 10;
    spread.exact = {3 * 12, 5 * 12};
    spread.reached = {2, 0};
    spread.squares = {19 * 19 + 27 * 27, 25 * 25 + 35 * 35};
    spread.groups.rays.assign(kGroups, 0);
    spread.groups.rays[0] = spread.groups.rays[1] = 10;
    spread.groups.energy.assign(2 * kGroups, 0);
    spread.groups.energy[0] = 19, spread.groups.energy[1] = 25;
    spread.groups.energy[2] = 27, spread.groups.energy[3] = 35;
    spread.bounces.resize(1);
    spread.albedo.resize(1);
    spread.albedo_by_age.resize(LayerSums::kAges);
    layer.escaped_by_bounce = {106};
    layer.absorbed = layer.truncated = layer.edge = {0};
    layer.stderr_energy = {1, 2};
    return layer;
}

constexpr SumShape kTwoCells = {.cells = 2, .columns = 2};

TEST(SparedLayer, LeavesOutWhatFollowsFromKnownFacets) {
    const Layer layer = two_batches();
    const SparedLayer spared = spare(layer, kTwoCells);
    EXPECT_EQ(spared.known_unit, 12u);
    EXPECT_EQ(spared.known, (std::vector<std::uint64_t>{3, 5}));
    EXPECT_EQ(spared.energy, (std::vector<std::uint64_t>{10, 0}));
    EXPECT_TRUE(spared.known_squares == 5 * 5 + 7 * 7);
    EXPECT_EQ(spared.known_of_group[0], 5u);
    EXPECT_EQ(spared.known_of_group[1], 7u);
    EXPECT_EQ(std::count(spared.known_of_group.begin(), spared.known_of_group.end(), 0u), 14);
    // The first cell: guessed are 9 * 74 + 2 * 36 * 10 / 2 + 10 * 10 / 2 = 1076 of 1090
    EXPECT_EQ(spared.squares, (std::vector<std::uint64_t>{2 * 14, 0, 0, 0}));
    // Guessed are 5 of each group's rays in the first block, which are 4 and 6
    std::vector<std::uint64_t> groups(2 * kGroups);
    groups[0] = 1, groups[2] = 2;
    EXPECT_EQ(spared.groups, groups);
    // Errors that are made up do not follow
    EXPECT_FALSE(spared.errors_follow);

    Layer back = layer;
    back.energy = spared.energy;
    back.spread.exact.clear();
    back.spread.squares.clear();
    back.spread.groups.energy.clear();
    restore(back, spared, kTwoCells);
    EXPECT_EQ(back.energy, layer.energy);
    EXPECT_EQ(back.spread.exact, layer.spread.exact);
    EXPECT_TRUE(back.spread.squares == layer.spread.squares);
    EXPECT_EQ(back.spread.groups, layer.spread.groups);
}

void expect_all_alike(const Measurement& a, const Measurement& b) {
    asperity::test::expect_same_bits(a, b);
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
        const LayerSpread &x = a.layers[k].spread, &y = b.layers[k].spread;
        EXPECT_TRUE(x.done == y.done && x.squares == y.squares && x.stretched == y.stretched);
        EXPECT_TRUE(x.exact == y.exact && x.reached == y.reached && x.bounces == y.bounces);
        EXPECT_TRUE(x.albedo == y.albedo && x.albedo_by_age == y.albedo_by_age);
        EXPECT_TRUE(x.halves == y.halves && x.groups == y.groups);
    }
    EXPECT_EQ(checksum(a), checksum(b));
}

Measurement gold(int height_thousandths) {
    Experiment e = asperity::test::small_experiment();
    e.optics = asperity::test::gold_like();
    return asperity::test::measured(asperity::test::noise(64, 1e-3 * height_thousandths), e);
}

TEST(SparedLayer, ResultsComeBackToTheBit) {
    const test::TemporaryFolder folder;
    bool known = false;
    for (const int height : {10, 300, 2000}) {
        Measurement m = gold(height);
        save_measurement(m, folder / "r.asperity");
        const TensorFile file(folder / "r.asperity");
        EXPECT_EQ(file.find("stderr_energy"), nullptr);
        EXPECT_EQ(file.find("energy_squares"), nullptr);
        expect_all_alike(load_measurement(folder / "r.asperity"), m);
        known = known || file.find("energy_known") != nullptr;
        // Errors that do not follow are kept
        m.layers[1].stderr_energy[5] += 1;
        save_measurement(m, folder / "r.asperity");
        EXPECT_NE(TensorFile(folder / "r.asperity").find("stderr_energy"), nullptr);
        expect_all_alike(load_measurement(folder / "r.asperity"), m);
    }
    EXPECT_TRUE(known);
}

// As format 2 had it: all fields, and the checksum behind the table of the others'.
TEST(SparedLayer, FilesThatLeaveNothingOutAreRead) {
    const test::TemporaryFolder folder;
    const Measurement m = gold(300);
    const ResultFields fields(m);
    const std::uint32_t second = 2;
    std::vector<TensorBlock> blocks;
    std::vector<Digest> digests;
    for (TensorBlock block : fields.blocks()) {
        if (block.name == "format") block.parts = {std::as_bytes(std::span(&second, 1))};
        if (block.name == "checksum" || block.name == "field_checksums") continue;
        blocks.push_back(block);
        digests.push_back(digest_of(block));
    }
    blocks.push_back({"field_checksums",
                      TensorType::U64,
                      {digests.size(), 2},
                      {std::as_bytes(std::span(digests))}});
    blocks.push_back(
        {"checksum", TensorType::U8, {32}, {std::as_bytes(std::span(fields.checksum()))}});
    write_tensor_file(folder / "r.asperity", blocks);
    expect_all_alike(load_measurement(folder / "r.asperity"), m);
    EXPECT_EQ(load_head(folder / "r.asperity").checksum, checksum(m));
    // A checksum that is none of the result's
    std::string bytes = test::get(folder / "r.asperity");
    bytes.back() = bytes.back() == '0' ? '1' : '0';
    test::put(folder / "r.asperity", bytes);
    for (const auto& load : {+[](const std::string& p) { (void)load_measurement(p); },
                             +[](const std::string& p) { (void)load_head(p); }})
        test::expect_error(ErrorCode::InvalidInput, "checksum of the whole",
                           [&] { load(folder / "r.asperity"); });
}

TEST(ResultHead, HoldsWhatLayersHoldAsAWhole) {
    const test::TemporaryFolder folder;
    const Measurement m = gold(300);
    save_measurement(m, folder / "r.asperity");
    const ResultHead head = load_head(folder / "r.asperity");
    EXPECT_EQ(head.checksum, checksum(m));
    ASSERT_EQ(head.measurement.layers.size(), m.layers.size());
    for (std::size_t k = 0; k < m.layers.size(); ++k) {
        const Layer &a = head.measurement.layers[k], &b = m.layers[k];
        EXPECT_TRUE(a.energy.empty() && a.stderr_energy.empty());
        EXPECT_TRUE(a.rays == b.rays && a.escaped == b.escaped && a.absorbed == b.absorbed &&
                    a.escaped_by_bounce == b.escaped_by_bounce &&
                    a.stderr_albedo == b.stderr_albedo);
    }
}

}  // namespace
}  // namespace asperity::io

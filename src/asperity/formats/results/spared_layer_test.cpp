// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/spared_layer.h>

#include <asperity/formats/results/result_fields.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/formats/results/spared_fields.h>
#include <asperity/formats/results/sum_guesses.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/noise_shares.h>
#include <asperity/gonio/test_measurements.h>
#include <fmt/format.h>

#include <algorithm>
#include <random>

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
    SparedLayer spared = spare(layer, kTwoCells);
    EXPECT_EQ(spared.known_unit, 12u);
    EXPECT_EQ(spared.known, (std::vector<std::uint64_t>{3, 5}));
    // One path, as far as can be told
    EXPECT_EQ(spared.energy.paths, (std::vector<std::uint32_t>{1, 0}));
    EXPECT_EQ(spared.energy.of_path, (std::vector<std::uint64_t>{10}));
    EXPECT_EQ(spared.energy.zeros, (std::vector<std::uint8_t>{1}));
    EXPECT_EQ(spared.energy.rests, (std::vector<std::uint64_t>{0, 0}));
    EXPECT_EQ(spared.zeros, (std::vector<std::uint8_t>{6, 1, 0}));
    EXPECT_TRUE(spared.known_squares == 5 * 5 + 7 * 7);
    EXPECT_EQ(spared.known_of_group[0], 5u);
    EXPECT_EQ(spared.known_of_group[1], 7u);
    EXPECT_EQ(std::count(spared.known_of_group.begin(), spared.known_of_group.end(), 0u), 14);
    // The first cell: 1090 - (9 * 74 + 2 * 36 * 10 / 2) = 64, in 64ths as much as guessed: 10 * 10
    EXPECT_EQ(spared.path_squares, (std::vector<std::uint64_t>{2, 0}));
    EXPECT_EQ(spared.squares, (std::vector<std::uint64_t>{0, 0, 0, 0}));
    // The path is guessed to be of the second group; of 4 and 6 then 0 and 10 are guessed, halved
    std::vector<std::uint64_t> paths(2 * kGroups), groups(2 * kGroups);
    paths[2] = 2;
    groups[0] = 4, groups[2] = 3;
    EXPECT_EQ(spared.path_groups, paths);
    EXPECT_EQ(spared.groups, groups);
    // Errors that are made up do not follow
    EXPECT_FALSE(spared.errors_follow);

    Layer back = layer;
    back.energy.clear();
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

/// As if each batch had a surface of its own.
void add_halves(Layer& layer, std::mt19937_64& engine) {
    LayerSums::Halves& halves = layer.spread.halves;
    for (const Wide squares : layer.spread.squares)
        halves.cells.push_back(engine() % 50 == 0 ? (Wide{engine()} << 64) | engine()
                                                  : squares / 3 + engine() % 1000);
    for (std::size_t c = 0; c < layer.escaped.size(); ++c)
        halves.albedo.push_back((Wide{engine()} << 64) | engine());
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

/// What format 3 left out of a layer: no numbers of paths, and nothing is divided.
SparedLayer left_out_by_format_3(const Layer& layer, const SumShape& shape) {
    SparedLayer spared = spare(layer, shape);
    const std::vector<std::uint64_t> paths = take_energy(spared.energy, shape);
    spared.energy = {};
    spared.zeros = {};
    for (auto* numbers : {&spared.path_squares, &spared.path_groups, &spared.path_halves})
        numbers->clear();
    const SumGuesses guesses(layer, paths, spared, shape);
    const std::size_t size = layer.spread.squares.size();
    guesses.for_squares({}, [&](std::size_t k, Wide known, Wide guess) {
        const Wide right = layer.spread.squares[k] - known, rest = folded(right - guess);
        spared.squares[k] = static_cast<std::uint64_t>(rest);
        spared.squares[size + k] = static_cast<std::uint64_t>(rest >> 64);
        return right;
    });
    guesses.for_groups(
        {}, [&](std::size_t out, std::size_t in, std::uint64_t known, std::uint64_t guess) {
            const std::uint64_t right = layer.spread.groups.energy[in] - known;
            spared.groups[out] = folded(right - guess);
            return right;
        });
    spared.energy.rests = paths;  // stands where the rests of later formats stand
    return spared;
}

/// Writes these blocks with both checksums, as formats 3 and 4 have them.
void write_blocks(const std::string& path, std::vector<TensorBlock> blocks, std::string checksum) {
    blocks.push_back({"checksum", TensorType::U8, {32}, {std::as_bytes(std::span(checksum))}});
    std::vector<Digest> digests;
    for (const TensorBlock& block : blocks) digests.push_back(stored_digest_of(block));
    blocks.push_back({"field_checksums",
                      TensorType::U64,
                      {digests.size(), 2},
                      {std::as_bytes(std::span(digests))}});
    write_tensor_file(path, blocks);
}

TEST(SparedLayer, FilesOfFormat3AreRead) {
    const test::TemporaryFolder folder;
    std::mt19937_64 engine(4);
    for (const bool halves : {false, true}) {
        Measurement m = gold(300);
        std::vector<SparedLayer> spared;
        for (Layer& layer : m.layers) {
            if (halves) add_halves(layer, engine);
            spared.push_back(left_out_by_format_3(layer, m.shape()));
        }
        const ResultFields fields(m);
        const std::uint32_t third = 3;
        std::vector<TensorBlock> blocks;
        const std::vector<TensorBlock> rests = spared_blocks(spared, m.shape());
        for (TensorBlock block : fields.blocks()) {
            if (block.name == "format") block.parts = {std::as_bytes(std::span(&third, 1))};
            if (block.name == "energy") block = rests[0], block.name = "energy_of_paths";
            for (const char* gone : {"stderr_energy", "energy_squares", "group_energy",
                                     "energy_of_rays", "cell_noise", "checksum", "field_checksums"})
                if (block.name == gone) block.name.clear();
            if (!block.name.empty()) blocks.push_back(block);
        }
        for (const TensorBlock& block : rests)
            if (block.name.starts_with("known_") || block.name == "energy_known" ||
                block.name == "energy_squares_rest" || block.name == "group_energy_rest")
                blocks.push_back(block);
        write_blocks(folder / "r.asperity", blocks, fields.checksum());
        expect_all_alike(load_measurement(folder / "r.asperity"), m);
        EXPECT_EQ(load_head(folder / "r.asperity").checksum, checksum(m));
    }
}

// Of several surfaces, with what their batches cannot be: halves to the last bit.
TEST(SparedLayer, HalvesComeBackToTheBit) {
    const test::TemporaryFolder folder;
    std::mt19937_64 engine(5);
    for (const int height : {10, 300}) {
        Measurement m = gold(height);
        for (Layer& layer : m.layers) add_halves(layer, engine);
        save_measurement(m, folder / "r.asperity");
        EXPECT_EQ(TensorFile(folder / "r.asperity").find("energy_halves"), nullptr);
        expect_all_alike(load_measurement(folder / "r.asperity"), m);
        const ResultHead head = load_head(folder / "r.asperity");
        EXPECT_TRUE(head.measurement.layers[0].energy.empty());
        const auto all = shares_of_rays(m.layers),
                   of_head = shares_of_rays(head.measurement.layers);
        ASSERT_TRUE(all && of_head);
        EXPECT_EQ(all->albedo, of_head->albedo);
        EXPECT_EQ(all->cells, of_head->cells);
    }
}

// Fields with right checksums whose numbers cannot be.
TEST(SparedLayer, NonsenseIsRefused) {
    const test::TemporaryFolder folder;
    Measurement m = gold(300);
    const ResultFields fields(m, true);
    const auto refused = [&](const std::string& name, const std::string& why, auto change) {
        std::vector<TensorBlock> blocks(fields.blocks().begin(), fields.blocks().end() - 2);
        std::vector<std::byte> bytes;
        for (TensorBlock& block : blocks) {
            if (block.name != name) continue;
            for (const auto part : block.parts) bytes.insert(bytes.end(), part.begin(), part.end());
            change(block, bytes);
            block.parts = {bytes};
            block.packed = {};
        }
        std::erase_if(blocks, [](const TensorBlock& block) { return block.shape.empty(); });
        write_blocks(folder / "r.asperity", blocks, fields.checksum());
        test::expect_error(ErrorCode::InvalidInput, why,
                           [&] { load_measurement(folder / "r.asperity"); });
    };
    using Bytes = std::vector<std::byte>;
    refused("energy_zeros", "'energy_zeros': no number of 64 bits is divided by 2^64",
            [](TensorBlock&, Bytes& bytes) { bytes[1] = std::byte{64}; });
    refused("sum_zeros", "'sum_zeros': no number of 128 bits is divided by 2^128",
            [](TensorBlock&, Bytes& bytes) { bytes[0] = std::byte{128}; });
    refused("sum_zeros", "'sum_zeros': no number of 64 bits is divided by 2^64",
            [&](TensorBlock&, Bytes& bytes) {
                bytes[static_cast<std::size_t>(m.channels())] = std::byte{64};
            });
    refused("path_counts", "'path_counts' does not have the shape",
            [](TensorBlock& block, Bytes&) { std::swap(block.shape[2], block.shape[3]); });
    for (const char* name : {"path_counts", "energy_of_a_path", "energy_zeros", "sum_zeros",
                             "path_squares_rest", "path_group_rest"})
        refused(name, fmt::format("field '{}' is missing", name),
                [](TensorBlock& block, Bytes&) { block.shape.clear(); });
    refused("path_counts", "the checksum of the whole does not fit",
            [](TensorBlock&, Bytes& bytes) {
                *std::find_if(bytes.begin(), bytes.end(),
                              [](std::byte b) { return b != std::byte{0}; }) ^= std::byte{1};
            });
    // Squares are no part of it, but errors follow from them
    refused("path_squares_rest", "the checksum of the whole does not fit",
            [](TensorBlock&, Bytes& bytes) {
                for (std::byte& b : bytes) b ^= std::byte{1};
            });
}

// Paths that all bring as much leave no rest of their energy.
TEST(SparedLayer, EnergyOfWhiteSurfacesIsToldByPaths) {
    const test::TemporaryFolder folder;
    Experiment e = asperity::test::small_experiment();
    e.illumination.theta_deg = {30, 50};
    const Measurement m = asperity::test::measured(asperity::test::noise(64, 2), e);
    save_measurement(m, folder / "r.asperity");
    const TensorFile file(folder / "r.asperity");
    EXPECT_EQ(file.require("energy_rest", TensorType::U64, 5).shape[0], 0u);
    expect_all_alike(load_measurement(folder / "r.asperity"), m);
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

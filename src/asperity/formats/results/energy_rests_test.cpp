// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/energy_rests.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace asperity::io {
namespace {

constexpr SumShape kShape = {.cells = 6 * 10, .channels = 3, .orders = 2, .columns = 10};

std::size_t size_of_energy(const SumShape& shape) {
    return shape.orders * shape.channels * shape.cells;
}

void expect_to_come_back(const std::vector<std::uint64_t>& energy, const SumShape& shape) {
    EnergyRests rests = energy_rests(energy, shape);
    EXPECT_EQ(rests.paths.size(), shape.orders * shape.cells);
    EXPECT_EQ(rests.of_path.size(), shape.orders * shape.channels);
    EXPECT_TRUE(std::all_of(rests.zeros.begin(), rests.zeros.end(), [](int z) { return z < 64; }));
    EXPECT_EQ(take_energy(rests, shape), energy);
}

// Anything at all, not only what metals do.
TEST(EnergyRests, AnyEnergiesComeBack) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    std::mt19937_64 engine(1);
    const std::vector<SumShape> shapes = {
        kShape,
        {.cells = 60, .columns = 10},
        {.cells = 6, .channels = 2, .orders = 3, .columns = 1},
        {.cells = 8, .channels = 4, .columns = 2},
        {.cells = 7, .channels = 3, .columns = 7},
    };
    for (const SumShape& shape : shapes) {
        expect_to_come_back(std::vector<std::uint64_t>(size_of_energy(shape)), shape);
        expect_to_come_back(std::vector<std::uint64_t>(size_of_energy(shape), kMost), shape);
        for (int turn = 0; turn < 200; ++turn) {
            std::vector<std::uint64_t> energy(size_of_energy(shape));
            const auto bits = static_cast<unsigned>(turn % 64);
            const auto zeros = static_cast<unsigned>(engine() % (64 - bits));
            for (std::uint64_t& e : energy) {
                e = (engine() >> (63 - bits)) << zeros;
                const std::uint64_t extremes[] = {0, 1, std::uint64_t{1} << 63, kMost};
                if (engine() % 8 == 0) e = turn % 2 ? 0 : extremes[engine() % 4];
            }
            // A channel without energy, before others and behind them
            const auto none =
                energy.begin() + static_cast<std::ptrdiff_t>(bits % shape.channels * shape.cells);
            if (turn % 3 == 0) std::fill_n(none, shape.cells, 0);
            expect_to_come_back(energy, shape);
        }
    }
}

// Whoever reads need not know how the numbers were guessed.
TEST(EnergyRests, AnyNumbersOfPathsWillDo) {
    std::mt19937_64 engine(2);
    EnergyRests rests;
    rests.paths.resize(kShape.orders * kShape.cells);
    for (std::uint32_t& n : rests.paths) n = static_cast<std::uint32_t>(engine());
    rests.of_path.resize(kShape.orders * kShape.channels);
    for (std::uint64_t& e : rests.of_path) e = engine() >> engine() % 64;
    rests.zeros.resize(kShape.orders * kShape.channels);
    for (std::uint8_t& z : rests.zeros) z = static_cast<std::uint8_t>(engine() % 64);
    rests.rests.resize(size_of_energy(kShape));
    for (std::uint64_t& r : rests.rests) r = engine();
    const std::vector<std::uint64_t> energy = take_energy(rests, kShape);
    ASSERT_EQ(energy.size(), size_of_energy(kShape));
    for (std::size_t k = 0; k < energy.size(); ++k)
        EXPECT_EQ(energy[k] & ((std::uint64_t{1} << rests.zeros[k / kShape.cells]) - 1), 0u);
}

// Paths that all bring the same leave nothing but their numbers.
TEST(EnergyRests, OfEqualPathsNothingIsLeft) {
    const std::uint64_t of_path[] = {std::uint64_t{9} << 28, std::uint64_t{7} << 27,
                                     std::uint64_t{3} << 29};
    std::mt19937_64 engine(3);
    std::vector<std::uint32_t> paths(kShape.cells);
    for (std::uint32_t& n : paths)
        n = engine() % 4 == 0 ? 0 : static_cast<std::uint32_t>(1 + engine() % 50);
    paths[0] = 1;
    std::vector<std::uint64_t> energy(size_of_energy(kShape));
    for (std::size_t k = 0; k < energy.size(); ++k)
        energy[k] = paths[k % kShape.cells] * of_path[k / kShape.cells % kShape.channels];
    EnergyRests rests = energy_rests(energy, kShape);
    for (std::size_t k = 0; k < rests.paths.size(); ++k)
        EXPECT_EQ(rests.paths[k], paths[k % kShape.cells]);
    EXPECT_EQ(rests.of_path, (std::vector<std::uint64_t>{of_path[0], of_path[1], of_path[2],
                                                         of_path[0], of_path[1], of_path[2]}));
    EXPECT_EQ(rests.zeros, (std::vector<std::uint8_t>{28, 27, 29, 28, 27, 29}));
    // A rounding may be left where what is above a cell tells its ratio
    EXPECT_LE(*std::max_element(rests.rests.begin(), rests.rests.end()), 2u);
    EXPECT_EQ(take_energy(rests, kShape), energy);
}

}  // namespace
}  // namespace asperity::io

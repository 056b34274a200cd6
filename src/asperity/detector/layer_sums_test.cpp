// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/detector/layer_sums.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace asperity {
namespace {

const SumShape kShape{.cells = 40, .channels = 2, .orders = 2, .bounces = 4};

/// A batch of some rays, half of which leave, with weights of their own.
BatchSums batch(std::uint64_t number, std::uint64_t rays) {
    const CounterRandom random(7, 3);
    std::vector<std::int32_t> cells, paths;
    std::vector<float> first, second;
    for (std::uint64_t k = 0; k < rays; ++k) {
        const auto u = random.uniform2(1000 * number + k);
        cells.push_back(static_cast<std::int32_t>(40 * u[0] * u[1]));
        paths.push_back(static_cast<std::int32_t>(k));
        first.push_back(static_cast<float>(u[1]));
        second.push_back(static_cast<float>(1 - u[0]));
    }
    const std::vector<const float*> weights{first.data(), second.data()};
    BatchSums sums(kShape);
    const auto half = static_cast<std::size_t>(rays / 2);
    sums.escape(0, 1 + static_cast<int>(number % 4), cells.data(), paths.data(), half, weights);
    sums.truncate(paths.data() + half, static_cast<std::size_t>(rays) - half, weights);
    sums.rays = rays;
    return sums;
}

LayerSums sum_of(const std::vector<std::uint64_t>& numbers) {
    LayerSums sums(kShape, 101);
    for (const std::uint64_t n : numbers) sums.add(n, batch(n, n < 3 ? 101 : 100));
    return sums;
}

TEST(LayerSums, AnyOrderAndAnyPartsGiveTheSameBits) {
    std::vector<std::uint64_t> numbers(12);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const LayerSums forward = sum_of(numbers);
    std::reverse(numbers.begin(), numbers.end());
    EXPECT_EQ(sum_of(numbers), forward);
    // Parts in another order; one of them holds batches of the largest kind alone
    LayerSums merged = sum_of({5, 8, 11, 3});
    merged += sum_of({0, 1, 2});
    merged += sum_of({10, 4});
    merged += sum_of({9, 7, 6});
    EXPECT_EQ(merged, forward);
}

/// Two rows of 20 columns: 3 rays into the first, one after two reflections into the second.
TEST(LayerSums, RowsAreSharedOutToTheLastUnit) {
    const SumShape shape{.cells = 40, .orders = 2, .bounces = 4};
    const std::vector<std::int32_t> first{0, 7, 19}, second{33}, paths{0, 1, 2};
    const std::vector<float> third(3, 1 / 3.0f);
    BatchSums b(shape);
    for (const bool weighted : {false, true, false}) {
        const std::vector<const float*> weights(weighted ? 1 : 0, third.data());
        b.escape(0, 1, first.data(), paths.data(), 3, weights);
        b.escape(0, 2, second.data(), paths.data(), 1, weights);
        b.rays = 4;
        b.share_rows(20);
        LayerSums sums(shape, 4);
        sums.add(0, b);
        const std::uint64_t ray = weighted ? to_energy(double{third[0]}) : kRayEnergy;
        for (std::size_t row = 0; row < 2; ++row) {
            // The first order holds the row of three, the second one that of one
            const std::uint64_t total = row == 0 ? 3 * ray : ray;
            const auto begin = sums.energy.begin() + static_cast<std::ptrdiff_t>(60 * row);
            EXPECT_EQ(std::accumulate(begin, begin + 20, std::uint64_t{0}), total);
            const auto [least, most] = std::minmax_element(begin, begin + 20);
            EXPECT_LE(*most - *least, 1u);
        }
        EXPECT_EQ(std::accumulate(sums.energy.begin(), sums.energy.end(), std::uint64_t{0}),
                  4 * ray);
        b.clear();
        // Paths that are not shared out come next, as they do from another layer
        b.escape(0, 1, second.data(), paths.data(), 1, {});
        b.rays = 4;
        LayerSums next(shape, 4);
        next.add(0, b);
        EXPECT_EQ(next.energy[33], kRayEnergy);
        b.clear();
    }
}

TEST(LayerSums, UnlikeLayersAreNotAdded) {
    LayerSums sums(kShape, 101);
    EXPECT_THROW(sums += LayerSums(kShape, 100), Error);
    SumShape other = kShape;
    other.cells = 41;
    EXPECT_THROW(sums += LayerSums(other, 101), Error);
}

TEST(LayerSums, ABatchIsAddedOnce) {
    LayerSums sums = sum_of({0, 4, 7});
    const LayerSums before = sums;
    EXPECT_THROW(sums.add(4, batch(4, 100)), Error);
    EXPECT_THROW(sums += sum_of({2, 7}), Error);
    EXPECT_EQ(sums, before);
    EXPECT_EQ(sums.batches(), 3u);
}

TEST(LayerSums, ErrorsAreThoseOfTheMeanOverBatches) {
    // Equal batches of 64 rays without weights: cell 5 gets 10, 20, 30, 40 of them
    const SumShape shape{.cells = 8, .bounces = 1};
    const std::vector<std::int32_t> cells(64, 5), paths(64, 0);
    LayerSums sums(shape, 64);
    for (const std::size_t n : {10u, 20u, 30u, 40u}) {
        BatchSums b(shape);
        b.escape(0, 1, cells.data(), paths.data(), n, {});
        b.lose_at_edge(paths.data(), 64 - n, {});
        b.rays = 64;
        sums.add(n, b);
    }
    // Mean 25; sample variance 500 / 3; of the mean a quarter of it
    const LayerSums::Estimate e = sums.cell(5);
    EXPECT_NEAR(e.mean, 25.0 / 64, 1e-15);
    EXPECT_NEAR(e.error, std::sqrt(500.0 / 3 / 4) / 64, 1e-15);
    EXPECT_EQ(sums.cell(4).error, 0);
    EXPECT_EQ(sums.edge[0], (54 + 44 + 34 + 24) * kRayEnergy);
}

/// Two batches of 100 rays: cells that carry 60, 22, 10 and 8 of them in the mean.
TEST(LayerSums, ErrorsOfCellsAreOfThoseThatCarryNinetyPercent) {
    const SumShape shape{.cells = 8, .bounces = 1};
    const std::vector<std::int32_t> paths(100, 0);
    const std::size_t rays[2][4] = {{60, 22, 12, 6}, {60, 22, 8, 10}};
    LayerSums sums(shape, 100);
    for (std::uint64_t n = 0; n < 2; ++n) {
        BatchSums b(shape);
        for (std::int32_t cell = 0; cell < 4; ++cell) {
            const std::vector<std::int32_t> cells(100, 2 * cell);
            b.escape(0, 1, cells.data(), paths.data(), rays[n][cell], {});
        }
        b.rays = 100;
        sums.add(n, b);
    }
    // The third cell, 10 +- 2, is needed for 90; the fourth, 8 +- 2, is not
    EXPECT_EQ(sums.relative_errors().albedo, 0);
    // Of the third 20 rays came, and none beside it: 20 / 3 a cell around, which lets one ray of
    // 200 count by 20 / 3 : (20 / 3 + 1 / 2)
    const double ray = std::sqrt(20 / 3.0 / (20 / 3.0 + 0.5)) / 20;
    EXPECT_NEAR(sums.relative_errors().cells, std::hypot(0.2, ray), 1e-12);
}

/// A batch of `rays` with one path into each of two places, and the others spread over two.
BatchSums spread_batch(const SumShape& shape, std::uint64_t rays) {
    BatchSums b(shape);
    static const auto light = std::make_shared<const SpreadLight>(
        shape, std::vector<std::uint32_t>{3, 17},
        std::vector<std::uint64_t>{kRayEnergy / 4, kRayEnergy / 2});
    b.escape_spread(rays - 2, light);
    const std::vector<std::int32_t> cells{3, 5}, paths{0, 1};
    b.escape(0, 2, cells.data(), paths.data(), 2, {});
    b.rays = rays;
    return b;
}

TEST(LayerSums, SpreadLightAndSingleRaysAreOneSum) {
    const SumShape shape{.cells = 20, .orders = 2, .bounces = 2};
    LayerSums sums(shape, 10);
    sums.add(0, spread_batch(shape, 10));
    EXPECT_FALSE(sums.settled());
    sums.settle();
    EXPECT_EQ(sums.energy[3], 2 * kRayEnergy);
    EXPECT_EQ(sums.energy[17], 4 * kRayEnergy);
    EXPECT_EQ(sums.energy[20 + 3], kRayEnergy);
    EXPECT_EQ(sums.energy[20 + 5], kRayEnergy);
    EXPECT_EQ(sums.absorbed[0], 2 * kRayEnergy);
    EXPECT_EQ(sums.escaped_by_bounce, (std::vector{6 * kRayEnergy, 2 * kRayEnergy}));
    const auto squared = [](std::uint64_t rays) {
        return LayerSums::Wide{rays * kRayEnergy} * (rays * kRayEnergy);
    };
    EXPECT_TRUE(sums.squares[3] == squared(3));
    EXPECT_TRUE(sums.squares[17] == squared(4));
    EXPECT_TRUE(sums.squares[5] == squared(1));
    EXPECT_NEAR(sums.estimate({3 * kRayEnergy, 0}).mean, 3.0 / 10, 1e-15);
}

TEST(LayerSums, TellTheSameWheneverTheyAreSettled) {
    // Batches of the full size wait, smaller ones do not
    const SumShape shape{.cells = 20, .orders = 2, .bounces = 2};
    LayerSums at_once(shape, 10), at_the_end(shape, 10), other(shape, 10);
    const std::vector<std::uint64_t> rays{10, 9, 10, 7, 10};
    for (std::size_t k = 0; k < rays.size(); ++k) {
        at_once.add(k, spread_batch(shape, rays[k]));
        at_once.settle();
        at_the_end.add(k, spread_batch(shape, rays[k]));
    }
    at_the_end.settle();
    EXPECT_TRUE(at_once == at_the_end);
    // And added to others that wait, too
    LayerSums apart(shape, 10);
    for (std::size_t k = rays.size(); k-- > 0;)
        (k % 2 ? apart : other).add(k, spread_batch(shape, rays[k]));
    apart += other;
    EXPECT_TRUE(at_once == apart);
    EXPECT_EQ(at_once.cell(17).error, apart.cell(17).error);
}

TEST(LayerSums, ElementsOfPolarisedLightAreSigned) {
    // Element 1 cancels over two batches, its spread does not
    const SumShape shape{.cells = 2, .elements = 2, .bounces = 1};
    LayerSums sums(shape, 4);
    const std::vector<std::int32_t> cells(4, 1), paths{0, 1, 2, 3};
    for (const float sign : {1.0f, -1.0f}) {
        const std::vector<float> one(4, 1.0f), signed_half(4, 0.5f * sign);
        const std::vector<const float*> weights{one.data(), signed_half.data()};
        BatchSums b(shape);
        b.escape(0, 1, cells.data(), paths.data(), 4, weights);
        b.rays = 4;
        sums.add(sums.batches(), b);
    }
    EXPECT_EQ(sums.absorbed[0], 0u);
    EXPECT_NEAR(sums.cell(2).mean, 1, 1e-15);
    // To the unit that energies are rounded to
    EXPECT_NEAR(sums.cell(3).mean, 0, 1 / static_cast<double>(kRayEnergy));
    EXPECT_NEAR(sums.cell(3).error, 0.5, 1 / static_cast<double>(kRayEnergy));
}

}  // namespace
}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
//
// Run on any number of ranks by tests/cluster: what they add up must be the sum of all batches,
// however small the pieces. Exits with 1 and a word where it is not.
#include "reduce.h"

#include <asperity/core/energy.h>
#include <asperity/core/random.h>

#include <cstdio>
#include <vector>

namespace {

using namespace asperity;

constexpr SumShape kShape{.cells = 30, .channels = 2, .orders = 2, .bounces = 3};
constexpr std::uint64_t kBatches = 13;

/// Batch n, the smaller the later.
BatchSums batch(std::uint64_t n) {
    const std::uint64_t rays = n < 5 ? 60 : 59;
    const CounterRandom random(7, static_cast<std::uint32_t>(n));
    std::vector<std::int32_t> cells, paths;
    std::vector<float> first, second;
    for (std::uint64_t k = 0; k < rays; ++k) {
        const auto u = random.uniform2(k);
        cells.push_back(static_cast<std::int32_t>(u[0] * 30));
        paths.push_back(static_cast<std::int32_t>(k));
        first.push_back(static_cast<float>(u[1]));
        second.push_back(static_cast<float>(1 - u[1]));
    }
    const std::vector<const float*> weights{first.data(), second.data()};
    BatchSums sums(kShape);
    sums.escape(0, 1 + static_cast<int>(n % 3), cells.data(), paths.data(), rays, weights);
    sums.rays = rays;
    return sums;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0, size = 1, wrong = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    LayerSums whole(kShape, 60);
    std::optional<LayerSums> mine;
    for (std::uint64_t n = 0; n < kBatches; ++n) {
        whole.add(n, batch(n));
        // The last rank has nothing, unless it is alone
        if (static_cast<int>(n) % std::max(1, size - 1) != rank) continue;
        if (!mine) mine.emplace(kShape, 60);
        mine->add(n, batch(n));
    }
    for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, mpi::kPiece}) {
        const auto sum = mpi::sum_over_ranks(mine, kShape, 60, MPI_COMM_WORLD, piece);
        if (!sum || !(*sum == whole)) {
            std::printf("rank %d: the sum in pieces of %zu is wrong\n", rank, piece);
            wrong = 1;
        }
    }
    if (mpi::sum_over_ranks(std::nullopt, kShape, 60, MPI_COMM_WORLD)) wrong = 1;
    MPI_Finalize();
    return wrong;
}

// SPDX-License-Identifier: Apache-2.0
#include "reduce.h"

#include <asperity/core/error.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace asperity::mpi {

namespace {

using Wide = LayerSums::Wide;

/// Adds 128-bit numbers, as MPI asks for it.
void add_wide(void* in, void* in_out, int* count, MPI_Datatype*) {
    for (int k = 0; k < *count; ++k) {
        Wide a, b;
        std::memcpy(&a, static_cast<const char*>(in) + sizeof a * static_cast<std::size_t>(k),
                    sizeof a);
        char* place = static_cast<char*>(in_out) + sizeof b * static_cast<std::size_t>(k);
        std::memcpy(&b, place, sizeof b);
        b += a;
        std::memcpy(place, &b, sizeof b);
    }
}

/// Sums arrays over ranks, in pieces.
class Reducer {
  public:
    Reducer(MPI_Comm ranks, std::size_t piece) : ranks_(ranks), piece_(piece) {
        MPI_Type_contiguous(2, MPI_UINT64_T, &wide_);
        MPI_Type_commit(&wide_);
        MPI_Op_create(add_wide, 1, &add_wide_);
    }
    ~Reducer() {
        MPI_Op_free(&add_wide_);
        MPI_Type_free(&wide_);
    }
    Reducer(const Reducer&) = delete;
    Reducer& operator=(const Reducer&) = delete;

    void sum(std::vector<std::uint64_t>& values) const {
        reduce(values.data(), values.size(), sizeof(std::uint64_t), MPI_UINT64_T, MPI_SUM);
    }
    void sum(std::vector<std::uint32_t>& values) const {
        reduce(values.data(), values.size(), sizeof(std::uint32_t), MPI_UINT32_T, MPI_SUM);
    }
    void sum(std::vector<Wide>& values) const {
        reduce(values.data(), values.size(), sizeof(Wide), wide_, add_wide_);
    }
    void sum(std::vector<LayerSums::Spread>& spreads) const {
        std::vector<std::uint64_t> sums;
        std::vector<Wide> squares;
        for (const LayerSums::Spread& s : spreads) {
            sums.push_back(s.sum);
            squares.push_back(s.squares);
        }
        sum(sums);
        sum(squares);
        for (std::size_t k = 0; k < spreads.size(); ++k) spreads[k] = {sums[k], squares[k]};
    }

  private:
    void reduce(void* values, std::size_t count, std::size_t size, MPI_Datatype type,
                MPI_Op op) const {
        auto* bytes = static_cast<std::byte*>(values);
        for (std::size_t begin = 0; begin < count; begin += piece_) {
            const std::size_t length = std::min(piece_, count - begin);
            MPI_Allreduce(MPI_IN_PLACE, bytes + begin * size, static_cast<int>(length), type, op,
                          ranks_);
        }
    }

    MPI_Comm ranks_;
    std::size_t piece_;
    MPI_Datatype wide_{};
    MPI_Op add_wide_{};
};

/// What each of the ranks has done, together.
BatchSet all_done(const BatchSet& mine, MPI_Comm ranks) {
    int size = 0;
    MPI_Comm_size(ranks, &size);
    std::vector<std::uint64_t> words;
    for (const BatchRange& r : mine.ranges()) words.insert(words.end(), {r.begin, r.end});
    const int count = static_cast<int>(words.size());
    std::vector<int> counts(static_cast<std::size_t>(size)), places(counts.size());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, ranks);
    int total = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        places[k] = total;
        total += counts[k];
    }
    std::vector<std::uint64_t> all(static_cast<std::size_t>(total));
    MPI_Allgatherv(words.data(), count, MPI_UINT64_T, all.data(), counts.data(), places.data(),
                   MPI_UINT64_T, ranks);
    BatchSet done;
    for (std::size_t k = 0; k < all.size(); k += 2)
        if (!done.add({all[k], all[k + 1]}))
            throw Error(ErrorCode::Usage, "two ranks did the same batch");
    return done;
}

}  // namespace

bool any(bool mine, MPI_Comm ranks) {
    int all = mine ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_LOR, ranks);
    return all != 0;
}

std::optional<LayerSums> sum_over_ranks(const std::optional<LayerSums>& mine, const SumShape& shape,
                                        std::uint64_t largest_batch, MPI_Comm ranks,
                                        std::size_t piece) {
    if (!any(mine.has_value(), ranks)) return std::nullopt;
    LayerSums sums = mine ? *mine : LayerSums(shape, largest_batch);
    sums.done = all_done(sums.done, ranks);
    const Reducer reducer(ranks, piece);
    std::vector<std::uint64_t> counts{sums.rays, sums.segments, sums.reflections, sums.stuck};
    reducer.sum(counts);
    sums.rays = counts[0];
    sums.segments = counts[1];
    sums.reflections = counts[2];
    sums.stuck = counts[3];
    for (auto* array :
         {&sums.energy, &sums.escaped_by_bounce, &sums.absorbed, &sums.truncated, &sums.edge})
        reducer.sum(*array);
    reducer.sum(sums.squares);
    for (auto* array : {&sums.stretched, &sums.exact})
        if (any(!array->empty(), ranks)) {
            array->resize(sums.squares.size());
            reducer.sum(*array);
        }
    if (any(!sums.halves.cells.empty(), ranks)) {
        sums.halves.cells.resize(sums.squares.size());
        sums.halves.albedo.resize(sums.albedo.size());
        reducer.sum(sums.halves.cells);
        reducer.sum(sums.halves.albedo);
    }
    reducer.sum(sums.reached);
    reducer.sum(sums.bounces);
    reducer.sum(sums.albedo);
    reducer.sum(sums.albedo_by_age);
    reducer.sum(sums.groups.rays);
    reducer.sum(sums.groups.energy);
    return sums;
}

}  // namespace asperity::mpi
